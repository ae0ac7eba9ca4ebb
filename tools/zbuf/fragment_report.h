#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/scene/config.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/text_writer.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/raster.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// The pixel of a `--probe`. A UsageError if it is not on the screen.
inline Pixel parsed_pixel(const std::string& word, const Viewport& screen) {
  const auto first_row = static_cast<std::size_t>(screen.drawn_rows().first);
  const auto last_row = static_cast<std::size_t>(screen.drawn_rows().end - 1);
  const auto [column, row] = parse_pair(word, ',').value_or(std::pair(std::uint64_t{0}, last_row + 1));
  if (column < static_cast<std::size_t>(screen.columns) && row >= first_row && row <= last_row)
    return {static_cast<int>(column), static_cast<int>(row)};
  throw UsageError("--probe",
                   "COLUMN,ROW, from 0," + std::to_string(first_row) + " to " +
                       std::to_string(screen.columns - 1) + "," + std::to_string(last_row),
                   pipeline::quoted(word));
}

inline std::vector<Pixel> probed_pixels(const PictureOptions& chosen, const Viewport& screen) {
  std::vector<Pixel> pixels;
  for (const std::string& word : chosen.probes) pixels.push_back(parsed_pixel(word, screen));
  return pixels;
}

/// Reports every triangle's fragments at the requested pixels. Takes triangles in the order of the stream, so
/// it does not depend on the threads that draw.
class FragmentReport {
 public:
  /// Reports on the chosen probes and, unless `log` is null, writes the fragments of the whole picture to it.
  /// A UsageError if a probe is not on the screen.
  FragmentReport(const ZbufOptions& chosen, const Viewport& screen, TextWriter* log) : log_(log) {
    for (const Pixel& pixel : probed_pixels(chosen, screen))
      probes_.push_back({pixel, FragmentLog(chosen.rules, screen, pixel), {}});
    if (log != nullptr) all_.emplace(chosen.rules, screen);
  }

  /// Takes the next triangles.
  void add(const TriangleBatch& p_ndc) {
    if (probes_.empty() && !all_) return;
    for (std::size_t i = 0; i < p_ndc.size(); ++i) {
      const ExactTriangle triangle = exact_triangle(p_ndc, i);
      const std::uint64_t number = p_ndc.numbers[i];
      for (Probe& probe : probes_)
        probe.test.add(triangle, number, [&](const Fragment& fragment) { probe.found.push_back(fragment); });
      if (all_)
        all_->add(triangle, number,
                  [&](const Fragment& fragment) { log_->append(to_text(fragment) + "\n"); });
    }
  }
  /// Prints the fragments of the probes on stderr.
  void finish() const {
    for (const auto& [pixel, test, found] : probes_) {
      for (const Fragment& fragment : found) std::fprintf(stderr, "zbuf: %s\n", to_text(fragment).c_str());
      if (found.empty()) std::fprintf(stderr, "zbuf: %d,%d: no fragment\n", pixel.column, pixel.row);
    }
  }

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
