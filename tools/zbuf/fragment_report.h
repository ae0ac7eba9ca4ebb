#pragma once

#include <optional>
#include <vector>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/text_writer.h"
#include "libpipeline/visibility/fragment_log.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// The pixels of `--probe`. A UsageError if one is not on the screen.
std::vector<Pixel> probed_pixels(const PictureOptions& chosen, const Viewport& screen);

/// Reports every triangle's fragments at the requested pixels. Takes triangles in the order of the stream, so
/// it does not depend on the threads that draw.
class FragmentReport {
 public:
  /// Reports on the chosen probes and, unless `log` is null, writes the fragments of the whole picture to it.
  /// A UsageError if a probe is not on the screen.
  FragmentReport(const ZbufOptions& chosen, const Viewport& screen, TextWriter* log);

  /// Takes the next triangles.
  void add(const TriangleBatch& p_ndc);
  /// Prints the fragments of the probes on stderr.
  void finish() const;

 private:
  struct Probe {
    Pixel pixel;
    FragmentLog test;
    std::vector<Fragment> found;
  };

  std::vector<Probe> probes_;
  std::optional<FragmentLog> all_;
  TextWriter* log_;  // null without `all_`
};

/// For each triangle: is it nearer than all before it at some pixel or sample? With a depth epsilon, the text
/// of `--seen` needs no other: a drawn fragment is nearer than the pixel's depth by more than epsilon.
/// Earlier fragments that were refused there were not, when that depth was the same or larger; so the drawn
/// one is the nearest so far.
class NearestSoFar {
 public:
  NearestSoFar(PixelRules rules, const Viewport& of_centers, int sample_count) {
    rules.depth_epsilon = 0;
    logs_.emplace_back(rules, of_centers);
    if (sample_count > 1) logs_.emplace_back(rules, sample_screen(of_centers, sample_count));
  }

  bool operator()(const ExactTriangle& p_ndc) {
    bool is_nearest = false;
    for (FragmentLog& log : logs_)
      log.add(p_ndc, 0, [&](const Fragment& f) { is_nearest |= f.result == DepthTestResult::kept; });
    return is_nearest;
  }

 private:
  std::vector<FragmentLog> logs_;
};

}  // namespace pipeline
