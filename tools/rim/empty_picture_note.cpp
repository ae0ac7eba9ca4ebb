#include "tools/rim/empty_picture_note.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/scene/appearance.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

/// "the triangle", "all 2 triangles".
std::string all_of(std::uint64_t count, const std::string& thing) {
  return count == 1 ? "the " + thing : "all " + counted(count, thing);
}

/// The value with four digits, or with as many as show on which side of `limit` it lies.
std::string rounded(double value, double limit) {
  std::array<char, 32> text{};
  for (int digits = 4; digits <= 17; ++digits) {
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    const double shown = std::strtod(text.data(), nullptr);
    if ((shown < limit) == (value < limit) && (shown > limit) == (value > limit)) break;
  }
  return text.data();
}

std::string rounded(double value) {
  return rounded(value, value < 0 ? value - 1 : value + 1);
}

/// "x from -3 to -1.5", or "x is 2".
std::string range(char axis, double low, double high, double limit) {
  const std::string from = rounded(low, limit), to = rounded(high, limit);
  return axis + (from == to ? " is " + from : " from " + from + " to " + to);
}

/// "left of the window"
std::string beside(UnseenPlace place, const std::string& what) {
  constexpr std::array kSides = {"left of", "right of", "below", "above"};
  const auto side = static_cast<std::size_t>(place) - static_cast<std::size_t>(UnseenPlace::left);
  return kSides[side] + (" the " + what);
}

/// "beyond the rear limit (z is 0.6, the limit of the config is 0.5)"; or, if the limit is a plane of the
/// camera, "beyond the rear limit (z is 0.6, the limit is 0.5, the camera's far)".
std::string past_limit(UnseenPlace place, const BoundingBox& extent, double limit, bool is_plane,
                       const std::string& space = "") {
  const bool is_near = place == UnseenPlace::near;
  return (is_near ? "before the front limit (" : "beyond the rear limit (") +
         range('z', extent.low.z, extent.high.z, limit) + space + ", the limit " +
         (is_plane ? "" : "of the config ") + "is " + rounded(limit) +
         (is_plane ? is_near ? ", the camera's near)" : ", the camera's far)" : ")");
}

/// "left of the window (x from -3 to -1.5, the window from -1 to 1)"
std::string beside_window(UnseenPlace place, const BoundingBox& extent, const Viewport& screen) {
  const bool is_low = place == UnseenPlace::left || place == UnseenPlace::below;
  const bool is_x = place == UnseenPlace::left || place == UnseenPlace::right;
  const double limit = is_x ? screen.left : screen.bottom, side = is_low ? limit : -limit;
  const double low = is_x ? extent.low.x : extent.low.y, high = is_x ? extent.high.x : extent.high.y;
  const bool is_past_corner = is_low ? high >= side : low <= side;
  return beside(place, "window") + (is_past_corner ? ", past its corner" : "") + " (" +
         range(is_x ? 'x' : 'y', low, high, side) + ", the window from " + rounded(limit) + " to " +
         rounded(-limit) + ")";
}

std::string where_on_screen(UnseenPlace place, const BoundingBox& extent, const Viewport& screen) {
  switch (place) {
    case UnseenPlace::near:
      return past_limit(place, extent, screen.front, screen.front == -1);
    case UnseenPlace::far:  // perhaps at the limit itself, which belongs to no pixel
      if (extent.low.z == 1 && extent.high.z == 1 && screen.rear == 1)
        return "at the camera's far, which shows nothing (z is 1, perhaps rounded: a near that is too close "
               "to the eye leaves z no digits)";
      return past_limit(place, extent, screen.rear, screen.rear == 1);
    case UnseenPlace::without_area:
      return "without area on the screen, as when seen edge-on";
    case UnseenPlace::between_centers:
      return "between pixel centers (a pixel is " + rounded(screen.dx()) + " by " + rounded(screen.dy()) +
             ")";
    default:
      return beside_window(place, extent, screen);
  }
}

std::string behind_eye(const BoundingBox& extent) {
  return "behind the eye (" + range('z', extent.low.z, extent.high.z, 0) +
         " in view space; the camera looks down -z: turn it around, or move it back by more than " +
         rounded(extent.high.z) + ")";
}

std::string where_in_view_space(UnseenPlace place, const BoundingBox& extent) {
  const std::string z = " (" + range('z', extent.low.z, extent.high.z, 0) + ")";
  if (place == UnseenPlace::behind) return behind_eye(extent);
  if (place == UnseenPlace::near) return "nearer than the near plane" + z;
  return place == UnseenPlace::far ? "beyond the far plane" + z : beside(place, "view volume");
}

std::string where_is_sphere(UnseenPlace place, const BoundingBox& extent, const UnseenSpheres& spheres) {
  const std::string space = " in view space";
  if (place == UnseenPlace::behind) return behind_eye(extent);
  if (place == UnseenPlace::near)
    return past_limit(place, extent, spheres.front, spheres.front_is_near, space);
  if (place == UnseenPlace::far) return past_limit(place, extent, spheres.rear, spheres.rear_is_far, space);
  return place == UnseenPlace::elsewhere ? "met by no ray between the limits of Z" : beside(place, "window");
}

