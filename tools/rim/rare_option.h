#pragma once

#include <algorithm>
#include <span>
#include <string_view>

namespace pipeline {

/// True if one of a command line's words begins like the option `name`, or asks for help. An option that few
/// runs use is added only then, as each costs every start.
inline bool is_wanted(std::string_view name, std::span<char* const> words) {
  return std::ranges::any_of(words, [start = name.substr(0, 4)](std::string_view word) {
    return word.starts_with(start) || word.starts_with("--help") || word == "-h";
  });
}

}  // namespace pipeline
