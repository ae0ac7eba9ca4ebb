#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pipeline {

/// A position in the input. Lines and columns count from 1; 0 means "unknown".
/// `file` is a file's name, `<stdin>`, or the name of a command-line option.
struct SourceLocation {
  std::string file;
  std::size_t line = 0;
  std::size_t column = 0;

  [[nodiscard]] bool is_option() const { return file.starts_with("--"); }
};

/// "file:line:column", without the unknown parts.
std::string to_string(const SourceLocation& location);

/// A line and a column, counted from 1; packed into 64 bits because every vertex has them.
class LineAndColumn {
 public:
  /// The unknown position.
  constexpr LineAndColumn() = default;
  constexpr LineAndColumn(std::size_t line, std::size_t column = 1)
      : bits_(line | std::uint64_t{column - 1} << kLineBits) {}

  [[nodiscard]] constexpr bool is_known() const { return line() != 0; }
  [[nodiscard]] constexpr std::size_t line() const {
    return static_cast<std::size_t>(bits_ & ((std::uint64_t{1} << kLineBits) - 1));
  }
  [[nodiscard]] constexpr std::size_t column() const {
    return static_cast<std::size_t>(bits_ >> kLineBits) + 1;
  }
  friend bool operator==(const LineAndColumn&, const LineAndColumn&) = default;

 private:
  static constexpr int kLineBits = 43;  // the other bits hold columns up to kMaxLineLength

  std::uint64_t bits_ = 0;
};

/// The positions at which the three vertices of a triangle begin.
using VertexLocations = std::array<LineAndColumn, 3>;

/// The names of a triangle's vertices in messages.
constexpr std::array<std::string_view, 3> kVertexNames = {"vertex 1 of 3", "vertex 2 of 3", "vertex 3 of 3"};

}  // namespace pipeline
