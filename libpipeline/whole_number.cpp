#include "libpipeline/whole_number.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "libpipeline/int128.h"

namespace pipeline {

bool WholeNumber::any_bit_below(std::size_t index) const {
  const auto all = limbs();
  const std::size_t whole = std::min(index / 64, size_);
  if (std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(whole), [](auto l) { return l != 0; }))
    return true;
  return whole < size_ && (all[whole] & ((std::uint64_t{1} << (index % 64)) - 1)) != 0;
}

std::size_t WholeNumber::bit_length() const {
  return size_ == 0 ? 0 : 64 * size_ - static_cast<std::size_t>(std::countl_zero(limbs().back()));
}

std::uint64_t WholeNumber::bits_from(std::size_t index) const {
  const std::size_t first = index / 64;
  const unsigned shift = index % 64;
  const auto all = limbs();
  std::uint64_t bits = first < size_ ? all[first] >> shift : 0;
  if (shift != 0 && first + 1 < size_) bits |= all[first + 1] << (64 - shift);
  return bits;
}

void WholeNumber::multiply_add(std::uint64_t factor, std::uint64_t summand) {
  UInt128 carry = summand;
  for (std::uint64_t& limb : limbs()) {
    carry += UInt128{limb} * factor;
    limb = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  if (carry != 0) {
    resize(size_ + 1);
    limbs().back() = static_cast<std::uint64_t>(carry);
  }
  drop_leading_zeros();
}

void WholeNumber::shift_left(std::size_t bits) {
  if (is_zero() || bits == 0) return;
  const std::size_t whole = bits / 64;
  const unsigned rest = bits % 64;
  const std::size_t old_size = size_;
  resize(old_size + whole + 1);
  const auto all = limbs();
  for (std::size_t i = old_size + 1; i-- > 0;) {
    const std::uint64_t high = i < old_size ? all[i] << rest : 0;
    const std::uint64_t low = rest != 0 && i > 0 ? all[i - 1] >> (64 - rest) : 0;
    all[i + whole] = high | low;
  }
  std::fill_n(all.begin(), whole, 0);
  drop_leading_zeros();
}

void WholeNumber::shift_right(std::size_t bits) {
  const std::size_t whole = std::min(bits / 64, size_);
  const auto all = limbs();
  for (std::size_t i = 0; i + whole < size_; ++i) all[i] = bits_from(64 * i + bits);
  size_ -= whole;
  drop_leading_zeros();
}

std::uint64_t WholeNumber::divide(std::uint64_t divisor) {
  UInt128 remainder = 0;
  const auto all = limbs();
  for (std::size_t i = size_; i-- > 0;) {
    remainder = (remainder << 64) | all[i];
    all[i] = static_cast<std::uint64_t>(remainder / divisor);
    remainder %= divisor;
  }
  drop_leading_zeros();
  return static_cast<std::uint64_t>(remainder);
}

void WholeNumber::add(const WholeNumber& other) {
  const std::size_t other_size = other.size_;
  resize(std::max(size_, other_size) + 1);
  const auto all = limbs();
  const auto others = other.limbs();
  UInt128 carry = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    carry += UInt128{all[i]} + (i < other_size ? others[i] : 0);
    all[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  drop_leading_zeros();
}

void WholeNumber::subtract(const WholeNumber& other) {
  assert(*this >= other);
  const auto all = limbs();
  const auto others = other.limbs();
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const UInt128 taken = UInt128{i < others.size() ? others[i] : 0} + borrow;
    borrow = all[i] < taken ? 1 : 0;
    all[i] -= static_cast<std::uint64_t>(taken);
  }
  drop_leading_zeros();
}

WholeNumber operator*(const WholeNumber& a, const WholeNumber& b) {
  WholeNumber product;
  product.resize(a.size_ + b.size_);
  const auto all = product.limbs();
  const auto a_limbs = a.limbs();
  const auto b_limbs = b.limbs();
  for (std::size_t i = 0; i < a_limbs.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b_limbs.size(); ++j) {
      const UInt128 sum = UInt128{a_limbs[i]} * b_limbs[j] + all[i + j] + carry;
      all[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    all[i + b_limbs.size()] = carry;
  }
  product.drop_leading_zeros();
  return product;
}

std::strong_ordering operator<=>(const WholeNumber& a, const WholeNumber& b) {
  if (a.size_ != b.size_) return a.size_ <=> b.size_;
  const auto a_limbs = a.limbs();
  const auto b_limbs = b.limbs();
  for (std::size_t i = a.size_; i-- > 0;)
    if (a_limbs[i] != b_limbs[i]) return a_limbs[i] <=> b_limbs[i];
  return std::strong_ordering::equal;
}

/// Makes the number `size` limbs long; new ones are 0.
void WholeNumber::resize(std::size_t size) {
  if (heap_limbs_.empty() && size > inline_limbs_.size()) {
    heap_limbs_.assign(inline_limbs_.begin(), inline_limbs_.begin() + static_cast<std::ptrdiff_t>(size_));
    heap_limbs_.resize(size);
  } else if (size > heap_limbs_.size() && !heap_limbs_.empty()) {
    heap_limbs_.resize(size);
  }
  const std::size_t old_size = size_;
  size_ = size;
  for (std::size_t i = old_size; i < size; ++i) limbs()[i] = 0;
}

void WholeNumber::drop_leading_zeros() {
  const auto all = limbs();
  while (size_ > 0 && all[size_ - 1] == 0) --size_;
}

}  // namespace pipeline
