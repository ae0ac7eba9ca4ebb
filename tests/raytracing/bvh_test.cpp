#include "libpipeline/raytracing/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace pipeline {
namespace {

BoundingBox box_around(const Vec3& low, const Vec3& high) {
  BoundingBox box;
  box.low = low;
  box.high = high;
  return box;
}

std::vector<Bvh::Primitive> primitives_of(const std::vector<BoundingBox>& boxes) {
  std::vector<Bvh::Primitive> primitives;
  for (const BoundingBox& box : boxes)
    primitives.push_back({FloatBox(box, 1e-12), static_cast<std::uint32_t>(primitives.size())});
  return primitives;
}

/// The ids of all candidates, sorted.
std::vector<std::uint32_t> candidates(const Bvh& bvh, const Ray& ray, double first, double limit) {
  std::vector<std::uint32_t> ids;
  bvh.for_each_candidate(ray, first, limit, [&](std::uint32_t id) { ids.push_back(id); });
  std::ranges::sort(ids);
  return ids;
}

/// Whether the ray enters the box between the distances, in long doubles.
bool enters(const Ray& ray, const BoundingBox& box, long double first, long double limit) {
  const auto clip = [&](double origin, double direction, double low, double high) {
    if (direction == 0) return low <= origin && origin <= high;
    long double near = (static_cast<long double>(low) - origin) / direction;
    long double far = (static_cast<long double>(high) - origin) / direction;
    if (near > far) std::swap(near, far);
    first = std::max(first, near);
    limit = std::min(limit, far);
    return first <= limit;
  };
  return clip(ray.origin.x, ray.direction.x, box.low.x, box.high.x) &&
         clip(ray.origin.y, ray.direction.y, box.low.y, box.high.y) &&
         clip(ray.origin.z, ray.direction.z, box.low.z, box.high.z);
}

std::vector<BoundingBox> random_boxes(std::mt19937_64& rng, int count) {
  std::uniform_real_distribution<double> place(-5, 5), size(0, 0.4);
  std::vector<BoundingBox> boxes;
  for (int i = 0; i < count; ++i) {
    const Vec3 low = {place(rng), place(rng), place(rng) - 6};
    boxes.push_back(box_around(low, {low.x + size(rng), low.y + size(rng), low.z + size(rng)}));
  }
  return boxes;
}

Ray random_ray(std::mt19937_64& rng, bool is_parallel) {
  std::uniform_real_distribution<double> anywhere(-1, 1);
  const auto coordinate = [&] { return rng() % 8 == 0 ? 0 : anywhere(rng); };
  if (is_parallel) return {{5 * coordinate(), 5 * coordinate(), 0}, {0, 0, -1}};
  return {{}, {coordinate(), coordinate(), -1}};
}

TEST(Bvh, FindsEveryBoxThatTheRayEnters) {
  std::mt19937_64 rng(1);
  ThreadPool pool(1);
  for (const int count : {1, 2, 9, 100, 3000}) {
    const std::vector<BoundingBox> boxes = random_boxes(rng, count);
    const Bvh bvh(primitives_of(boxes), pool);
    for (int i = 0; i < 200; ++i) {
      const Ray ray = random_ray(rng, i % 2 == 0);
      const double limit = i % 3 == 0 ? 6 : std::numeric_limits<double>::infinity();
      const std::vector<std::uint32_t> found = candidates(bvh, ray, 0, limit);
      ASSERT_EQ(std::ranges::adjacent_find(found), found.end()) << "a candidate twice";
      for (std::size_t id = 0; id < boxes.size(); ++id) {
        const bool is_found = std::ranges::binary_search(found, static_cast<std::uint32_t>(id));
        ASSERT_TRUE(is_found || !enters(ray, boxes[id], 0, limit)) << count << " " << id;
      }
    }
  }
}

TEST(Bvh, LeavesOutMostBoxesThatAreElsewhere) {
  std::mt19937_64 rng(2);
  ThreadPool pool(1);
  const Bvh bvh(primitives_of(random_boxes(rng, 10'000)), pool);
  EXPECT_LT(candidates(bvh, random_ray(rng, false), 0, std::numeric_limits<double>::infinity()).size(), 300u);
}

TEST(Bvh, ALimitLoweredByTheTestEndsTheSearch) {
  ThreadPool pool(1);
  std::vector<BoundingBox> boxes;
  for (int i = 0; i < 1000; ++i) boxes.push_back(box_around({-1, -1, -i - 1.5}, {1, 1, -i - 1.0}));
  const Bvh bvh(primitives_of(boxes), pool);
  int count = 0;
  double limit = std::numeric_limits<double>::infinity();
  bvh.for_each_candidate({{}, {0, 0, -1}}, 0, limit, [&](std::uint32_t id) {
    ++count;
    limit = std::min(limit, id + 1.5);
  });
  EXPECT_LE(limit, 1.5);
  EXPECT_LE(count, 16);
}

TEST(Bvh, ThreadsChangeNoCandidate) {
  std::mt19937_64 rng(3);
  const std::vector<BoundingBox> boxes = random_boxes(rng, 20'000);
  ThreadPool one(1), two(2), five(5);
  const Bvh by_one(primitives_of(boxes), one), by_two(primitives_of(boxes), two),
      by_five(primitives_of(boxes), five);
  EXPECT_EQ(by_one.node_count(), by_two.node_count());
  for (int i = 0; i < 200; ++i) {
    const Ray ray = random_ray(rng, i % 2 == 0);
    const auto found = candidates(by_one, ray, 0, 100);
    ASSERT_EQ(candidates(by_two, ray, 0, 100), found);
    ASSERT_EQ(candidates(by_five, ray, 0, 100), found);
  }
}

TEST(Bvh, HoldsBoxesInOnePlace) {
  ThreadPool pool(1);
  const Bvh bvh(primitives_of(std::vector(5000, box_around({-1, -1, -3}, {1, 1, -2}))), pool);
  EXPECT_EQ(candidates(bvh, {{}, {0, 0, -1}}, 0, 10).size(), 5000u);
  EXPECT_EQ(candidates(bvh, {{}, {3, 0, -1}}, 0, 10).size(), 0u);
}

TEST(Bvh, HoldsBoxesBeyondTheRangeOfFloats) {
  ThreadPool pool(1);
  std::vector<BoundingBox> boxes(20, box_around({-1, -1, -1e300}, {1e300, 1, -2}));
  boxes.push_back(box_around({-1e-300, -1, -3}, {1e-300, 1, -2}));
  const Bvh bvh(primitives_of(boxes), pool);
  EXPECT_EQ(candidates(bvh, {{}, {0, 0, -1}}, 0, 1e300).size(), 21u);
}

TEST(Bvh, IsEmptyWithoutPrimitives) {
  ThreadPool pool(1);
  EXPECT_TRUE(candidates(Bvh({}, pool), {{}, {0, 0, -1}}, 0, 10).empty());
}

TEST(FloatBox, IsRoundedOutward) {
  const FloatBox box(box_around({0.1, 1, -1e40}, {0.1, 1, 1e40}), 0);
  EXPECT_LT(box.low[0], 0.1);
  EXPECT_GT(box.high[0], 0.1);
  EXPECT_LE(box.low[1], 1);
  EXPECT_EQ(box.low[2], -std::numeric_limits<float>::infinity());
  EXPECT_EQ(box.high[2], std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace pipeline
