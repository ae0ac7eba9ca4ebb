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
  /// Adds the screen and the outputs of `tool`; `has_seen`: its help mentions --seen.
  PictureOptions(CommandLine& options, const std::string& tool, bool has_seen);
  PictureOptions(const PictureOptions&) = delete;
  PictureOptions& operator=(const PictureOptions&) = delete;

  std::string config_path;
  std::string size;                     // "WIDTHxHEIGHT"; empty: the config's
  std::string image_path;               // "-": standard output; empty: `complete` chooses, perhaps none
  std::string z_buffer_path;            // "-": standard output; "none": nowhere; empty: `complete` chooses
  std::string depth_image_path;         // empty: none
  std::string depth_array_path;         // empty: none
  std::string triangle_array_path;      // empty: none
  int sample_count = 1;                 // along each side of a pixel, for the image alone
  int thread_count = 0;                 // 0: as threads_for() chooses
  std::optional<ShadingModel> shading;  // none: as the text's header implies
  std::string background;               // "RRGGBB[AA]"; empty: the text's
  std::vector<std::string> probes;      // "COLUMN,ROW" each
  bool framed = false;                  // the input must be framed
  bool summarizes = false;              // on stderr, as the depths are not shown on the terminal

  // Each tool adds these in their groups.
  void add_shading(CommandLine& options);
  void add_background(CommandLine& options);
  void add_framed(CommandLine& options);
  /// Chooses the options that depend on others, and on whether standard output is a terminal. If
  /// `writes_seen`, image and depths are not the default. A UsageError if options exclude each other.
  void complete(bool is_terminal, bool writes_seen);
  /// The number of threads: --threads, or one per 2 million samples, at most one per core. `samples` is the
  /// count of samples, or of work units that take as long.
  [[nodiscard]] int threads_for(std::size_t samples) const;
  /// True if an image is written; valid once the options are complete.
  [[nodiscard]] bool has_image() const { return !image_path.empty(); }

 private:
  void add_outputs(CommandLine& options, bool has_seen);
};

/// Notes depths that go to standard output if this is a file with an image's name.
void note_depths_in_image(const Tool& tool, const PictureOptions& chosen);

/// The outputs of a run that makes a picture; `others` are those that only one tool has.
std::vector<NamedFile> outputs_of(const PictureOptions& chosen, const std::vector<NamedFile>& others,
                                  const Statistics& statistics);

}  // namespace pipeline
