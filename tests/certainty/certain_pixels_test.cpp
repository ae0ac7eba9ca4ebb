#include "libpipeline/certainty/certain_pixels.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace pipeline {
namespace {

constexpr Viewport kScreen = {8, 6, -1.5, -0.75, -1.25, 0.875};

struct TruePixel {
  bool is_covered = false, is_visible = false;
  mpq_class depth = 0;
};

/// A projection, and how far vertices in view space are from the true ones: by at most `error` on each axis.
struct Scene {
  [[nodiscard]] Projection projection() const {
    if (!is_perspective) return volume;
    return Frustum{volume.left, volume.right, volume.bottom, volume.top, volume.near, volume.far};
  }
  /// The image of a view-space point in clip space without z, and its distance in front of the eye.
  template <typename Number>
  [[nodiscard]] std::array<Number, 4> clip(const std::array<Number, 3>& p) const {
    const Number size = is_perspective ? 2 * Number(volume.near) : Number(2);
    const Number w = is_perspective ? Number(-p[2]) : Number(1);
    const Number left(volume.left), right(volume.right), bottom(volume.bottom), top(volume.top);
    return {Number((size * p[0] - (right + left) * w) / (right - left)),
            Number((size * p[1] - (top + bottom) * w) / (top - bottom)), w, Number(-p[2])};
  }

  bool is_perspective;
  Orthographic volume;  // or a frustum
  double error;
};

using Points = std::array<std::array<double, 3>, 3>;

/// The pixel of the true triangle, by rational numbers, straight from the definition.
TruePixel true_pixel(const Scene& scene, const Points& p_view, int row, int column) {
  const mpq_class left(kScreen.left), bottom(kScreen.bottom);
  const mpq_class x = left - left * (2 * column + 1) / kScreen.columns;
  const mpq_class y = -bottom + bottom * (2 * row + 1) / kScreen.rows;
  std::array<std::array<mpq_class, 4>, 3> v;  // as seen from the center
  mpq_class least_w;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = scene.clip<mpq_class>({mpq_class(p_view[i][0]), mpq_class(p_view[i][1]), mpq_class(p_view[i][2])});
    v[i][0] -= x * v[i][2];
    v[i][1] -= y * v[i][2];
    if (i == 0 || v[i][2] < least_w) least_w = v[i][2];
  }
  std::array<mpq_class, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = v[(i + 1) % 3], &b = v[(i + 2) % 3];
    weights[i] = a[0] * b[1] - a[1] * b[0];
  }
  const mpq_class sum = weights[0] + weights[1] + weights[2];
  TruePixel pixel;
  const auto has_sign = [&](int sign) {
    return std::ranges::all_of(weights, [sign](const mpq_class& weight) { return sgn(weight) == sign; });
  };
  if (!has_sign(1) && !has_sign(-1)) return pixel;
  mpq_class distance;
  for (std::size_t i = 0; i < 3; ++i) distance += weights[i] * v[i][3] / sum;
  if (scene.is_perspective && distance <= 0) return pixel;
  pixel.is_covered = true;
  pixel.depth = scene.is_perspective ? mpq_class(-1 / distance) : distance;
  const bool is_cut = scene.is_perspective && least_w * 1024 < mpq_class(scene.volume.near);
  pixel.is_visible = !is_cut || distance >= mpq_class(scene.volume.near);
  return pixel;
}

/// The triangle as its text has it; cut ones come with all of the triangle in clip space.
TriangleBatch projected(const Scene& scene, const Points& p_view) {
  TriangleBatch batch;
  Triangle p_ndc;
  std::array<double, 3> ws;
  auto whole = std::make_shared<ClipTriangle>();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [x, y, w, distance] = scene.clip(p_view[i]);
    const double z =
        (2 * distance - scene.volume.far - scene.volume.near) / (scene.volume.far - scene.volume.near);
    p_ndc[i] = {x / w, y / w, scene.is_perspective ? 0 : z};
    ws[i] = w;
    (*whole)[i].position = {x, y, 0};
    (*whole)[i].w = w;
  }
  batch.add(p_ndc, 7, {});
  batch.attributes.w = {ws};
  if (scene.is_perspective && *std::ranges::min_element(ws) < scene.volume.near / 1024)
    batch.set_last_unclipped(whole);
  return batch;
}

