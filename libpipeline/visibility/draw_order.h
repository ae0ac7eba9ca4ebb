#pragma once

#include <cassert>
#include <cstdint>

#include "libpipeline/scene/color.h"

namespace pipeline {

// When a pixel was drawn, kept with its color in the byte that a Color leaves free: 0 for all that was drawn
// long ago, then a number for each of the latest batches.

constexpr std::uint32_t kMaxOrders = 0xff;

/// A color 0x00RRGGBB as that of the batch `order`, at most kMaxOrders.
constexpr Color with_order(Color color, std::uint32_t order) {
  assert(color.rgb() >> 24 == 0 && order <= kMaxOrders);
  return Color::from_rgb(color.rgb() | order << 24);
}

constexpr std::uint32_t order_of(Color color) {
  return color.rgb() >> 24;
}

constexpr Color without_order(Color color) {
  return Color::from_rgb(color.rgb() & 0xffffff);
}

}  // namespace pipeline
