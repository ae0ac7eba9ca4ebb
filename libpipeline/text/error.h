#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "libpipeline/text/source_location.h"

namespace pipeline {

/// Bad input. `what()` is the whole message: "file:line:column: expected ..., found ...".
class InputError : public std::runtime_error {
 public:
  InputError(const SourceLocation& location, const std::string& message);
  /// The message is expected_but_found(expected, found).
  InputError(const SourceLocation& location, const std::string& expected, const std::string& found);
  [[nodiscard]] const SourceLocation& location() const { return location_; }

 private:
  SourceLocation location_;
};

/// Text as it appears in a message: in quotes, unprintable bytes as \xNN, cut after 40 bytes.
std::string quoted(std::string_view text);

/// The text with control characters as \xNN, so that a message stays on one line.
std::string on_one_line(std::string_view text);

/// A count and its noun, which is singular only after 1: "1 triangle", "0 triangles".
std::string counted(std::uint64_t count, std::string_view noun);

/// "expected `expected`, found `found`": the form of messages about wrong input.
std::string expected_but_found(const std::string& expected, const std::string& found);

/// A failure to read or write: a full disk, a missing file. `what()` names the file and the system's reason.
class IoError : public std::runtime_error {
 public:
  /// `error_number` is an errno value.
  IoError(const std::string& action, const std::string& file, int error_number);
  [[nodiscard]] int error_number() const { return error_number_; }

 private:
  int error_number_;
};

}  // namespace pipeline
