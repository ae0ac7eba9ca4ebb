#include "libpipeline/text/error.h"

#include <system_error>

namespace pipeline {
namespace {

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

std::string hexadecimal(char c) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[byte / 16], kDigits[byte % 16]};
}

}  // namespace

std::string to_string(const SourceLocation& location) {
  std::string text = location.file;
  if (location.line > 0) text += ":" + std::to_string(location.line);
  if (location.line > 0 && location.column > 0) text += ":" + std::to_string(location.column);
  return text;
}

InputError::InputError(const SourceLocation& location, const std::string& message)
    : std::runtime_error(to_string(location) + ": " + message), location_(location) {}

InputError::InputError(const SourceLocation& location, const std::string& expected, const std::string& found)
    : InputError(location, expected_but_found(expected, found)) {}

std::string quoted(std::string_view text) {
  constexpr std::size_t kMaxLength = 40;
  std::string result = "'";
  for (const char c : text.substr(0, kMaxLength)) {
    const bool is_plain = !is_control(c) && static_cast<unsigned char>(c) < 0x80;
    result += is_plain ? std::string(1, c) : hexadecimal(c);
  }
  return result + (text.size() > kMaxLength ? "...'" : "'");
}

std::string on_one_line(std::string_view text) {
  std::string result;
  for (const char c : text) result += is_control(c) ? hexadecimal(c) : std::string(1, c);
  return result;
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return (std::to_string(count) + " ").append(noun) + (count == 1 ? "" : "s");
}

std::string expected_but_found(const std::string& expected, const std::string& found) {
  return "expected " + expected + ", found " + found;
}

IoError::IoError(const std::string& action, const std::string& file, int error_number)
    : std::runtime_error("cannot " + action + " " + file + ": " +
                         std::generic_category().message(error_number)),
      error_number_(error_number) {}

}  // namespace pipeline
