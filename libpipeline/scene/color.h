#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// A color with 8 bits per channel, packed as 0x00RRGGBB. For a transparent background, the upper byte holds
/// 255 - alpha.
class Color {
 public:
  constexpr Color() = default;  // black
  constexpr Color(std::uint8_t red, std::uint8_t green, std::uint8_t blue)
      : rgb_(std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | std::uint32_t{blue}) {}

  static constexpr Color from_rgb(std::uint32_t rgb) {
    Color color;
    color.rgb_ = rgb;
    return color;
  }

  /// The color with another alpha: 255 is opaque, 0 invisible.
  [[nodiscard]] constexpr Color with_alpha(std::uint8_t alpha) const {
    return from_rgb((rgb_ & 0xffffff) | std::uint32_t{255u - alpha} << 24);
  }

  /// All four bytes; the upper one is 0 if the color is opaque.
  [[nodiscard]] constexpr std::uint32_t rgb() const { return rgb_; }
  [[nodiscard]] constexpr std::uint8_t red() const { return static_cast<std::uint8_t>(rgb_ >> 16); }
  [[nodiscard]] constexpr std::uint8_t green() const { return static_cast<std::uint8_t>(rgb_ >> 8); }
  [[nodiscard]] constexpr std::uint8_t blue() const { return static_cast<std::uint8_t>(rgb_); }
  [[nodiscard]] constexpr std::uint8_t alpha() const { return static_cast<std::uint8_t>(255 - (rgb_ >> 24)); }
  [[nodiscard]] constexpr bool is_opaque() const { return rgb_ >> 24 == 0; }

  friend constexpr bool operator==(const Color&, const Color&) = default;

 private:
  std::uint32_t rgb_ = 0;
};

/// The channels, red, green and blue from 0 to 255.
inline Vec3 to_vec3(Color color) {
  return {static_cast<double>(color.red()), static_cast<double>(color.green()),
          static_cast<double>(color.blue())};
}

/// The color written as six hexadecimal digits, RRGGBB, or with an alpha as eight, RRGGBBAA, in upper or
/// lower case, perhaps after 0x; nullopt for any other word.
std::optional<Color> parse_color(std::string_view word);

/// The colors of triangles that have none of their own, from the random numbers of the course's handouts
/// (`rand` of Microsoft Visual C++): s starts at 1, a draw sets s = 214013 s + 2531011 (mod 2^32) and gives
/// (s >> 16) & 0x7fff, modulo 256. Triangle N uses draws 3N, 3N + 1 and 3N + 2 as its red, green and blue,
/// whether or not it or any other triangle is drawn.
class TriangleColors {
 public:
  /// The color of triangle `number`, in constant time if it follows the triangle of the last call, otherwise
  /// in O(log number).
  Color of(std::uint64_t number);

 private:
  std::uint8_t draw();

  std::uint32_t state_ = 1;
  std::uint64_t next_number_ = 0;  // the triangle whose draws follow state_
};

}  // namespace pipeline