Bounds bounds_of(const Scene& scene) {
  return {.error = {scene.error, 0}, .rounded = ErrorBound{1e-15, 1e-15}, .space = Bounds::kSpaces[2]};
}

struct Random {
  double within(double low, double high) { return std::uniform_real_distribution(low, high)(engine); }

  std::mt19937_64 engine;
};

Scene random_scene(Random& random) {
  const double error = std::pow(10, random.within(-7, -1)), near = std::pow(10, random.within(-3, 0));
  const double shift = random.within(-0.4, 0.4), size = random.within(0.2, 2);
  if (random.within(0, 1) < 0.3)
    return {false, {-2 + shift, 2, -size, size + shift, random.within(-3, 1), 9}, error};
  return {true, {near * (shift - 1), near, -near * size, near * (size + shift), near, near * 100}, error};
}

Points random_points(const Scene& scene, Random& random) {
  const double spread = random.within(0, 1) < 0.3 ? 0.01 : 3, away = random.within(-1, 4);
  const bool is_edge_on = random.within(0, 1) < 0.2;
  Points points;
  for (auto& p : points) {
    p = {random.within(-spread, spread), random.within(-spread, spread),
         random.within(-spread, spread) - away};
    if (is_edge_on) p[1] = 0.3 * p[2] + scene.error * random.within(-1, 1);
  }
  return points;
}

Points moved(const Scene& scene, const Points& points, Random& random) {
  const bool is_farthest = random.within(0, 1) < 0.7;
  Points result = points;
  for (auto& p : result)
    for (double& x : p) {
      const double by = random.within(-1, 1);
      x += scene.error * (1 - 1e-9) * (is_farthest ? std::copysign(1, by) : by);
    }
  return result;
}

TEST(UncertainTriangle, HasEveryTrueTriangleWithinTheBoundsAndItsDepths) {
  Random random;
  int sure_count = 0, visible_count = 0, possible_count = 0;
  for (int round = 0; round < 400; ++round) {
    const Scene scene = random_scene(random);
    const Points points = random_points(scene, random);
    const UncertainView view(kScreen, bounds_of(scene), scene.projection());
    const UncertainTriangle triangle = view.triangle(projected(scene, points), 0);
    const Points of_truth = moved(scene, points, random);
    const mpq_class front(view.depths_at(kScreen.front)[0]);
    for (int row = 0; row < kScreen.rows; ++row) {
      const bool has_row = row >= triangle.rows.first && row < triangle.rows.end;
      const auto on = has_row ? triangle.row(row) : UncertainTriangle::Row{{0, 0}, {0, 0}, 0, 0};
      for (int column = 0; column < kScreen.columns; ++column) {
        const int at = column - triangle.columns.first;
        const auto has = [at](const RowRange& range) { return at >= range.first && at < range.end; };
        const TruePixel pixel = true_pixel(scene, of_truth, row, column);
        const bool is_shown = pixel.is_visible && pixel.depth >= front;
        const std::string trace = "round " + std::to_string(round) + ", row " + std::to_string(row) +
                                  ", column " + std::to_string(column);
        if (is_shown) {
          ASSERT_TRUE(has(on.possible)) << trace;
          ASSERT_TRUE(triangle.nearest(on, at) <= pixel.depth) << trace;
        }
        if (has(on.sure)) {
          ASSERT_TRUE(has(on.possible) && is_shown) << trace;
          ASSERT_TRUE(triangle.farthest(on, at) >= pixel.depth) << trace;
        }
        possible_count += has(on.possible);
        visible_count += is_shown;
        sure_count += has(on.sure);
      }
    }
  }
  EXPECT_GT(sure_count, visible_count * 2 / 3);
  EXPECT_LT(possible_count, visible_count * 2);
}

