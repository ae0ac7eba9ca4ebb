#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "libpipeline/picture/shading.h"
#include "libpipeline/scene/color.h"

namespace pipeline {

/// The largest channel of a color that looks black.
constexpr double kBlackChannel = 8;

/// A quick test for most visible colors: true if not pure white and some channel exceeds kBlackChannel.
constexpr bool looks_colored(Color color) {
  constexpr std::uint32_t kToHighBit = 128 - static_cast<std::uint32_t>(kBlackChannel) - 1,
                          kChannels = 0x010101;
  const std::uint32_t rgb = color.rgb();
  const std::uint32_t beyond = (rgb & (0x7f * kChannels)) + kToHighBit * kChannels;
  return ((beyond | rgb) & (0x80 * kChannels)) != 0 && rgb < 0xffffff;
}

/// Why a surface looks black.
enum class Darkness {
  no_color,          // its channels are 0
  unit_color,        // at most 1
  small_color,       // or hardly more
  sends_rays,        // mirrors and glass, which show a black background
  cut_rays,          // likewise, but their rays are cut
  no_reflectance,    // of the material
  highlights_alone,  // the material is not diffuse
  no_intensity,      // of any light
  averted,           // lights are on the other side
  in_shadow,
  weak_light,
  weakened_light,  // by attenuation
  grazing_light,
};
constexpr std::size_t kDarknessCount = static_cast<std::size_t>(Darkness::grazing_light) + 1;

/// What is known of a surface that looks black.
struct DarkSurface {
  /// The greatest channel of its color; none where only what it mirrors or lets through counts.
  std::optional<double> greatest_channel;
  Material material = {};
  double light_in_front = 0;  // the greatest intensity of lights in front of it,
  double light_arriving = 0;  // and of those less what the way to it takes
  bool has_cut_rays = false;
};

/// Statistics of colors, for the note on a picture that hardly shows anything.
struct ShownColors {
  struct Dark {
    std::uint64_t count = 0;  // of pixels
    double greatest = 0;      // channel of the colors, or intensity of the lights in front, if these are why
  };

  /// Less of the pixels that are drawn is hardly anything.
  static constexpr double kVisibleShare = 0.03;

  /// Adds the color of a surface at a pixel. True if it looks black: `add` is to get the reason.
  bool add(Color color, Color background, bool is_lit);
  void add(const DarkSurface& surface, std::uint64_t pixel_count, const Lighting& lighting, bool is_lit);
  void add(const ShownColors& others);
  [[nodiscard]] std::uint64_t dark_count() const;
  [[nodiscard]] std::uint64_t count() const { return visible + as_background + white + dark_count(); }

  std::uint64_t visible = 0, as_background = 0;
  std::uint64_t white = 0;                     // though lit
  std::array<Dark, kDarknessCount> dark = {};  // by Darkness
  std::optional<Color> first;
  bool is_varied = false;    // some color is not the first
  bool has_surface = false;  // counted or not
};

}  // namespace pipeline
