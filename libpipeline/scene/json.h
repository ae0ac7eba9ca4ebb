#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pipeline {

/// A value of JSON (RFC 8259). A missing one, or one of another type, reads as 0, "" or without items.
struct Json {
  bool is_there = false;  // and not null
  bool is_number = false;
  double number = 0;  // 1 for true
  std::string text{};
  std::vector<std::pair<std::string, Json>> items{};  // of an array, without names

  const Json& operator[](std::string_view name) const;
  const Json& operator[](std::size_t index) const;
  [[nodiscard]] double number_or(double other) const { return is_number ? number : other; }
};

/// Parses a whole text. An InputError gives its location in the file `name`.
Json parse_json(const std::string& name, std::string_view text);

}  // namespace pipeline
