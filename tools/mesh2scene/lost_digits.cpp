#include "tools/mesh2scene/lost_digits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "tools/mesh2scene/scene_text.h"

namespace pipeline {
namespace {

bool is_exponent(char c) {
  return c == 'e' || c == 'E';
}

bool loses_digits(std::string_view word) {
  // A float below 10 is within 2^-21.
  const std::size_t digit = word.starts_with('-') ? 1 : 0;
  if (word.size() > digit + 1 && word[digit + 1] == '.' && std::ranges::none_of(word, is_exponent))
    return false;
  const double value = parse_number(word).value, held = static_cast<float>(value);
  const double lost = std::abs(value - held);
  if (!(lost > 0.49e-6) || std::isinf(lost)) return false;
  const std::size_t end = static_cast<std::size_t>(std::ranges::find_if(word, is_exponent) - word.begin());
  const std::size_t decimal_count = end - 1 - std::min(word.find('.'), end - 1);
  const double exponent = end < word.size() ? parse_number(word.substr(end + 1)).value : 0;
  const double units = std::pow(10, std::min(static_cast<double>(decimal_count) - exponent, 6.0));
  // Two numbers on both sides of a tie are not different: there may be more decimals than six.
  return lost * units > 0.49 && std::nearbyint(value * units) != std::nearbyint(held * units) &&
         parse_number(float_text(held)).value != value;
}

/// Takes the next word between blanks; empty at the end.
std::string_view next_word(std::string_view& text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  const auto begin = std::ranges::find_if_not(text, is_blank);
  const auto end = std::find_if(begin, text.end(), is_blank);
  text = {end, text.end()};
  return {begin, end};
}

bool is_vertex_keyword(std::string_view word) {
  return word == "v" || word == "vertex";
}

/// Tells from the header of an ASCII PLY which numbers of the lines after it are coordinates. For assimp the
/// vertices come first.
class PlyVertices {
 public:
  /// Whether a line holds a vertex. Takes the lines in turn.
  bool are_in(std::string_view line) {
    const std::string_view keyword = next_word(line);
    if (is_body_) return !keyword.empty() && row_++ < count_;
    is_body_ = keyword == "end_header";
    if (keyword == "element") {
      is_vertex_ = next_word(line) == "vertex";
      if (is_vertex_) parse_count(next_word(line), count_);
    } else if (keyword == "property" && is_vertex_) {
      next_word(line);  // its type
      const std::string_view name = next_word(line);
      are_coordinates_.push_back(name == "x" || name == "y" || name == "z");
    }
    return false;
  }
  [[nodiscard]] bool is_coordinate(std::size_t column) const {
    return column < are_coordinates_.size() && are_coordinates_[column];
  }

 private:
  bool is_body_ = false, is_vertex_ = false;
  std::uint64_t count_ = 0, row_ = 0;
  std::vector<bool> are_coordinates_;
};

}  // namespace

std::string lost_digits(std::string_view model) {
  const bool is_ply = model.starts_with("ply");
  if (is_ply && model.find("\nformat ascii") == std::string_view::npos) return "";
  PlyVertices ply;
  for (std::size_t number = 1; !model.empty(); ++number) {
    const std::string_view line = model.substr(0, model.find('\n'));
    model.remove_prefix(std::min(line.size() + 1, model.size()));
    std::string_view rest = line;
    if (is_ply ? !ply.are_in(line) : !is_vertex_keyword(next_word(rest))) continue;
    for (std::size_t column = 0; !rest.empty(); ++column) {
      const std::string_view word = next_word(rest);
      if ((!is_ply || ply.is_coordinate(column)) && loses_digits(word))
        return std::to_string(number) + ":" + std::to_string(word.begin() - line.begin() + 1) + ": " +
               quoted(word) + " becomes " + float_text(parse_number(word).value) +
               ", as floats have seven digits: move the model to the origin";
    }
  }
  return "";
}

}  // namespace pipeline
