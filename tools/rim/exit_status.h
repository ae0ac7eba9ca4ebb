#pragma once

namespace pipeline {

// The exit statuses of all tools.
constexpr int kExitDone = 0;
constexpr int kExitFailure = 1;  // bad input, or reading or writing failed
constexpr int kExitMisuse = 2;   // a wrong command line

}  // namespace pipeline
