#include "libpipeline/text/number_parser.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <string>

#include "tests/numbers/random_numbers.h"

namespace pipeline {
namespace {

/// Characters behind the text, which must not become part of it.
const std::string kSlack(kDecimalNumberSlack, '7');

/// The length of the number at the beginning of `text`, or -1 if it is left to the general reader.
long length_of(const std::string& text, DecimalNumber& number) {
  const std::string with_slack = text + " " + kSlack;
  const char* const end = read_decimal_number(with_slack.data(), number);
  return end == nullptr ? -1 : end - with_slack.data();
}

double from_chars(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// True if the number is left to the general reader, or equals the double that from_chars gives.
bool is_right(const std::string& text, bool& was_read) {
  DecimalNumber number;
  const long length = length_of(text, number);
  was_read = length == static_cast<long>(text.size());
  return length == -1 || (was_read && std::bit_cast<std::uint64_t>(number.value) ==
                                          std::bit_cast<std::uint64_t>(from_chars(text)));
}

TEST(DecimalNumber, ReadsWhatPeopleWrite) {
  for (const char* text :
       {"0", "-0", "1", "-1.5", "00012", "12345678", "0.1", ".5", "-.5", "5.", "0.30000000000000004",
        "99999999.99999999", "3.14159265358979323", "0.000000000000000000000001"}) {
    bool was_read = false;
    EXPECT_TRUE(is_right(text, was_read)) << text;
    EXPECT_TRUE(was_read) << text;
  }
}

TEST(DecimalNumber, LeavesOthersToTheGeneralReader) {
  for (const char* text : {"", "-", ".", "-.", "--1", "+1", "x", "nan", "inf", "123456789", "123456789.5",
                           "0.1234567890123456789012345", "99999999.123456789012"}) {
    DecimalNumber number;
    EXPECT_EQ(length_of(text, number), -1) << text;
  }
}

TEST(DecimalNumber, EndsWhereTheNumberEnds) {
  for (const char* rest : {"e5", ",5", ".5", "-5", "x", "/", ":", "\xff", "\x80", "\n"}) {
    DecimalNumber number;
    EXPECT_EQ(length_of(std::string("1.25") + rest, number), 4) << rest;
    EXPECT_EQ(number.value, 1.25);
    EXPECT_EQ(number.decimals, 2);
  }
}

TEST(DecimalNumber, CountsDecimals) {
  for (const auto& [text, decimals] :
       {std::pair{"7", 0}, {"7.", 0}, {"0.5", 1}, {"1.50", 2}, {"-1.2345678", 7}, {".00000000", 8}}) {
    DecimalNumber number;
    ASSERT_GT(length_of(text, number), 0) << text;
    EXPECT_EQ(number.decimals, decimals) << text;
  }
}

TEST(DecimalNumber, ZeroMayHaveManyDecimals) {
  for (const std::size_t decimals : {8, 16, 22, 23, 24}) {
    DecimalNumber number;
    const std::string text = "-0." + std::string(decimals, '0');
    EXPECT_EQ(length_of(text, number), static_cast<long>(text.size()));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(number.value), std::uint64_t{1} << 63) << text;
    EXPECT_EQ(number.decimals, static_cast<int>(decimals));
  }
}

// 2^53 + 1 is the midpoint of two doubles; decimals with its digits lie on or next to midpoints, too.
TEST(DecimalNumber, TiesAreRoundedLikeAnyOther) {
  for (const char* text : {"9007199.254740993", "900719.9254740993", "0.9007199254740993",
                           "4503599.62737049650", "1.50000000000000011102", "1.00000000000000011102",
                           "0.50000000000000005551", "90071.992547409910", "90071.992547409930"}) {
    bool was_read = false;
    EXPECT_TRUE(is_right(text, was_read)) << text;
  }
}

TEST(DecimalNumber, HasAnyCountOfDigits) {
  RandomNumbers random(5);
  for (int whole = 1; whole <= 9; ++whole)
    for (int decimals = 0; decimals <= 25; ++decimals) {
      int read_count = 0;
      for (int i = 0; i < 300; ++i) {
        std::string text;
        // Zeros at the beginning, or none.
        const int zero_count = i % 3 == 0 ? random.whole(0, whole + decimals) : 0;
        for (int n = 0; n < whole + decimals; ++n) {
          if (n == whole) text += '.';
          text += static_cast<char>('0' + (n < zero_count ? 0 : random.whole(0, 9)));
        }
        bool was_read = false;
        ASSERT_TRUE(is_right(text, was_read)) << text;
        read_count += was_read ? 1 : 0;
      }
      if (whole <= 8 && whole + decimals <= 19) {
        EXPECT_GT(read_count, 290) << whole << " " << decimals;
      }
    }
}

// Long: every count of digits before and after the point, 10^8 numbers.
TEST(DecimalNumberLong, ReadsWhatFromCharsReads) {
  RandomNumbers random(3);
  std::int64_t read_count = 0;
  constexpr int kCount = 100'000'000;
  std::string text;
  for (int i = 0; i < kCount; ++i) {
    const int whole = random.whole(0, 9);
    const int decimals = random.whole(whole == 0 ? 1 : 0, 21);
    text.assign(random.bits() % 2 == 0 ? "" : "-");
    std::uint64_t bits = 0;
    const auto digit = [&](int n) {
      if (n % 16 == 0) bits = random.bits();
      text.push_back(static_cast<char>('0' + bits % 10));
      bits /= 10;
    };
    for (int n = 0; n < whole; ++n) digit(n);
    if (decimals > 0) text.push_back('.');
    for (int n = 0; n < decimals; ++n) digit(n);
    bool was_read = false;
    ASSERT_TRUE(is_right(text, was_read)) << text;
    read_count += was_read ? 1 : 0;
  }
  EXPECT_GT(read_count, kCount / 2);
}

// Long: doubles in the shortest form that reads back to them, as `--digits exact` prints them.
TEST(DecimalNumberLong, ReadsTheShortestFormBack) {
  RandomNumbers random(4);
  std::array<char, 32> text{};
  int read_count = 0;
  constexpr int kCount = 20'000'000;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.with_exponent(-10, 20);
    char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    bool was_read = false;
    ASSERT_TRUE(is_right(std::string(text.data(), end), was_read)) << value;
    read_count += was_read ? 1 : 0;
  }
  EXPECT_GT(read_count, kCount * 9 / 10);
}

}  // namespace
}  // namespace pipeline
