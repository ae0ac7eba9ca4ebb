#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

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

/// The reason why a surface looks black.
enum class Darkness {
  no_color,          // all channels of its color are 0
  unit_color,        // no channel exceeds 1
  small_color,       // its channels are small
  sends_rays,        // mirrors and glass, which show a black background
  cut_rays,          // mirrors and glass whose rays are cut
  no_reflectance,    // the material has no diffuse or specular one
  highlights_alone,  // the material is not diffuse
  no_intensity,      // every light has 0
  averted,           // lights are on the other side
  in_shadow,
  weak_light,
  weakened_light,  // by attenuation
  grazing_light,
};
constexpr std::size_t kDarknessCount = static_cast<std::size_t>(Darkness::grazing_light) + 1;

/// A surface that looks black, and its light.
struct DarkSurface {
  /// The greatest channel of its color; none if it only mirrors light or lets it through.
  std::optional<double> greatest_channel;
  Material material = {};
  double light_in_front = 0;  // the greatest intensity of the lights in front of it,
  double light_arriving = 0;  // and of their light that arrives at it
  double part_left = 0;       // the greatest part of such a light that attenuation leaves
  bool has_cut_rays = false;
};

/// Statistics of colors, for the note on a picture that hardly shows anything.
struct ShownColors {
  struct Dark {
    std::uint64_t count = 0;  // of pixels
    double greatest = 0;      // for small_color, of the channels; else, of the light that arrives
  };

  /// A picture gets the note if fewer than this share of the drawn pixels show.
  static constexpr double kVisibleShare = 0.03;

  /// Adds the color of a surface at a pixel. True if it looks black: the next `add` is for the reason.
  bool add(Color color, Color background, bool is_lit);
  void add(const DarkSurface& surface, std::uint64_t pixel_count, const Lighting& lighting, bool is_lit);
  void add(const ShownColors& others);
  [[nodiscard]] std::uint64_t count() const {
    std::uint64_t sum = visible + as_background + white;
    for (const Dark& some : dark) sum += some.count;
    return sum;
  }

  std::uint64_t visible = 0, as_background = 0;
  std::uint64_t white = 0;                     // white though lit
  std::array<Dark, kDarknessCount> dark = {};  // by Darkness
  std::optional<Color> first;
  bool is_varied = false;    // some color differs from the first
  bool has_surface = false;  // even if not counted
};

}  // namespace pipeline