/// Rows of a picture: for each pixel whether it certainly shows triangle 7 (#), none (.) or is uncertain (?).
std::vector<std::string> drawn(const TriangleBatch& batch, const Scene& scene) {
  std::vector<std::string> rows(kScreen.rows, std::string(kScreen.columns, '?'));
  for (const auto& [number, sign] : {std::pair(7, '#'), std::pair(-1, '.')}) {
    CertainPixels pixels(kScreen, bounds_of(scene), scene.projection());
    pixels.add(batch);
    for (int row = 0; row < kScreen.rows; ++row)
      pixels.add_row(std::vector<std::int64_t>(kScreen.columns, number));
    const std::string report = pixels.report();
    for (int row = 0; row < kScreen.rows; ++row)
      for (int column = 0; column < kScreen.columns; ++column)
        if (report.find("\n" + std::to_string(row) + " " + std::to_string(column) + "\n") ==
            std::string::npos)
          rows[row][column] = sign;
  }
  return rows;
}

// View space is NDC. The left edge may reach the first column's centers at -1.3125, but for
// the rounding of the calculation.
constexpr Scene kBoxes = {false, {-1, 1, -1, 1, 0, 8}, 0.0625};
constexpr Points kLeftHalf = {{{-1.25, 9, -4}, {-1.25, -9, -4}, {0, 0, -4}}};

TEST(CertainPixels, PixelsAreUncertainWhereAnEdgeMayCrossTheirCenters) {
  EXPECT_EQ(drawn(projected(kBoxes, kLeftHalf), kBoxes)[2], "?###....");
  constexpr Scene kLess = {false, kBoxes.volume, 0.06};
  EXPECT_EQ(drawn(projected(kLess, kLeftHalf), kLess)[2], ".###....");
}

TEST(CertainPixels, LayersAreUncertainWhereTheyMayBeEquallyFar) {
  for (const auto& [gap, row] : {std::pair(0.124, "????...."), std::pair(0.126, "?###....")}) {
    TriangleBatch batch = projected(kBoxes, kLeftHalf);
    Points farther = kLeftHalf;
    for (auto& p : farther) p[2] -= gap;
    const TriangleBatch other = projected(kBoxes, farther);
    batch.add(other.triangles[0], 8, {});
    batch.attributes.w.push_back(other.attributes.w[0]);
    EXPECT_EQ(drawn(batch, kBoxes)[2], row);
  }
}

TEST(CertainPixels, NothingIsCertainWhereATriangleMayBeAnywhere) {
  const Scene scene = {true, {-1, 1, -1, 1, 1, 9}, 0.6};
  const TriangleBatch batch = projected(scene, {{{-1, 0, -0.5}, {1, 0, -0.5}, {0, 0, 4}}});
  EXPECT_EQ(drawn(batch, scene), std::vector<std::string>(6, "????????"));
}

TEST(CertainPixels, PiecesOfATriangleAreOneTriangle) {
  const Scene scene = {true, {-1, 1, -1, 1, 1, 9}, 0.001};
  TriangleBatch batch = projected(scene, {{{-90, -1, -50}, {90, -1, -50}, {0, -1, 40}}});
  const auto whole = batch.unclipped[0];
  ASSERT_NE(whole, nullptr);
  const std::vector<std::string> once = drawn(batch, scene);
  batch.add(batch.triangles[0], 7, {});
  batch.attributes.w.push_back(batch.attributes.w[0]);
  batch.set_last_unclipped(whole);
  EXPECT_EQ(drawn(batch, scene), once);
  EXPECT_EQ(once[5], "########");
}

}  // namespace
}  // namespace pipeline
