#include "libpipeline/text/eight_digits.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/numbers/random_numbers.h"

namespace pipeline {
namespace {

constexpr std::uint64_t kEight = 100'000'000;

std::string with_zeros(std::uint64_t number, std::size_t length) {
  const std::string text = std::to_string(number);
  return std::string(length - text.size(), '0') + text;
}

std::string text_of(std::uint64_t digits) {
  std::string text(8, ' ');
  store_eight(text.data(), digits + kEightZeros);
  return text;
}

void check(std::uint64_t number) {
  const std::string text = with_zeros(number, 16);
  const auto [first, last] = split_sixteen(number);
  EXPECT_EQ(text_of(first) + text_of(last), text);
  EXPECT_EQ(text_of(split_digits(static_cast<std::uint32_t>(number % kEight))), text.substr(8));
  const std::uint64_t digits = load_eight(text.data() + 8) - kEightZeros;
  EXPECT_EQ(no_digits(digits), 0u);
  EXPECT_EQ(join_digits(digits), number % kEight);
}

TEST(EightDigits, AreSplitAndJoinedNextToPowersOfTen) {
  for (std::uint64_t power = 1; power <= kEight * kEight; power *= 10)
    for (const std::uint64_t number : {power - 1, power, 5 * power, 9 * power})
      if (number < kEight * kEight) check(number);
}

TEST(EightDigits, AreSplitAndJoinedWhateverTheyAre) {
  RandomNumbers random(1);
  for (int i = 0; i < 100000; ++i) check(random.bits() % (kEight * kEight));
}

TEST(EightDigits, TheFirstOnesAreANumber) {
  const std::string text = "98765432";
  for (std::size_t count = 0; count <= 8; ++count) {
    for (const char end : {'.', ' ', '-', '/', ':', '\0', '\x80', '\xff'}) {
      std::string ended = text;
      if (count < 8) ended[count] = end;
      const std::uint64_t less_zeros = load_eight(ended.data()) - kEightZeros;
      ASSERT_EQ(leading_digit_count(less_zeros), count) << ended;
      if (count == 0) continue;
      EXPECT_EQ(join_leading_digits(less_zeros, count), std::stoull(text.substr(0, count))) << ended;
    }
  }
}

TEST(EightDigits, OtherCharactersAreFound) {
  for (int c = 0; c < 256; ++c) {
    std::string text = "01234567";
    text[5] = static_cast<char>(c);
    const bool is_digit = c >= '0' && c <= '9';
    EXPECT_EQ(no_digits(load_eight(text.data()) - kEightZeros) == 0, is_digit) << c;
  }
}

}  // namespace
}  // namespace pipeline
