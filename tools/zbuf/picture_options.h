#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/picture/shading.h"
#include "tools/rim/command_line.h"
#include "tools/rim/separate_outputs.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"

namespace pipeline {

constexpr int kMaxThreads = 256;

/// The options that `zbuf` and `trace` share, as members with their defaults.
struct PictureOptions {
  /// Adds the screen and the outputs of `tool`; `has_seen`: whether the help mentions --seen.
  PictureOptions(CommandLine& options, const std::string& tool, bool has_seen);
  PictureOptions(const PictureOptions&) = delete;
  PictureOptions& operator=(const PictureOptions&) = delete;

  std::string config_path;
  std::string size;                     // "WIDTHxHEIGHT"; empty: the config's
  std::string image_path;               // "-": standard output; empty: as `complete` chooses, and then none
  std::string z_buffer_path;            // "-": standard output; "none": nowhere; empty: as `complete` chooses
  std::string depth_image_path;         // empty: none
  std::string depth_array_path;         // empty: none
  std::string triangle_array_path;      // empty: none
  int sample_count = 1;                 // along each side of a pixel, for the image alone
  int thread_count = 0;                 // 0: as threads_for() chooses
  std::optional<ShadingModel> shading;  // none: as the text's header implies
  std::string background;               // "RRGGBB[AA]"; empty: the text's
  std::vector<std::string> probes;      // "COLUMN,ROW" each
  bool framed = false;                  // the input has to be
  bool summarizes = false;              // on stderr, as the depths are not shown on the terminal

  // Each tool adds these in their groups.
  void add_shading(CommandLine& options);
  void add_background(CommandLine& options);
  void add_framed(CommandLine& options);
  /// Chooses the options that depend on others, and on whether standard output is a terminal; without an
  /// image and depths by default where `writes_seen`. A UsageError if options exclude each other.
  void complete(bool is_terminal, bool writes_seen);
  /// The number of threads: --threads, or one per 2 million samples, at most one per core. `samples` counts
  /// samples, or work that takes as long.
  [[nodiscard]] int threads_for(std::size_t samples) const;
  /// True if an image is written, once the options are complete.
  [[nodiscard]] bool has_image() const { return !image_path.empty(); }

 private:
  void add_outputs(CommandLine& options, bool has_seen);
};

/// Notes depths that go to standard output, where that is a file with the name of an image.
void note_depths_in_image(const Tool& tool, const PictureOptions& chosen);

/// The files and pipes of a run that makes a picture, with those of one tool alone.
std::vector<NamedFile> outputs_of(const PictureOptions& chosen, const std::vector<NamedFile>& others,
                                  const Statistics& statistics);

}  // namespace pipeline
