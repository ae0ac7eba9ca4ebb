#include "libpipeline/raytracing/sampling.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace pipeline {
namespace {

/// The numbers of the generator SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number
/// generators", 2014), by their index in its sequence.
std::uint64_t random_bits(std::uint64_t place) {
  constexpr std::uint64_t kSeed = 1;
  std::uint64_t bits = kSeed + (place + 1) * 0x9e3779b97f4a7c15u;
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
  return bits ^ bits >> 31;
}

}  // namespace

SamplePlaces::SamplePlaces(const Viewport& pixels, int count, bool are_random)
    : screen_(pixels), count_(count), places_(are_random ? kJitterPlaces : 1) {
  // CenterBox packs a row and two more bits into 32.
  assert(count >= 1 && count <= (1 << 30) / kMaxViewportSize / kJitterPlaces);
  const int factor = count * places_;
  screen_.columns *= factor;
  screen_.rows *= factor;
  screen_.drawn = {factor * pixels.drawn_rows().first, factor * pixels.drawn_rows().end};
}

SamplePlaces::Place SamplePlaces::of(int row, int column, int sample) const {
  const Place cell = {row * count_ + sample / count_, column * count_ + sample % count_};
  if (places_ == 1) return cell;
  // A distinct number for each sample: rows and columns have 16 bits, samples 8.
  const std::uint64_t bits =
      random_bits(static_cast<std::uint64_t>(row) << 24 | static_cast<std::uint64_t>(column) << 8 |
                  static_cast<std::uint64_t>(sample));
  return {cell.row * kJitterPlaces + static_cast<int>(bits % kJitterPlaces),
          cell.column * kJitterPlaces + static_cast<int>(bits / kJitterPlaces % kJitterPlaces)};
}

std::vector<int> sample_order(int count) {
  std::vector<int> samples(static_cast<std::size_t>(count) * static_cast<std::size_t>(count));
  std::iota(samples.begin(), samples.end(), 0);
  const auto is_at_end = [&](int place) { return place == 0 || place == count - 1; };
  std::stable_partition(samples.begin(), samples.end(), [&](int sample) {
    return sample == count / 2 * count + count / 2 ||
           (is_at_end(sample / count) && is_at_end(sample % count));
  });
  return samples;
}

int largest_difference(std::span<const Color> colors) {
  int largest = 0;
  for (const int shift : {0, 8, 16, 24}) {
    const auto channel = [&](Color color) { return static_cast<int>(color.rgb() >> shift & 0xff); };
    const auto [least, greatest] = std::ranges::minmax_element(colors, {}, channel);
    largest = std::max(largest, channel(*greatest) - channel(*least));
  }
  return largest;
}

}  // namespace pipeline