/// The count of some triangles, and their place in words.
using Group = std::pair<std::uint64_t, std::string>;

/// The triangles by place, as `where` describes it.
template <typename Where>
std::vector<Group> groups_of(const UnseenPlaces& unseen, const Where& where) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < unseen.groups.size(); ++i)
    if (const auto& [count, extent] = unseen.groups[i]; count > 0)
      groups.emplace_back(count, where(static_cast<UnseenPlace>(i), extent));
  return groups;
}

/// "all 3 triangles are behind the eye", or "none of 3 triangles is left: 2 behind the eye, 1 culled".
std::string list_of(const std::vector<Group>& groups, const std::string& none_of,
                    const std::string& thing = "triangle") {
  if (groups.size() == 1)
    return all_of(groups[0].first, thing) + (groups[0].first == 1 ? " is " : " are ") + groups[0].second;
  std::uint64_t count = 0;
  std::string list;
  for (const auto& [group_count, place] : groups) {
    count += group_count;
    list += (list.empty() ? ": " : ", ") + std::to_string(group_count) + " " + place;
  }
  return "none of " + counted(count, thing) + " " + none_of + list;
}

/// "97.5 %", never rounded up to 100.
std::string percent(std::uint64_t part, std::uint64_t all) {
  const double share = static_cast<double>(part) / static_cast<double>(all);
  return rounded(share < 0.9995 ? std::floor(1000 * share) / 10 : std::floor(1e6 * share) / 1e4, 100) + " %";
}

/// True if the other pixels are so few that they hardly count.
bool is_most(std::uint64_t part, std::uint64_t all) {
  return static_cast<double>(all - part) < ShownColors::kVisibleShare * static_cast<double>(all);
}

/// True for whole channels up to 255, one of them too large for an intensity of light.
bool is_like_color(Vec3 channels) {
  const auto is_whole = [](double channel) { return channel == std::floor(channel); };
  return largest_in(channels) >= 32 && largest_in(channels) <= 255 && is_whole(channels.x) &&
         is_whole(channels.y) && is_whole(channels.z);
}

/// Indexed by Darkness; # stands for the greatest value, "its" refers to what is black.
constexpr std::array<const char*, kDarknessCount> kReasons = {
    "its colors are 0",
    "its colors lie between 0 and 1, but channels run from 0 to 255",
    "no channel of its colors is above #, but channels run from 0 to 255",
    "mirrors and glass alone are seen, and they show a black background",
    "rays that may bring light are cut (--max-depth, --min-contribution)",
    "the material reflects no light but the ambient (of 'material KA KD KS N', KD and KS are 0)",
    "the material reflects highlights alone (of 'material KA KD KS N', KD is 0 or hardly more)",
    "every light has the intensity 0 (the last three numbers of 'light'; 1 is full)",
    "no light reaches the side that is seen (put a light on the eye's side; ambient 0.2 0.2 0.2 would show "
    "it from anywhere)",
    "all that is seen is in shadow (--no-shadows lights it; ambient 0.2 0.2 0.2 would show it, too)",
    "the light on the side that is seen is too weak (its intensity is #; 1 is full)",
    "the light on the side that is seen is too weak (its intensity is #, and attenuation weakens it: '1 0 0' "
    "would not)",
    "light only grazes the side that is seen, or is of another color: put a white light in front of it"};

/// "the picture is black: ", or "97.5 % of what is drawn is black: "
std::string looks(std::uint64_t count, std::uint64_t all, const std::string& color, bool is_picture) {
  if (count == all) return (is_picture ? "the picture is " : "the surfaces are ") + color + ": ";
  return percent(count, all) + " of what is drawn is " + color + ": ";
}

/// The reason why the drawn surfaces look black; none if enough do not.
std::optional<std::string> dark_note(const ShownColors& shown, const ColorSetting& setting) {
  constexpr double kBright = 128;  // before this, black surfaces are silhouettes
  const double background = setting.background.is_opaque() ? largest_in(to_vec3(setting.background)) : 255;
  const auto is_odd = [&](Darkness reason) {
    if (background <= kBlackChannel) return true;
    return reason == Darkness::unit_color || (reason >= Darkness::no_reflectance && background < kBright);
  };
  std::uint64_t count = 0, of_most = 0;
  std::string reason;
  for (std::size_t i = 0; i < shown.dark.size(); ++i) {
    const auto& [count_of_this, greatest] = shown.dark[i];
    if (!is_odd(static_cast<Darkness>(i))) continue;
    count += count_of_this;
    if (count_of_this <= of_most) continue;
    of_most = count_of_this;
    reason = kReasons[i];
    if (const std::size_t at = reason.find('#'); at != std::string::npos)
      reason.replace(at, 1, rounded(greatest));
  }
  if (!is_most(count, shown.count())) return std::nullopt;
  return looks(count, shown.count(), "black", background <= kBlackChannel) +
         (is_most(of_most, count) ? "" : "for " + percent(of_most, count) + " of that, ") + reason;
}

}  // namespace

