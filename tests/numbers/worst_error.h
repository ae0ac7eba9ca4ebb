#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace pipeline {

/// The largest error in a test, for the table of bounds (tests/proofs/README.md).
class WorstError {
 public:
  explicit WorstError(std::string name) : name_(std::move(name)) {}
  WorstError(const WorstError&) = delete;
  WorstError& operator=(const WorstError&) = delete;
  ~WorstError() { std::printf("%s: worst error 2^%.1f\n", name_.c_str(), std::log2(worst_)); }

  void add(double error) { worst_ = std::max(worst_, error); }

 private:
  std::string name_;
  double worst_ = 0;
};

}  // namespace pipeline
