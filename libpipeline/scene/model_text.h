#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

namespace pipeline {

/// The little-endian number at `bytes`.
template <typename Number>
Number number_in(const char* bytes) {
  static_assert(std::endian::native == std::endian::little);
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// A binary type of numbers: its size, its decoder, and the value that stands for white or a normalized 1.
struct NumberType {
  std::size_t size = 0;
  double (*value)(const char*) = nullptr;
  double full = 1;
};
template <typename Number>
constexpr NumberType number_type(double full = 1) {
  return {sizeof(Number), [](const char* p) { return static_cast<double>(number_in<Number>(p)); }, full};
}

/// The unread rest of a model file's text, read word by word.
class ModelText {
 public:
  /// `name` is the file's, for messages; both must outlive this object.
  ModelText(const std::string& name, std::string_view bytes);

  /// Goes to the next line; false at the end of the text.
  bool next_line();
  /// The next word on this line, empty at its end and before a comment; a backslash at the end of a line
  /// continues it.
  std::string_view word();
  /// The next word on this or a later line, empty at the end of the text. Nothing is a comment.
  std::string_view word_of_any_line();
  /// The rest of this line, without blanks around it.
  std::string_view rest_of_line();
  /// The value of a word, which may have a comma for the point. An InputError that names `what` unless it is
  /// a finite float.
  double number(std::string_view word, const char* what) const;
  /// The value of a word, but NaN for one like `nan` or `inf`; for numbers that the model can do without.
  double number_or_nan(std::string_view word) const;
  [[nodiscard]] std::string_view rest() const { return {p_, end_}; }
  /// The count of bytes read.
  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(p_ - begin_); }
  void skip(std::size_t bytes) { p_ += bytes; }
  /// Throws an InputError at a word of the text; an empty word must point at an end.
  [[noreturn]] void fail(std::string_view word, const std::string& expected) const;

 private:
  void skip_blanks();

  const std::string* name_;
  const char *begin_, *p_, *end_;
  char line_end_ = '\n';  // or '\r' if the first line ends with it
};

/// The bytes encoded by a text in base64; other characters are skipped.
std::string from_base64(std::string_view text);
/// A URI with its percent codes decoded.
std::string without_percent_codes(std::string_view uri);

}  // namespace pipeline
