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

/// Takes the next number of the line, named as by LineScanner::number. An InputError at the number unless
/// `holds(number)`: "expected `name` `condition`, found ...".
template <typename Predicate>
double number_where(LineScanner& line, std::string_view name, std::string_view condition, Predicate holds,
                    std::string_view of = {}) {
  const LineScanner at_number = line;
  const double value = line.number(name, of);
  if (!holds(value)) at_number.fail(std::string(name).append(of).append(" ").append(condition));
  return value;
}

}  // namespace pipeline
