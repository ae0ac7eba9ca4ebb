#include "libpipeline/stream/stage_text.h"

#include <utility>

namespace pipeline {

std::string error_line(const std::string& reason) {
  return "error " + on_one_line(reason) + "\n";
}

EarlierFailure::EarlierFailure(const SourceLocation& location, std::string reason)
    : InputError(location,
                 "an earlier stage failed" + (reason.empty() ? ", without saying why" : ": " + reason)),
      reason_(std::move(reason)) {}

EarlierFailure earlier_failure(LineScanner line) {
  const SourceLocation location = line.location();
  line.word();
  return {location, std::string(line.rest_with_comment())};
}

}  // namespace pipeline
