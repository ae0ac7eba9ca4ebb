#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pipeline {

/// A whole number of any size, not negative. Small ones (384 bits) need no memory of their own.
class WholeNumber {
 public:
  WholeNumber() = default;
  explicit WholeNumber(std::uint64_t value) {
    if (value != 0) {
      inline_limbs_[0] = value;
      size_ = 1;
    }
  }

  [[nodiscard]] bool is_zero() const { return size_ == 0; }
  [[nodiscard]] bool bit(std::size_t index) const {
    return index / 64 < size_ && ((limbs()[index / 64] >> (index % 64)) & 1u) != 0;
  }
  /// True if any bit below `index` is set.
  [[nodiscard]] bool any_bit_below(std::size_t index) const;
  /// The number of bits without leading zeros; 0 for 0.
  [[nodiscard]] std::size_t bit_length() const;
  /// The lowest 64 bits of the number divided by 2^`index`, rounded down.
  [[nodiscard]] std::uint64_t bits_from(std::size_t index) const;

  void multiply_add(std::uint64_t factor, std::uint64_t summand);
  void shift_left(std::size_t bits);
  void shift_right(std::size_t bits);
  /// Divides by `divisor` and returns the remainder.
  std::uint64_t divide(std::uint64_t divisor);
  void add(const WholeNumber& other);
  /// Subtracts a number that is not larger.
  void subtract(const WholeNumber& other);

  friend WholeNumber operator*(const WholeNumber& a, const WholeNumber& b);
  friend std::strong_ordering operator<=>(const WholeNumber& a, const WholeNumber& b);
  friend bool operator==(const WholeNumber& a, const WholeNumber& b) { return (a <=> b) == 0; }

 private:
  [[nodiscard]] std::span<std::uint64_t> limbs() {
    return {heap_limbs_.empty() ? inline_limbs_.data() : heap_limbs_.data(), size_};
  }
  [[nodiscard]] std::span<const std::uint64_t> limbs() const {
    return {heap_limbs_.empty() ? inline_limbs_.data() : heap_limbs_.data(), size_};
  }
  void resize(std::size_t size);
  void drop_leading_zeros();

  // The least significant limb first, no leading zero limb. They stand in heap_limbs_ unless that is empty.
  std::size_t size_ = 0;
  std::array<std::uint64_t, 6> inline_limbs_{};
  std::vector<std::uint64_t> heap_limbs_;
};

}  // namespace pipeline
