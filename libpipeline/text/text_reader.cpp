#include "libpipeline/text/text_reader.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "libpipeline/text/eight_digits.h"

namespace pipeline {
namespace {

constexpr std::size_t kBlockSize = std::size_t{1} << 16;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view without_trailing_blanks(std::string_view line) {
  while (!line.empty() && (is_blank(line.back()) || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

/// A hint for a message about a word as other programs write it; else empty.
std::string foreign_format_hint(std::string_view word) {
  const bool has_mark = word.starts_with("\xFF\xFE") || word.starts_with("\xFE\xFF");
  if (has_mark || word.find('\0') != std::string_view::npos) return " (is this UTF-16? save it as UTF-8)";
  for (const std::string_view minus : {"\u2212", "\u2013", "\u2014"})
    if (word.find(minus) != std::string_view::npos)
      return " (a dash of a printed page: type the minus sign -)";
  if (word.find("\u00a0") != std::string_view::npos)
    return " (a no-break space of a printed page: type a blank)";
  const std::size_t comma = word.find(',');
  const bool follows_digit = comma != std::string_view::npos && comma > 0 && is_digit(word[comma - 1]);
  return follows_digit ? " (decimals have a point, and blanks stand between numbers)" : "";
}

/// True if the line has a word before its comment.
bool is_filled(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first != std::string_view::npos && line[first] != '#';
}

}  // namespace

LineScanner::LineScanner(std::string_view line, const std::string& file, std::size_t line_number)
    : line_end_(line.data() + line.size()), file_(&file), line_number_(line_number) {
  const std::size_t comment = line.find('#');
  has_comment_ = comment != std::string_view::npos;
  line_ = without_trailing_blanks(line.substr(0, comment));
  rest_ = line_;
  skip_blanks();
}

void LineScanner::take(std::string_view word) {
  rest_.remove_prefix(word.size());
  skip_blanks();
}

void LineScanner::skip_blanks() {
  const auto filled = std::find_if_not(rest_.begin(), rest_.end(), is_blank);
  rest_.remove_prefix(static_cast<std::size_t>(filled - rest_.begin()));
}

std::string_view LineScanner::peek() const {
  const auto end = std::find_if(rest_.begin(), rest_.end(), is_blank);
  return rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
}

std::string_view LineScanner::word() {
  const std::string_view taken = peek();
  take(taken);
  return taken;
}

double LineScanner::number(std::string_view expected, std::string_view of) {
  if (DecimalNumber plain; take_plain(plain)) return plain.value;
  const std::string_view text = peek();
  const ParsedNumber parsed = parse_number(text);
  if (parsed.error == NumberError::overflow)
    fail(std::string(expected).append(of) + " within a double's range");
  if (parsed.error != NumberError::none) fail(std::string(expected).append(of));
  take(text);
  return parsed.value;
}

/// The fast path: takes a number without an exponent.
bool LineScanner::take_plain(DecimalNumber& number) {
  static_assert(TextReader::kSlack >= kDecimalNumberSlack);
  if (rest_.empty()) return false;
  const char* const rest_end = rest_.data() + rest_.size();
  const char* const end = read_decimal_number(rest_.data(), number);
  if (end == nullptr || end > rest_end || (end < rest_end && !is_blank(*end))) return false;
  take({rest_.data(), end});
  return true;
}

Vec3 LineScanner::point(std::string_view of) {
  const double x = number("the x of ", of), y = number("the y of ", of);
  return {x, y, number("the z of ", of)};
}

Vec3 LineScanner::vec3(std::string_view of) {
  const Vec3 v = point(of);
  expect_end("the z of ", of);
  return v;
}

std::uint64_t LineScanner::count(std::string_view expected) {
  std::uint64_t value = 0;
  if (!parse_count(peek(), value)) fail(std::string(expected));
  word();
  return value;
}

std::uint64_t LineScanner::whole(std::string_view expected) {
  constexpr double kEnd = 0x1p64;
  std::uint64_t value = 0;
  if (parse_count(peek(), value)) return word(), value;
  const auto [number, error] = parse_number(peek());
  if (error != NumberError::none || !(number >= 0 && number < kEnd) || number != std::floor(number))
    fail(std::string(expected));
  word();
  return static_cast<std::uint64_t>(number);
}

void LineScanner::expect_end(std::string_view after, std::string_view of) const {
  if (!at_end()) fail("the end of the line after " + std::string(after).append(of));
}

std::string_view LineScanner::rest_with_comment() const {
  std::string_view text(rest_.data(), static_cast<std::size_t>(line_end_ - rest_.data()));
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return without_trailing_blanks(text);
}

void LineScanner::fail(const std::string& expected, const std::string& hint) const {
  throw InputError(location(),
                   expected_but_found(expected, at_end() ? "the end of the line" : quoted(peek())) +
                       (hint.empty() ? foreign_format_hint(peek()) : hint));
}

TextReader::TextReader(int descriptor, std::string file)
    : descriptor_(descriptor),
      file_(std::move(file)),
      buffer_(std::make_unique_for_overwrite<char[]>(kBlockSize + kSlack)),
      buffer_size_(kBlockSize + kSlack) {}

bool TextReader::next_line(LineScanner& line) {
  for (;;) {
    const char* const from = buffer_.get() + scanned_;
    const auto* const newline = static_cast<const char*>(std::memchr(from, '\n', end_ - scanned_));
    const bool is_ended = newline != nullptr;
    scanned_ = is_ended ? static_cast<std::size_t>(newline - buffer_.get()) : end_;
    const std::size_t length = scanned_ - begin_;
    if (length > kMaxLineLength && length > kMaxLineLength + mark_length())
      throw InputError({file_, line_number_ + 1, kMaxLineLength + 1},
                       expected_but_found("the end of the line", "more than 1048576 characters"));
    if (!is_ended && fill()) continue;
    if (!is_ended && length == mark_length()) return false;
    line = take_line(length, is_ended);
    return true;
  }
}

std::size_t TextReader::mark_length() const {
  return line_number_ == 0 && buffered().starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
}

std::string_view TextReader::beginning() {
  while (buffered().find('\n') == std::string_view::npos && end_ - begin_ <= kMaxLineLength && fill()) {
  }
  std::string_view text = buffered();
  if (!at_end_of_file_) text = text.substr(0, text.rfind('\n') + 1);
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

LineScanner TextReader::take_line(std::size_t length, bool is_ended) {
  const std::size_t mark = mark_length();
  const std::string_view line(buffer_.get() + begin_ + mark, length - mark);
  begin_ += length + (is_ended ? 1 : 0);
  scanned_ = begin_;
  last_line_was_ended_ = is_ended;
  return {line, file_, ++line_number_};
}

bool TextReader::next_filled_line(LineScanner& line) {
  while (next_line(line))
    if (!line.at_end()) return true;
  return false;
}

void TextReader::expect_filled_line(LineScanner& line, std::string_view expected, std::string_view word) {
  if (next_filled_line(line)) return;
  const std::string of_word = word.empty() ? "" : quoted(word);
  throw InputError(end_location(), std::string(expected) + of_word, "the end of the input");
}

bool TextReader::has_buffered_lines(std::size_t count) const {
  std::string_view rest = buffered();
  while (count > 0) {
    const std::size_t length = rest.find('\n');
    if (length == std::string_view::npos) return false;
    if (is_filled(rest.substr(0, length))) --count;
    rest.remove_prefix(length + 1);
  }
  return true;
}

void TextReader::skip(std::size_t length, std::size_t line_count) {
  begin_ += length;
  scanned_ = std::max(scanned_, begin_);
  line_number_ += line_count;
}

/// Reads one more block after the unread part; false at the end of the file. May block.
bool TextReader::fill() {
  if (!at_end_of_file_) read_block();
  return !at_end_of_file_;
}

void TextReader::read_block() {
  const auto has_room = [this] { return buffer_size_ - end_ >= kBlockSize + kSlack; };
  if (!has_room() && begin_ >= end_ - begin_) {  // then each character is moved at most once on average
    std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
    end_ -= begin_;
    scanned_ -= begin_;
    begin_ = 0;
  }
  if (!has_room()) enlarge_buffer();
  ssize_t count = 0;
  do {
    count = ::read(descriptor_, buffer_.get() + end_, kBlockSize);
  } while (count < 0 && errno == EINTR);
  if (count < 0) throw IoError("read", file_, errno);
  at_end_of_file_ = count == 0;
  end_ += static_cast<std::size_t>(count);
  bytes_read_ += static_cast<std::size_t>(count);
}

void TextReader::enlarge_buffer() {
  std::unique_ptr<char[]> larger = std::make_unique_for_overwrite<char[]>(2 * buffer_size_);
  std::memcpy(larger.get(), buffer_.get(), end_);
  buffer_ = std::move(larger);
  buffer_size_ *= 2;
}

}  // namespace pipeline
