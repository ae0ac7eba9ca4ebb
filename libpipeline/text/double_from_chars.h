#pragma once

#include <charconv>

#include "libpipeline/text/eight_digits.h"

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#include <cmath>
#include <cstdlib>
#include <string>
#endif

namespace pipeline {

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000

/// std::from_chars of a double, which libc++ has from its version 20 on: here by strtod, of a word that
/// begins with a digit, a point or a minus. It rounds to nearest, and nobody sets another locale than "C".
inline std::from_chars_result double_from_chars(const char* first, const char* last, double& value) {
  const char* p = first;
  bool has_digit = false;
  bool is_zero = true;
  const auto skip_digits = [&] {
    for (; p != last && is_digit(*p); ++p) {
      has_digit = true;
      is_zero = is_zero && *p == '0';
    }
  };
  if (p != last && *p == '-') ++p;
  skip_digits();
  if (p != last && *p == '.') {
    ++p;
    skip_digits();
  }
  if (!has_digit) return {first, std::errc::invalid_argument};
  const char* exponent = p;
  if (exponent != last && (*exponent == 'e' || *exponent == 'E')) {
    ++exponent;
    if (exponent != last && (*exponent == '+' || *exponent == '-')) ++exponent;
    if (exponent != last && is_digit(*exponent))
      for (p = exponent; p != last && is_digit(*p);) ++p;
  }
  const double parsed = std::strtod(std::string(first, p).c_str(), nullptr);
  if (std::isinf(parsed) || (parsed == 0 && !is_zero)) return {p, std::errc::result_out_of_range};
  value = parsed;
  return {p, std::errc()};
}

#else

inline std::from_chars_result double_from_chars(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}

#endif

}  // namespace pipeline
