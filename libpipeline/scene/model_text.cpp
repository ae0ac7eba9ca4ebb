#include "libpipeline/scene/model_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>

#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0';
}

}  // namespace

ModelText::ModelText(const std::string& name, std::string_view bytes)
    : name_(&name), begin_(bytes.data()), p_(begin_), end_(begin_ + bytes.size()) {
  if (bytes.starts_with("\xef\xbb\xbf")) p_ += 3;
  const std::size_t first = bytes.find_first_of("\r\n");
  if (first < bytes.size() - 1 && bytes[first] == '\r' && bytes[first + 1] != '\n') line_end_ = '\r';
}

bool ModelText::next_line() {
  p_ = std::find(p_, end_, line_end_);
  if (p_ != end_) ++p_;
  return p_ != end_;
}

std::string_view ModelText::word() {
  for (;;) {
    skip_blanks();
    const char* const begin = p_;
    if (p_ == end_ || *p_ == '#') return {begin, p_};
    while (p_ != end_ && !is_space(*p_)) ++p_;
    const std::string_view word(begin, p_);
    if (!word.ends_with('\\')) return word;
    skip_blanks();
    if (p_ != end_ && *p_ != line_end_) return word;
    p_ += p_ != end_;
    if (word.size() > 1) return word.substr(0, word.size() - 1);
  }
}

std::string_view ModelText::word_of_any_line() {
  while (p_ != end_ && is_space(*p_)) ++p_;
  const char* const begin = p_;
  while (p_ != end_ && !is_space(*p_)) ++p_;
  return {begin, p_};
}

std::string_view ModelText::rest_of_line() {
  skip_blanks();
  const char* const begin = p_;
  p_ = std::find(p_, end_, line_end_);
  const char* last = p_;
  while (last != begin && is_space(last[-1])) --last;
  return {begin, last};
}

void ModelText::skip_blanks() {
  while (p_ != end_ && is_space(*p_) && *p_ != line_end_) ++p_;
}

double ModelText::number(std::string_view word, const char* what) const {
  DecimalNumber decimal;
  if (end_ - word.data() > kDecimalNumberSlack + 32 &&
      read_decimal_number(word.data(), decimal) == word.data() + word.size())
    return decimal.value;
  ParsedNumber parsed = parse_number(word);
  if (parsed.error == NumberError::not_a_number && std::ranges::count(word, ',') == 1) {
    std::string with_point(word);
    with_point[word.find(',')] = '.';
    parsed = parse_number(with_point);
  }
  if (parsed.error != NumberError::none || std::fabs(parsed.value) > std::numeric_limits<float>::max())
    fail(word, what);
  return parsed.value;
}

double ModelText::number_or_nan(std::string_view word) const {
  const bool is_odd = word.find_first_of("nN#") != std::string_view::npos;  // nan, inf, 1.#IND
  return is_odd ? std::numeric_limits<double>::quiet_NaN() : number(word, "a number");
}

void ModelText::fail(std::string_view word, const std::string& expected) const {
  const std::string_view before(begin_, word.data());
  const auto line = static_cast<std::size_t>(std::ranges::count(before, line_end_)) + 1;
  const std::size_t column = before.size() - (before.rfind(line_end_) + 1) + 1;
  const char* const found = word.data() == end_ ? "the end of the file" : "the end of the line";
  throw InputError({*name_, line, column}, expected, word.empty() ? found : pipeline::quoted(word));
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) continue;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    if (++count % 4 != 1) bytes += static_cast<char>(bits >> (6 - 2 * ((count - 1) % 4)));
  }
  return bytes;
}

std::string without_percent_codes(std::string_view uri) {
  std::string text;
  const auto is_digit = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
  const auto digit = [](char c) { return c > '9' ? (c & 7) + 9 : c & 15; };
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code = uri[i] == '%' && i + 2 < uri.size() && is_digit(uri[i + 1]) && is_digit(uri[i + 2]);
    text += is_code ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (is_code) i += 2;
  }
  return text;
}

}  // namespace pipeline
