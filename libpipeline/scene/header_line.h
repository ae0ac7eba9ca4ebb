#pragma once

#include <string>
#include <string_view>

#include "libpipeline/text/error.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

// The parts that the readers of scenes, headers and vertex lines share.

/// A value read from the input, and its location there.
template <typename T>
struct Located {
  T value;
  SourceLocation location;
};

/// The error, at `second`, for a part that a text may have only once: "expected one `name`, found a second
/// one after `first`".
inline InputError given_twice(const std::string& name, const SourceLocation& first,
                              const SourceLocation& second) {
  return {second, "one " + name, "a second one after " + to_string(first)};
}

/// A number's name in messages: `name` and `of` together, as LineScanner::number takes them.
struct NumberName {
  std::string_view name;
  std::string_view of = {};
};

/// Takes the next number of the line. An InputError at the number unless `holds(number)`:
/// "expected `name` `condition`, found ...".
template <typename Predicate>
double number_where(LineScanner& line, const NumberName& name, std::string_view condition, Predicate holds) {
  const LineScanner at_number = line;
  const double value = line.number(name.name, name.of);
  if (!holds(value)) at_number.fail(std::string(name.name).append(name.of).append(" ").append(condition));
  return value;
}

}  // namespace pipeline
