#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/text/error.h"

namespace pipeline {

/// The longest line that is read; a longer one is an error, so that memory stays bounded.
constexpr std::size_t kMaxLineLength = std::size_t{1} << 20;

/// A line being taken apart, word by word. Words are separated by blanks and tabs.
/// The scanner points into the reader's buffer: it is valid until the next line is read.
class LineScanner {
 public:
  LineScanner() = default;
  /// `line` without its end; a comment is left out.
  LineScanner(std::string_view line, const std::string& file, std::size_t line_number);

  /// True if nothing but blanks is left.
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  /// Takes the next word; an empty one at the end of the line.
  std::string_view word();
  /// Takes the next word as a decimal number; `expected` and `of` together say in an error what should have
  /// stood there ("the x of " "the eye").
  double number(std::string_view expected, std::string_view of = {});
  /// Takes three numbers, which have to be all that is left of the line; `of` names the point or direction.
  Vec3 vec3(std::string_view of);
  /// Takes the next word as a whole number without a sign.
  std::size_t count(std::string_view expected);
  /// An error unless the line is used up; `after` and `of` together say what is complete.
  void expect_end(std::string_view after, std::string_view of = {}) const;

  /// What stands next and was not taken yet.
  [[nodiscard]] std::string_view peek() const;
  /// The column of the word that `peek` shows, or of the end of the line.
  [[nodiscard]] std::size_t column() const {
    return static_cast<std::size_t>(rest_.data() - line_.data()) + 1;
  }
  /// Its place.
  [[nodiscard]] SourceLocation location() const;
  /// The place of a word taken from this line.
  [[nodiscard]] SourceLocation location_of(std::string_view word) const;
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  /// All that was not taken yet, without the blanks around it.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  /// The same, but with the comment: for text that is no data.
  [[nodiscard]] std::string_view rest_with_comment() const;
  /// True if the line holds nothing but a comment.
  [[nodiscard]] bool is_comment() const { return line_.empty() && has_comment_; }
  /// "expected `expected`, found `what stands next`", at its place.
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  void skip_blanks();

  std::string_view line_;
  std::string_view rest_;
  const char* line_end_ = nullptr;  // with the comment
  const std::string* file_ = nullptr;
  std::size_t line_number_ = 0;
  bool has_comment_ = false;
};

/// Reads text in blocks and gives it out line by line. CRLF and LF both end a line, the last line needs no
/// end, `#` starts a comment, trailing blanks are dropped, a UTF-8 byte order mark at the start is skipped.
class TextReader {
 public:
  /// Reads from a file descriptor, which stays the caller's; `file` names it in messages.
  TextReader(int descriptor, std::string file);

  /// The next line, blank ones included; false at the end of the text.
  bool next_line(LineScanner& line);
  /// The next line that holds a word; false at the end of the text.
  bool next_filled_line(LineScanner& line);
  /// True if the next `count` lines that hold a word are in memory, so that no call has to wait for them.
  [[nodiscard]] bool has_buffered_lines(std::size_t count) const;
  /// True if the line given out last ended with a newline, not with the text.
  [[nodiscard]] bool last_line_was_ended() const { return last_line_was_ended_; }

  /// Text that is in memory and was not given out, from the beginning of a line. It is followed by kSlack
  /// characters that may be looked at and mean nothing. For readers that take several lines at a time, then
  /// `skip`.
  [[nodiscard]] std::string_view buffered() const { return {buffer_.data() + begin_, end_ - begin_}; }
  static constexpr std::size_t kSlack = 512;
  /// Consumes `length` buffered characters, `line_count` whole lines.
  void skip(std::size_t length, std::size_t line_count);
  /// Buffers one more block of the input; false if there is none, or none without waiting.
  bool buffer_more();

  [[nodiscard]] const std::string& file() const { return file_; }
  /// The number of the line given out last, 0 before the first.
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  [[nodiscard]] std::size_t bytes_read() const { return bytes_read_; }
  /// The place just after the last line: where something that is missing should have stood.
  [[nodiscard]] SourceLocation end_location() const;

 private:
  bool fill();
  void read_block();
  [[nodiscard]] bool input_is_ready() const;
  LineScanner take_line(std::size_t length, bool is_ended);

  int descriptor_ = -1;
  std::string file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // the unread part of the buffer is [begin_, end_)
  std::size_t end_ = 0;
  std::size_t scanned_ = 0;  // no line end lies in [begin_, scanned_)
  std::size_t line_number_ = 0;
  std::size_t bytes_read_ = 0;
  bool last_line_was_ended_ = false;
  bool at_end_of_file_ = false;
  int read_error_ = 0;  // an errno; told when what was read before is used up
};

}  // namespace pipeline
