#include <gtest/gtest.h>

#include <cmath>

#include "tests/numbers/random_numbers.h"
#include "tests/visibility/visible_frames.h"

namespace pipeline {
namespace {

/// Difficult scenes: equal depths, shared edges, intersections, triangles without area, off the screen, in
/// front of and behind the limits, and coplanar ones.
class RandomScenes {
 public:
  explicit RandomScenes(std::uint64_t seed) : random_(seed) {}

  Viewport screen() {
    Viewport screen;
    screen.columns = random_.whole(0, 9) == 0 ? random_.whole(60, 200) : random_.whole(1, 24);
    screen.rows = random_.whole(1, 8);
    screen.left_is_decimal = screen.bottom_is_decimal = true;
    if (random_.whole(0, 3) == 0) {
      screen.front = -0.25;
      screen.rear = decimal(0.1, 0.5);
    }
    if (random_.whole(0, 49) == 0) {
      screen.front = -1e300;
      screen.rear = 1e300;
    }
    return screen;
  }

  Scene scene() {
    Scene scene;
    new_plane();
    depth_kind_ = random_.whole(0, 6);
    coordinate_kind_ = random_.whole(0, 3);
    const int count = random_.whole(0, 9) == 0 ? random_.whole(20, 60) : random_.whole(1, 9);
    while (static_cast<int>(scene.size()) < count) {
      if (random_.whole(0, 5) == 0) new_plane();
      Triangle triangle = {vertex(), vertex(), vertex()};
      switch (random_.whole(0, 9)) {
        case 0:
          triangle[2] = triangle[random_.bits() % 2];  // without area
          break;
        case 1:
          if (!scene.empty()) triangle = scene[random_.bits() % scene.size()];  // once more
          break;
        case 2:
        case 3:
        case 4:  // with a shared edge
          if (!scene.empty()) {
            const Triangle& neighbor = scene[random_.bits() % scene.size()];
            triangle[0] = neighbor[1];
            triangle[1] = neighbor[0];
          }
          break;
        default:
          break;
      }
      scene.push_back(triangle);
    }
    return scene;
  }

 private:
  double decimal(double low, double high) { return std::round(random_.between(low, high) * 1e7) / 1e7; }
  double coordinate() {
    const double size = random_.whole(0, 9) == 0 ? 20 : 1.3;
    switch (coordinate_kind_) {
      case 0:
        return random_.whole(-10, 10) / 8.0;
      case 1:
        return random_.whole(-13, 13) / 10.0;
      default:
        return decimal(-size, size);
    }
  }
  Vec3 vertex() {
    Vec3 p = {coordinate(), coordinate(), 0};
    p.z = depth_at(p);
    return p;
  }
  double depth_at(const Vec3& p) {
    switch (depth_kind_) {
      case 0:
        return 0.25;
      case 1:
        return random_.whole(-4, 4) / 4.0;
      case 2:
        return random_.whole(0, 30) == 0 ? random_.with_exponent(-40, 60) : decimal(-1.5, 1.5);
      case 3:  // nearly coplanar: to the last printed digit
        return decimal(0, 0) + std::round((plane_.z + plane_.x * p.x + plane_.y * p.y) * 1e7) / 1e7;
      case 4:
      case 5:  // coplanar up to the rounding of doubles
        return plane_.z + plane_.x * p.x + plane_.y * p.y;
      default:
        return decimal(-1.2, 1.2);
    }
  }
  void new_plane() { plane_ = {decimal(-0.5, 0.5), decimal(-0.5, 0.5), decimal(-0.5, 0.5)}; }

  RandomNumbers random_;
  Vec3 plane_;
  int depth_kind_ = 0;
  int coordinate_kind_ = 0;
};

template <typename Coverage, typename Depth>
void expect_the_same(const Scene& scene, const Viewport& screen, int number) {
  const Frame expected = zbuffer_frame<Coverage, Depth>(scene, screen);
  const Frame found = scanline_frame<Coverage, Depth>(scene, screen);
  ASSERT_TRUE(expected == found) << "scene " << number << ", " << scene.size() << " triangles, "
                                 << screen.columns << " x " << screen.rows << " pixels";
}

template <typename Coverage>
void expect_the_same_in_all_formats(const Scene& scene, const Viewport& screen, int number) {
  expect_the_same<Coverage, DepthF64>(scene, screen, number);
  // zbuf refuses limits of Z that a format cannot store.
  if (DepthF32::needed_limits(screen).empty()) expect_the_same<Coverage, DepthF32>(scene, screen, number);
  if (DepthU24::needed_limits(screen).empty()) expect_the_same<Coverage, DepthU24>(scene, screen, number);
}

void expect_the_same_in_random_scenes(int scene_count, std::uint64_t seed) {
  RandomScenes random(seed);
  for (int i = 0; i < scene_count; ++i) {
    const Viewport screen = random.screen();
    const Scene scene = random.scene();
    expect_the_same_in_all_formats<NearestCoverage>(scene, screen, i);
    expect_the_same_in_all_formats<CenterCoverage>(scene, screen, i);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Scanline, RandomScenesAreTheZBuffers) {
  expect_the_same_in_random_scenes(1000, 1);
}

TEST(ScanlineLong, AHundredThousandRandomScenesAreTheZBuffers) {
  expect_the_same_in_random_scenes(100000, 2);
}

TEST(Scanline, AnOverdrawOfManyLayersIsTheZBuffers) {
  // Large triangles, many intersections.
  RandomNumbers random(3);
  Scene scene;
  for (int i = 0; i < 400; ++i) {
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(-1.1, 1.1)};
    scene.push_back(triangle);
  }
  constexpr Viewport kScreen = {300, 60, -1, -1, -1, 1};
  EXPECT_TRUE((scanline_frame<NearestCoverage, DepthF64>(scene, kScreen, 0) ==
               zbuffer_frame<NearestCoverage, DepthF64>(scene, kScreen, 0)));
  EXPECT_TRUE((scanline_frame<CenterCoverage, DepthU24>(scene, kScreen, 0) ==
               zbuffer_frame<CenterCoverage, DepthU24>(scene, kScreen, 0)));
}

}  // namespace
}  // namespace pipeline
