#include "libpipeline/scene/color.h"

#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

constexpr std::uint32_t kFirstState = 1;
constexpr std::uint32_t kMultiplier = 214013;
constexpr std::uint32_t kIncrement = 2531011;

/// The state after `steps` steps. A step is an affine map, as is the composition of two, so the loop doubles
/// the stride at each bit of `steps` (F. Brown, "Random number generation with arbitrary strides", 1994). The
/// states repeat after 2^32 steps.
std::uint32_t state_after(std::uint64_t steps) {
  std::uint32_t state = kFirstState;
  std::uint32_t multiplier = kMultiplier;
  std::uint32_t increment = kIncrement;
  for (; steps != 0; steps >>= 1) {
    if (steps & 1) state = multiplier * state + increment;
    increment = multiplier * increment + increment;
    multiplier *= multiplier;
  }
  return state;
}

}  // namespace

std::optional<Color> parse_color(std::string_view word) {
  if (word.starts_with("0x")) word.remove_prefix(2);
  const bool has_alpha = word.size() == 8;
  if (word.size() != 6 && !has_alpha) return std::nullopt;
  std::uint64_t number = 0;
  if (!parse_count(word, number, 16)) return std::nullopt;
  const auto digits = static_cast<std::uint32_t>(number);
  if (!has_alpha) return Color::from_rgb(digits);
  return Color::from_rgb(digits >> 8).with_alpha(static_cast<std::uint8_t>(digits));
}

// Z10
Color TriangleColors::of(std::uint64_t number) {
  // 3 * number wraps at 2^64, a multiple of the generator's period.
  if (number != next_number_) state_ = state_after(3 * number);
  next_number_ = number + 1;
  return {draw(), draw(), draw()};  // braces keep the order
}

std::uint8_t TriangleColors::draw() {
  state_ = kMultiplier * state_ + kIncrement;
  return static_cast<std::uint8_t>(state_ >> 16 & 0x7fff);
}

}  // namespace pipeline
