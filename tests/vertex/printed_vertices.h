#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "tests/numbers/random_numbers.h"
#include "tests/vertex/reference_transforms.h"

namespace pipeline {

/// The number formats under test.
constexpr NumberFormat kFormats[] = {{7}, {0}, {12}, {17}, {.decimals = 0, .shortest = true}};

inline std::string to_text(const Vec3& v) {
  char text[120];
  std::snprintf(text, sizeof text, "(%.17g, %.17g, %.17g)", v.x, v.y, v.z);
  return text;
}

/// A coordinate up to `largest`: of any size, with 7 decimals, a whole number, or one that leads to ties.
inline double random_coordinate(RandomNumbers& random, double largest) {
  const double value = random.between(-largest, largest);
  switch (random.bits() % 8) {
    case 0:
      return std::nearbyint(value);
    case 1:
      return std::nearbyint(value * 256) / 256;
    case 2:
    case 3:
      return std::nearbyint(value * 1e7) / 1e7;
    case 4:
      return value * std::exp2(random.between(-40, 0));
    default:
      return value;
  }
}

inline Vec3 random_point(RandomNumbers& random, double largest) {
  const auto coordinate = [&] { return random_coordinate(random, largest); };
  return {coordinate(), coordinate(), coordinate()};
}

/// Triangles of these vertices; the last vertex is repeated to complete the last triangle.
inline TriangleBatch batch_of(const std::vector<Vec3>& vertices) {
  TriangleBatch batch;
  const auto vertex = [&](std::size_t i) { return vertices[std::min(i, vertices.size() - 1)]; };
  for (std::size_t i = 0; i < vertices.size(); i += 3)
    batch.add({vertex(i), vertex(i + 1), vertex(i + 2)}, i / 3, {i + 1, i + 2, i + 3});
  return batch;
}

inline std::string printed_vertex(const TriangleBatch& batch, std::size_t index, NumberFormat format) {
  const Vec3& hi = batch.triangles[index / 3][index % 3];
  const Vec3 lo = batch.low_parts.empty() ? Vec3() : batch.low_parts[index / 3][index % 3];
  return printed(hi.x, lo.x, format) + " " + printed(hi.y, lo.y, format) + " " + printed(hi.z, lo.z, format);
}

template <int bits>
std::string reference_vertex(const ReferenceVec3<bits>& p, NumberFormat format, const Real<bits>& size) {
  return reference_text(p.x, format, size) + " " + reference_text(p.y, format, size) + " " +
         reference_text(p.z, format, size);
}

/// Checks that every vertex of `images` prints like `reference` of its original vertex. `size` is the size of
/// the largest intermediate number.
template <int bits, typename Reference>
void expect_printed(const TriangleBatch& images, const std::vector<Vec3>& vertices, NumberFormat format,
                    const Real<bits>& size, Reference reference) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    ASSERT_EQ(printed_vertex(images, i, format),
              reference_vertex(reference(ReferenceVec3<bits>(vertices[i])), format, size))
        << "vertex " << to_text(vertices[i]);
}

/// Counts the printed numbers that differ from the reference.
struct DifferenceCount {
  std::uint64_t numbers = 0;
  std::uint64_t different = 0;
  std::string first;  // the vertex of the first different number

  void add(double hi, double lo, const Real<448>& truth, const Vec3& vertex) {
    static const Real<448> scale = power_of_ten<448>(7);
    char text[kMaxNumberLength];
    const char* const end = print_number(text, hi, lo, {7});
    const Real<448> truth_in_units = in_units(truth, scale);
    long units = 0;
    for (const char* c = text; c != end; ++c)
      if (*c >= '0' && *c <= '9') units = 10 * units + (*c - '0');
    ++numbers;
    const bool fits = end - text <= 18;  // more digits exceed a long's range
    if (fits && (text[0] == '-' ? -units : units) == truth_in_units.nearest_long()) return;
    if (!fits &&
        std::string_view(text, static_cast<std::size_t>(end - text)) == (truth_in_units / scale).text(7))
      return;
    if (different++ == 0) first = to_text(vertex);
  }
  /// All vertices of a batch, printed with 7 decimals.
  template <typename Reference>
  void add(const TriangleBatch& images, const std::vector<Vec3>& vertices, Reference reference) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const ReferenceVec3<448> truth = reference(ReferenceVec3<448>(vertices[i]));
      const Vec3& hi = images.triangles[i / 3][i % 3];
      const Vec3 lo = images.low_parts.empty() ? Vec3() : images.low_parts[i / 3][i % 3];
      add(hi.x, lo.x, truth.x, vertices[i]);
      add(hi.y, lo.y, truth.y, vertices[i]);
      add(hi.z, lo.z, truth.z, vertices[i]);
    }
  }
  void report(const std::string& what) const {
    std::printf("%s: %llu of %llu numbers differ from the reference\n", what.c_str(),
                static_cast<unsigned long long>(different), static_cast<unsigned long long>(numbers));
  }
};

}  // namespace pipeline
