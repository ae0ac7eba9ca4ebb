#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pipeline {

/// Takes numbers from a fuzzer's bytes; 0 when none are left.
class FuzzBytes {
 public:
  FuzzBytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() { return next_ < size_ ? data_[next_++] : std::uint8_t{0}; }
  /// A whole number from 0 to `last`.
  int whole(int last) { return byte() % (last + 1); }
  /// Any finite double, made from eight bytes.
  double any_double() {
    std::uint64_t pattern = 0;
    for (int i = 0; i < 8; ++i) pattern = pattern << 8 | byte();
    const double value = std::bit_cast<double>(pattern);
    return std::isfinite(value) ? value : std::bit_cast<double>(pattern & ~(std::uint64_t{1} << 62));
  }
  /// Often a small whole number or a quarter of one, so that numbers coincide; else any double.
  double number() {
    const int kind = byte();
    if (kind < 0x60) return kind % 9 - 4;
    if (kind < 0xc0) return (kind % 33 - 16) * 0.25;
    return any_double();
  }
  [[nodiscard]] std::string_view rest() const {
    return {reinterpret_cast<const char*>(data_) + next_, size_ - next_};
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t next_ = 0;
};

/// The check of a target, which ends the process if a claim does not hold (require).
void check(FuzzBytes bytes);

}  // namespace pipeline
