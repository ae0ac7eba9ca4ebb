#pragma once

#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/visibility/algorithms.h"
#include "libpipeline/visibility/scanline.h"
#include "libpipeline/visibility/zbuffer.h"
#include "tests/visibility/frame.h"

namespace pipeline {

using Scene = std::vector<Triangle>;

// The marks for coordinates that are all decimals of at most 7 places.
inline constexpr std::uint16_t kAllDecimals = 0x1ff;

/// The tag of triangle `index`: never 0, the background's.
inline PixelTag tag_of(std::size_t index) {
  return static_cast<PixelTag>(index + 1);
}

template <typename Coverage, typename Depth>
Frame zbuffer_frame(const Scene& scene, const Viewport& screen, std::uint16_t marks = kAllDecimals) {
  const Coverage coverage(screen);
  ZBuffer<Depth> buffer(screen);
  for (std::size_t i = 0; i < scene.size(); ++i)
    for_each_span(coverage.rows({scene[i], nullptr, marks}),
                  [&](const Span& span) { buffer.draw(span, tag_of(i)); });
  return frame_of(buffer);
}

template <typename Coverage, typename Depth>
Frame scanline_frame(const Scene& scene, const Viewport& screen, std::uint16_t marks = kAllDecimals) {
  Scanline<Coverage, Depth> scanline(screen);
  for (std::size_t i = 0; i < scene.size(); ++i) scanline.draw({scene[i], nullptr, marks}, tag_of(i));
  return frame_of(scanline);
}

}  // namespace pipeline
