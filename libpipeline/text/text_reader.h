#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {

/// The limit in characters. A longer line is an error, so that memory stays bounded.
constexpr std::size_t kMaxLineLength = std::size_t{1} << 20;

/// Splits a line, word by word. Words are separated by blanks and tabs. The scanner points into the reader's
/// buffer: it is valid until the next line is read.
class LineScanner {
 public:
  LineScanner() = default;
  /// `line` does not include its newline; kDecimalNumberSlack readable characters must follow it. The scanner
  /// skips a comment.
  LineScanner(std::string_view line, const std::string& file, std::size_t line_number);

  /// True if no word is left.
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  /// Takes the next word, which is empty at the end of the line.
  std::string_view word();
  /// Takes the next word as a decimal number; an error says that `expected` followed by `of` ("the x of "
  /// "the eye") is missing.
  double number(std::string_view expected, std::string_view of = {});
  /// Takes three numbers; `of` names the point or direction in errors.
  Vec3 point(std::string_view of);
  /// Takes three numbers, which must end the line.
  Vec3 vec3(std::string_view of);
  /// Takes the next word as a whole number without a sign.
  std::uint64_t count(std::string_view expected);
  /// Throws an InputError unless the line is used up; `after` and `of` together name its last item.
  void expect_end(std::string_view after, std::string_view of = {}) const;

  /// The next word, without taking it.
  [[nodiscard]] std::string_view peek() const;
  /// The column of the next word, or of the end of the line.
  [[nodiscard]] std::size_t column() const {
    return static_cast<std::size_t>(rest_.data() - line_.data()) + 1;
  }
  /// The location of the next word, or of the end of the line.
  [[nodiscard]] SourceLocation location() const { return {*file_, line_number_, column()}; }
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  /// The rest of the line, without the blanks around it.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  /// The rest of the line with its comment, for lines that hold a message.
  [[nodiscard]] std::string_view rest_with_comment() const;
  /// True if the line holds nothing but a comment.
  [[nodiscard]] bool is_comment() const { return line_.empty() && has_comment_; }
  /// Takes the next word as a whole number, which may be written with decimals or an exponent: 16.0.
  std::uint64_t whole(std::string_view expected);
  /// Throws "expected `expected`, found" the next word, at its location. `hint` ends the message.
  [[noreturn]] void fail(const std::string& expected, const std::string& hint = "") const;

 private:
  void take(std::string_view word);
  bool take_plain(DecimalNumber& number);
  void skip_blanks();

  std::string_view line_;
  std::string_view rest_;
  const char* line_end_ = nullptr;  // the end of the line, comment included
  const std::string* file_ = nullptr;
  std::size_t line_number_ = 0;
  bool has_comment_ = false;
};

/// Reads text in blocks and delivers it line by line. CRLF and LF both end a line, the last line needs
/// neither, `#` starts a comment, trailing blanks are dropped, a UTF-8 byte order mark at the start is
/// skipped.
class TextReader {
 public:
  /// Reads from a file descriptor, which the caller keeps and closes; `file` names it in messages.
  TextReader(int descriptor, std::string file);

  /// The next line, blank ones included; false at the end of the text.
  bool next_line(LineScanner& line);
  /// Finds the next line that holds a word; false at the end of the text.
  bool next_filled_line(LineScanner& line);
  /// Finds that line; at the end of the text, an InputError names `expected`, followed by `word` in quotes.
  void expect_filled_line(LineScanner& line, std::string_view expected, std::string_view word = {});
  /// Finds such a line unless a word is left on `line`, as a command's arguments may follow on its line.
  void expect_word(LineScanner& line, std::string_view expected, std::string_view word = {}) {
    if (line.at_end()) expect_filled_line(line, expected, word);
  }
  /// True if the next `count` lines that hold a word are buffered, so that reading them will not block.
  [[nodiscard]] bool has_buffered_lines(std::size_t count) const;
  /// True if the line read last ended with a newline, not with the text.
  [[nodiscard]] bool last_line_was_ended() const { return last_line_was_ended_; }

  /// The whole lines of the first block, none of them consumed; for use before any other function. Waits for
  /// the first line only, so a slow program before it in a pipe may give no more.
  std::string_view beginning();

  /// The text in memory that has not been read yet, from the beginning of a line; kSlack readable characters
  /// without meaning follow. For callers that parse several lines at a time, then `skip` them.
  [[nodiscard]] std::string_view buffered() const { return {buffer_.get() + begin_, end_ - begin_}; }
  static constexpr std::size_t kSlack = 512;
  /// Consumes `length` buffered characters, `line_count` whole lines.
  void skip(std::size_t length, std::size_t line_count);

  [[nodiscard]] const std::string& file() const { return file_; }
  /// The number of the line read last, 0 before the first.
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  [[nodiscard]] std::size_t bytes_read() const { return bytes_read_; }
  /// The location just after the last line, for errors about something missing.
  [[nodiscard]] SourceLocation end_location() const { return {file_, line_number_ + 1, 1}; }

 private:
  [[nodiscard]] std::size_t mark_length() const;  // of the byte order mark, if the next line begins with one
  bool fill();
  void read_block();
  void enlarge_buffer();
  LineScanner take_line(std::size_t length, bool is_ended);

  int descriptor_ = -1;
  std::string file_;
  std::unique_ptr<char[]> buffer_;  // uninitialized: memory is touched only where text is read
  std::size_t buffer_size_;
  std::size_t begin_ = 0;  // the unread part of the buffer is [begin_, end_)
  std::size_t end_ = 0;
  std::size_t scanned_ = 0;  // no line end lies in [begin_, scanned_)
  std::size_t line_number_ = 0;
  std::size_t bytes_read_ = 0;
  bool last_line_was_ended_ = false;
  bool at_end_of_file_ = false;
};

}  // namespace pipeline
