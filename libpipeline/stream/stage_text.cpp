#include "libpipeline/stream/stage_text.h"

#include <utility>

namespace pipeline {

std::string error_line(const std::string& reason) {
  return "error " + on_one_line(reason) + "\n";
}

namespace {

std::string told(const std::string& reason) {
  return "an earlier stage failed" + (reason.empty() ? ", without saying why" : ": " + reason);
}

}  // namespace

EarlierFailure::EarlierFailure(const SourceLocation& location, std::string reason)
    : InputError(location, told(reason)), reason_(std::move(reason)) {}

std::string EarlierFailure::in_short() const {
  const std::string tool = reason_.substr(0, reason_.find(':'));
  const bool is_named = !tool.empty() && tool.size() < reason_.size() && tool.find(' ') == std::string::npos;
  return is_named ? tool + " failed" : told(reason_);
}

EarlierFailure earlier_failure(LineScanner line) {
  const SourceLocation location = line.location();
  line.word();
  return {location, std::string(line.rest_with_comment())};
}

}  // namespace pipeline