std::string empty_scene_note(std::uint64_t triangle_count, const std::optional<SourceLocation>& scale_by_0) {
  if (triangle_count == 0) return "the picture will be empty: the scene has no triangle";
  return (scale_by_0 ? to_string(*scale_by_0) + ": this scale by 0 leaves " : "") +
         all_of(triangle_count, "triangle") + " without area" +
         (scale_by_0 ? "; 1 keeps a direction as it is" : "");
}

std::string dropped_note(const UnseenPlaces& outside, std::uint64_t culled_count) {
  std::vector<Group> groups = groups_of(outside, where_in_view_space);
  if (culled_count > 0) groups.emplace_back(culled_count, "dropped by --cull");
  return "the picture will be empty: " + list_of(groups, "is left");
}

std::string radians_note(double fov_y_degrees, std::uint64_t hidden_count, bool is_filled) {
  return std::string(is_filled ? "no vertex" : "nothing") + " is in view, but with a fovY of " +
         rounded(fov_y_degrees * 180 / std::numbers::pi) + " degrees in place of " + rounded(fov_y_degrees) +
         ", " + (is_filled ? "those of " : "") + counted(hidden_count, "triangle") +
         " would be: angles are in degrees; was this one in radians?";
}

std::optional<std::string> bright_light_note(const Appearance& appearance) {
  const auto note = [](const SourceLocation& location, const char* name, double intensity) {
    return to_string(location) + ": " + name + " of " + rounded(intensity) + " is " + rounded(intensity) +
           " times full light: 1 is full, so divide by 255 if this is a color";
  };
  if (appearance.ambient && is_like_color(appearance.ambient->value))
    return note(appearance.ambient->location, "ambient light", largest_in(appearance.ambient->value));
  if (appearance.attenuation) return std::nullopt;
  for (const Located<Light>& light : appearance.lights)
    if (is_like_color(light.value.intensity))
      return note(light.location, "a light", largest_in(light.value.intensity));
  return std::nullopt;
}

std::string unseen_note(const UnseenPlaces& unseen, const Viewport& screen, bool is_empty) {
  const auto groups = groups_of(unseen, [&](UnseenPlace place, const BoundingBox& extent) {
    return where_on_screen(place, extent, screen);
  });
  return (is_empty ? "the picture is empty: " : "only lines show: ") +
         (groups.empty() ? "no triangle came" : list_of(groups, "shows"));
}

std::string speck_note(const BoundingBox& extent, const Viewport& screen) {
  const auto pixels = [](double length, double pixel) {
    return std::to_string(std::lround(length / pixel) + 1);
  };
  return "all that is drawn lies within " + pixels(extent.high.x - extent.low.x, screen.dx()) + " x " +
         pixels(extent.high.y - extent.low.y, screen.dy()) + " pixels of " + std::to_string(screen.columns) +
         " x " + std::to_string(screen.rows) +
         (std::min(screen.left, screen.bottom) < -10
              ? ": what is in view lies from -1 to 1, but the config's window begins at " +
                    rounded(screen.left) + " " + rounded(screen.bottom) + "; are these pixels?"
              : ": it is too small or too far away, or the view is too wide");
}

std::string unseen_spheres_note(const UnseenSpheres& spheres) {
  const auto groups = groups_of(spheres.places, [&](UnseenPlace place, const BoundingBox& extent) {
    return where_is_sphere(place, extent, spheres);
  });
  return "the picture is empty: " + list_of(groups, "shows", "sphere");
}

std::optional<std::string> opaque_note(const Appearance& appearance) {
  if (std::ranges::none_of(appearance.materials, &Material::sends_rays, &Located<Material>::value))
    return std::nullopt;
  return "mirrors and glass are drawn as matte and opaque; trace, in place of project and zbuf, follows the "
         "light";
}

std::optional<std::string> odd_colors_note(const ShownColors& shown, const ColorSetting& setting) {
  const std::uint64_t all = shown.count();
  if (!shown.has_surface && setting.is_wireframe)
    return "the picture is empty: --wireframe shows edges alone, and none is in sight";
  if (all == 0) return std::nullopt;
  if (auto note = dark_note(shown, setting)) return note;
  if (is_most(shown.white, all) && !setting.has_noted_brightness)
    return looks(shown.white, all, "white", true) +
           "the light or a material is too bright (1 is full, also for KA, KD and KS; several lights add up)";
  if (!is_most(shown.as_background, all)) return std::nullopt;
  if (shown.as_background == all) return "the picture is empty: what is seen has the color of the background";
  return percent(shown.as_background, all) + " of what is drawn has the color of the background";
}

}  // namespace pipeline
