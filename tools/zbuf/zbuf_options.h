#pragma once

#include <string>
#include <vector>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/drawing.h"
#include "tools/zbuf/picture_options.h"

namespace pipeline {

/// The options of `zbuf`, as members with their defaults.
struct ZbufOptions : PictureOptions {
  explicit ZbufOptions(CommandLine& options);

  PixelRules rules;
  Algorithm algorithm = Algorithm::zbuffer;
  std::string seen_path;       // "-": standard output; empty: no file
  std::string certainty_path;  // likewise
  std::string rows;            // "A:B", if the option is given
  bool wireframe = false;
  bool has_all_edges = false;  // the wireframe shows hidden ones, too
  std::string fragments_path;  // empty: no file

  /// Chooses the options that depend on others, and on whether standard output is a terminal. A UsageError if
  /// options exclude each other.
  void complete(bool is_terminal);
  /// The screen with the rows to draw. A UsageError if it does not have them.
  [[nodiscard]] Viewport drawn_part(Viewport screen) const;
  /// Throws a UsageError if the depth format cannot store the depths between the limits of Z.
  void check_limits(const Viewport& screen) const;
  /// The files and pipes that a run writes.
  [[nodiscard]] std::vector<NamedFile> outputs(const Statistics& statistics) const;

 private:
  void add_pixels(CommandLine& options);
};

}  // namespace pipeline
