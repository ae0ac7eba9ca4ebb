#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pipeline {

std::string in_lower_case(std::string_view word);

/// "a, b or c".
std::string listed(const std::vector<std::string_view>& words);

/// The known word that `found` is most likely meant to be: the nearest, if at most every third letter has to
/// be inserted, deleted, replaced or swapped with its neighbor; empty if there is none. Case is ignored. (F.
/// Damerau, A technique for computer detection and correction of spelling errors, 1964.)
std::string_view nearest_word(std::string_view found, std::span<const std::string_view> known);

/// The end of a message "expected ..., found `found`" where one of the known words was expected: " (keywords
/// are lower case)", " (did you mean triangle?)", or nothing, as for a known word in a wrong place.
std::string spelling_hint(std::string_view found, std::span<const std::string_view> known);

}  // namespace pipeline
