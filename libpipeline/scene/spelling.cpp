#include "libpipeline/scene/spelling.h"

#include <algorithm>
#include <cstddef>

namespace pipeline {
namespace {

char to_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// The least number of insertions, deletions, replacements and swaps of neighbors that turn `a` into `b`,
/// without changing a letter twice.
std::size_t distance(std::string_view a, std::string_view b) {
  // rows[i][j]: from the first i letters of a to the first j of b.
  std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        rows[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = rows[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      rows[i][j] = std::min({replaced, rows[i - 1][j] + 1, rows[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
    }
  }
  return rows[a.size()][b.size()];
}

}  // namespace

std::string in_lower_case(std::string_view word) {
  std::string lower(word);
  std::ranges::transform(lower, lower.begin(), to_lower);
  return lower;
}

std::string listed(const std::vector<std::string_view>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text.append(i == 0 ? "" : i + 1 < words.size() ? ", " : " or ").append(words[i]);
  return text;
}

std::string_view nearest_word(std::string_view found, std::span<const std::string_view> known) {
  constexpr std::size_t kMaxLength = 40;  // no known word is longer
  if (found.size() > kMaxLength) return {};
  const std::string lower = in_lower_case(found);
  std::string_view nearest;
  std::size_t least = found.size() / 3 + 1;
  for (const std::string_view word : known) {
    if (const std::size_t changes = distance(lower, word); changes < least) {
      least = changes;
      nearest = word;
    }
  }
  return nearest;
}

std::string spelling_hint(std::string_view found, std::span<const std::string_view> known) {
  const std::string_view nearest = nearest_word(found, known);
  if (nearest.empty() || nearest == found) return "";
  if (in_lower_case(found) == nearest) return " (keywords are lower case)";
  return " (did you mean " + std::string(nearest) + "?)";
}

}  // namespace pipeline
