#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/stream/coordinate_extent.h"
#include "libpipeline/stream/unseen_places.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/output_file.h"
#include "tools/rim/command_line.h"
#include "tools/rim/separate_outputs.h"

namespace pipeline {

/// `--stats`: counts and extents of a run in a file, one line "key value" for each.
class Statistics {
 public:
  explicit Statistics(CommandLine& options);

  [[nodiscard]] bool is_wanted() const { return !path_.empty(); }
  [[nodiscard]] NamedFile output() const {
    return path_ == kStandardError.path ? kStandardError : NamedFile{"--stats", path_};
  }
  /// Opens the file, if one is requested, before the work, so that a bad name is an error at once.
  void open() {
    if (is_wanted()) file_.emplace(path_);
  }
  void add(std::string_view key, std::uint64_t count);
  /// Adds the counts of triangles outside the view volume or, with `on_screen`, of those that no pixel shows.
  void add(const UnseenPlaces& unseen, bool on_screen);
  /// Adds the lines x_min ... z_max in their text's format; none without a vertex.
  void add(const CoordinateExtent& extent, NumberFormat format);
  /// Adds a box likewise, in the shortest form.
  void add(const BoundingBox& extent);
  /// Writes and closes the file.
  void finish();
  /// Moves the file to its name.
  void commit() {
    if (file_) file_->commit();
  }

 private:
  void add_range(std::string_view axis, const CoordinateExtent::Range& range, NumberFormat format);

  std::string path_;  // empty: not requested
  std::string lines_;
  std::optional<OutputFile> file_;
};

}  // namespace pipeline
