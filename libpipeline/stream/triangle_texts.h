#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pipeline {

/// The lines of a batch's triangles as they stand in the text: three vertex lines and a blank one each, and
/// `clipped` with its lines before the first piece of a triangle. Without comments, and without the blanks
/// at both ends of a line.
class TriangleTexts {
 public:
  /// The count of complete triangles.
  [[nodiscard]] std::size_t size() const { return ends_.size(); }
  /// The lines of one triangle.
  [[nodiscard]] std::string_view operator[](std::size_t index) const {
    const std::size_t begin = end_of(index);
    return std::string_view(lines_).substr(begin, ends_[index] - begin);
  }
  void clear() { truncate(0); }
  /// Keeps the first `count` triangles, or all if there are fewer.
  void truncate(std::size_t count) {
    ends_.resize(std::min(count, size()));
    lines_.resize(end_of(size()));
  }

  /// Adds lines, all of them ended, to the next triangle.
  void add(std::string_view lines) { lines_ += lines; }
  /// Adds a line, which comes without its end, to the next triangle.
  void add_line(std::string_view line) { (lines_ += line) += '\n'; }
  /// Completes the next triangle.
  void end_triangle() {
    lines_ += '\n';
    ends_.push_back(lines_.size());
  }
  /// Completes the next triangle without any lines.
  void end_without_lines() { ends_.push_back(lines_.size()); }
  /// Adds triangles in fixed form (fixed_text.h) with that many decimals.
  void add_fixed_form(std::string_view triangles, int decimals);

 private:
  /// Of the first `count` triangles.
  [[nodiscard]] std::size_t end_of(std::size_t count) const { return count == 0 ? 0 : ends_[count - 1]; }

  std::string lines_;
  std::vector<std::size_t> ends_;
};

}  // namespace pipeline
