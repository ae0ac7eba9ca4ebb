#include "tools/rim/statistics.h"

#include <array>
#include <utility>

#include "libpipeline/text/text_writer.h"

namespace pipeline {
namespace {

std::string printed(const CoordinateExtent::Coordinate& coordinate, NumberFormat format) {
  std::array<char, kMaxNumberLength> text;
  return {text.data(), print_number(text.data(), coordinate.first, coordinate.second, format)};
}

}  // namespace

Statistics::Statistics(CommandLine& options) {
  options.add_word("--stats", "FILE", path_,
                   "Count what became of the triangles, one 'key value' per line; /dev/stderr shows them",
                   [](const std::string& path) {
                     return path == "-"
                                ? expected_but_found(
                                      "a file, as standard output carries the data (/dev/stderr shows them)",
                                      "'-'")
                                : std::string();
                   });
}

void Statistics::add(std::string_view key, std::uint64_t count) {
  lines_.append(key).append(" ").append(std::to_string(count)).append("\n");
}

void Statistics::add(const UnseenPlaces& unseen, bool on_screen) {
  constexpr std::array<std::pair<std::string_view, UnseenPlace>, 9> kKeys = {
      {{"behind", UnseenPlace::behind},
       {"outside_left", UnseenPlace::left},
       {"outside_right", UnseenPlace::right},
       {"outside_below", UnseenPlace::below},
       {"outside_above", UnseenPlace::above},
       {"outside_near", UnseenPlace::near},
       {"outside_far", UnseenPlace::far},
       {"without_area", UnseenPlace::without_area},
       {"between_centers", UnseenPlace::between_centers}}};
  for (const auto& [key, place] : kKeys)
    if (on_screen ? place != UnseenPlace::behind : place < UnseenPlace::without_area)
      add(key, unseen[place].count);
}

void Statistics::add(const CoordinateExtent& extent, NumberFormat format) {
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  for (std::size_t i = 0; i < kAxes.size(); ++i)
    if (const auto& range = extent.ranges()[i]) add_range(kAxes[i], *range, format);
}

void Statistics::add(const BoundingBox& extent) {
  const auto& [low, high] = extent;
  if (low.x > high.x) return;
  add_range("x", {{low.x, 0}, {high.x, 0}}, kShortest);
  add_range("y", {{low.y, 0}, {high.y, 0}}, kShortest);
  add_range("z", {{low.z, 0}, {high.z, 0}}, kShortest);
}

void Statistics::add_range(std::string_view axis, const CoordinateExtent::Range& range, NumberFormat format) {
  lines_.append(axis).append("_min ").append(printed(range.low, format)).append("\n");
  lines_.append(axis).append("_max ").append(printed(range.high, format)).append("\n");
}

void Statistics::finish() {
  if (!file_) return;
  write_all(file_->descriptor(), lines_, path_);
  file_->close();
}

}  // namespace pipeline
