#pragma once

namespace pipeline {

// Exit statuses all tools share.
constexpr int kExitDone = 0;
constexpr int kExitFailure = 1;  // bad input, or reading or writing failed
constexpr int kExitMisuse = 2;   // the command line is not one the tool knows

}  // namespace pipeline
