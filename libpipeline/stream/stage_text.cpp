#include "libpipeline/stream/stage_text.h"

#include <utility>

namespace pipeline {

std::string error_line(const std::string& reason) {
  return "error " + on_one_line(reason) + "\n";
}

EarlierFailure::EarlierFailure(const Place& place, std::string reason)
    : InputError(place,
                 "an earlier stage failed" + (reason.empty() ? ", without saying why" : ": " + reason)),
      reason_(std::move(reason)) {}

EarlierFailure earlier_failure(LineScanner line) {
  const Place place = line.place();
  line.word();
  return {place, std::string(line.rest_with_comment())};
}

}  // namespace pipeline
