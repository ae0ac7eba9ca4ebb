#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pipeline {

// The fast paths for stage text read and print groups of three numbers. A last column of whole numbers, the
// same on the three lines of a triangle, is taken off before they read and put on after they have printed.

/// Triangles of a stage text without their last column.
class TrianglesWithoutLastColumn {
 public:
  /// Takes triangles from the beginning of `text`, at most `limit`, up to the first that is not complete, or
  /// whose vertex lines do not end in a blank and the same whole number below `bound`.
  TrianglesWithoutLastColumn(std::string_view text, std::size_t limit, std::size_t bound);

  [[nodiscard]] std::size_t count() const { return values_.size(); }
  /// Their lines; kFixedTextSlack characters behind them may be read.
  [[nodiscard]] std::string_view lines() const { return std::string_view(lines_).substr(0, length_); }
  /// The column, one number for each.
  [[nodiscard]] const std::vector<std::uint32_t>& values() const { return values_; }
  /// The length of the first `count` in the text with the column.
  [[nodiscard]] std::size_t length_with_column(std::size_t count) const {
    return count == 0 ? 0 : ends_[count - 1];
  }

 private:
  bool take(std::string_view text, std::size_t bound);

  std::string lines_;
  std::size_t length_ = 0;
  std::vector<std::uint32_t> values_;
  std::vector<std::size_t> ends_;
};

/// The column takes at most this much room on the three lines of a triangle.
constexpr std::size_t kMaxLastColumnLength = std::size_t{3} * 11;

/// Writes `lines`, of triangles, with a last column of these values, one for each; returns the end.
char* print_with_last_column(std::string_view lines, std::span<const std::uint32_t> values, char* out);

}  // namespace pipeline
