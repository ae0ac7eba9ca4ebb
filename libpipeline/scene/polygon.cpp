#include "libpipeline/scene/polygon.h"

#include <array>
#include <numeric>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

/// Twice the area of a triangle in x and y, negative if it is clockwise.
double area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon projected into the coordinate plane where it is largest, as counterclockwise x and y.
std::vector<Vec3> flattened(std::span<const Vec3> polygon) {
  Vec3 n;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    n = sum(n, face_normal({polygon[0], polygon[i], polygon[i + 1]}));
  const double largest = largest_in(n);
  const bool is_z = std::fabs(n.z) == largest, is_y = !is_z && std::fabs(n.y) == largest,
             is_x = !is_z && !is_y;
  std::vector<Vec3> flat;
  for (const Vec3& p : polygon) {
    const Vec3 q = is_x ? Vec3{p.y, p.z} : is_y ? Vec3{p.z, p.x} : Vec3{p.x, p.y};
    flat.push_back((is_x ? n.x : is_y ? n.y : n.z) < 0 ? Vec3{q.y, q.x} : q);
  }
  return flat;
}

/// True if the triangle of these corners has no area, or is counterclockwise and holds none of `others`.
bool is_ear(const std::vector<Vec3>& points, const std::array<std::uint32_t, 3>& corners,
            const std::vector<std::uint32_t>& others) {
  const Vec3 &a = points[corners[0]], &b = points[corners[1]], &c = points[corners[2]];
  const double size = area(a, b, c);
  if (size <= 0) return size == 0;
  return std::ranges::none_of(others, [&](std::uint32_t other) {
    const Vec3& p = points[other];
    return p != a && p != b && p != c && area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
  });
}

}  // namespace

bool append_triangles(std::span<const Vec3> polygon, std::vector<std::uint32_t>& indices) {
  if (polygon.size() == 3) {
    indices.insert(indices.end(), {0, 1, 2});
    return true;
  }
  const std::vector<Vec3> points = flattened(polygon);
  std::vector<std::uint32_t> left(points.size()), not_convex;
  std::iota(left.begin(), left.end(), 0);
  const auto ear_at = [&](std::size_t i) {
    return std::array{left[(i + left.size() - 1) % left.size()], left[i], left[(i + 1) % left.size()]};
  };
  for (const std::uint32_t i : left)
    if (const auto [a, b, c] = ear_at(i); !(area(points[a], points[b], points[c]) > 0))
      not_convex.push_back(i);
  // At most one vertex of four can be concave: both triangles begin at it.
  const bool is_ready = left.size() == 4;
  std::size_t i = is_ready && not_convex.size() == 1 ? not_convex[0] : 0, steps = 0;
  for (std::size_t misses = 0; !is_ready && left.size() > 3 && misses <= left.size();) {
    constexpr std::size_t kMostSteps = 2'000'000'000;
    steps += not_convex.size() + left.size() / 16;
    if (steps > kMostSteps) return false;
    i = i < left.size() ? i : 0;
    const std::array<std::uint32_t, 3> ear = ear_at(i);
    if (is_ear(points, ear, not_convex)) {
      indices.insert(indices.end(), ear.begin(), ear.end());
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      misses = 0;
    } else {
      ++misses, ++i;
    }
  }
  for (std::size_t k = 1; k + 1 < left.size(); ++k)
    indices.insert(indices.end(),
                   {left[i % left.size()], left[(i + k) % left.size()], left[(i + k + 1) % left.size()]});
  return true;
}

void append_strip(std::span<const std::uint32_t> strip, bool is_fan, std::vector<std::uint32_t>& corners) {
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const std::uint32_t a = strip[is_fan ? 0 : i - 2 + i % 2], b = strip[is_fan ? i - 1 : i - 1 - i % 2],
                        c = strip[i];
    if (a != b && b != c && c != a) corners.insert(corners.end(), {a, b, c});
  }
}

}  // namespace pipeline
