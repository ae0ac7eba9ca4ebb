#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/stream/thread_pool.h"

namespace pipeline {

/// Two doubles, which most processors handle at once.
typedef double TwoDoubles __attribute__((vector_size(16)));

/// A box around a primitive, rounded outward.
struct FloatBox {
  FloatBox() = default;
  /// The box with every side moved outward by `padding`, and then to the next float.
  FloatBox(const BoundingBox& box, double padding);

  void add(const FloatBox& box);
  /// Half of the surface area; 0 if the box is empty.
  [[nodiscard]] double half_area() const;

  std::array<float, 3> low = {kInfinity, kInfinity, kInfinity};
  std::array<float, 3> high = {-kInfinity, -kInfinity, -kInfinity};

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
};

/// A bounding volume hierarchy: finds the primitives near a ray, nearer boxes first. Built top-down by the
/// surface area heuristic, in bins (I. Wald, "On fast construction of SAH-based bounding volume hierarchies",
/// 2007). It takes at most 60 bytes per primitive, mostly about 40, and another 28 while it is built.
class Bvh {
 public:
  /// An entry of the list that the hierarchy is built from.
  struct Primitive {
    FloatBox box;
    std::uint32_t id;
  };
  static constexpr std::size_t kMaxPrimitives = std::size_t{1} << 28;

  Bvh() = default;
  /// Takes at most kMaxPrimitives. The pool must have no other work. The number of threads changes only the
  /// order of the nodes in memory.
  Bvh(std::vector<Primitive> primitives, ThreadPool& pool);

  /// The count of nodes that have children.
  [[nodiscard]] std::size_t node_count() const { return node_count_; }

  /// Calls `test(id)` for all primitives whose boxes the ray enters at a distance of at most `limit`, which
  /// tests may lower. For rays from the origin or parallel to an axis, rounding acts as if the sides of boxes
  /// were off by 2^-51 of their coordinates: the padding must cover this.
  template <typename Test>
  void for_each_candidate(const Ray& ray, double first, const double& limit, Test&& test) const;

 private:
  // A leaf is a run of primitives in `ids_`, as one number: a mark, their count - 1, and their beginning.
  static constexpr std::uint32_t kLeaf = std::uint32_t{1} << 31;
  static constexpr int kFirstBits = 28;
  static constexpr std::uint32_t kFirstMask = (std::uint32_t{1} << kFirstBits) - 1;
  static constexpr std::size_t kMaxLeaf = 8;
  static constexpr std::size_t kMaxDepth = 120;  // 64 for cuts by area, and then cuts in the middle

  struct Node {
    // Indexed by axis, then low and high, then child: both children are tested at once.
    std::array<std::array<std::array<float, 2>, 2>, 3> sides;
    std::array<std::uint32_t, 2> children;  // nodes or leaves
  };
  struct Builder;
  /// A ray prepared for the test of boxes.
  struct BoxRay {
    explicit BoxRay(const Ray& ray);
    /// The node's children that it enters between two distances: bits 0 and 1. `entry` gets where it enters.
    unsigned entered(const Node& node, double first, double limit, TwoDoubles& entry) const;

    std::array<TwoDoubles, 3> origin, inverse;  // by axis, twice
    std::array<std::size_t, 3> entrance;        // the side through which it enters a box
  };

  std::unique_ptr<Node[]> nodes_;  // room for the maximum count; unused nodes are never touched
  std::size_t node_count_ = 0;
  std::vector<std::uint32_t> ids_;
  std::uint32_t root_ = 0;
};

inline Bvh::BoxRay::BoxRay(const Ray& ray) {
  const std::array<double, 3> origins = {ray.origin.x, ray.origin.y, ray.origin.z};
  const std::array<double, 3> directions = {ray.direction.x, ray.direction.y, ray.direction.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    origin[axis] = TwoDoubles{origins[axis], origins[axis]};
    inverse[axis] = 1 / TwoDoubles{directions[axis], directions[axis]};
    entrance[axis] = std::size_t{std::signbit(directions[axis])};
  }
}

inline unsigned Bvh::BoxRay::entered(const Node& node, double first, double limit, TwoDoubles& entry) const {
  TwoDoubles leave = {limit, limit};
  entry = TwoDoubles{first, first};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto distance = [&](std::size_t side) {
      const auto& [of_one, of_other] = node.sides[axis][side];
      return (TwoDoubles{of_one, of_other} - origin[axis]) * inverse[axis];
    };
    const TwoDoubles in = distance(entrance[axis]), out = distance(1 - entrance[axis]);
    // NaN, from 0 times infinity on a side of a box, leaves both unchanged.
    entry = in > entry ? in : entry;
    leave = out < leave ? out : leave;
  }
  return (entry[0] <= leave[0] ? 1u : 0u) | (entry[1] <= leave[1] ? 2u : 0u);
}

template <typename Test>
void Bvh::for_each_candidate(const Ray& ray, double first, const double& limit, Test&& test) const {
  if (ids_.empty()) return;
  const BoxRay box_ray(ray);
  struct Waiting {
    std::uint32_t child;
    double entry;
  };
  std::array<Waiting, kMaxDepth> stack;
  std::size_t waiting_count = 0;
  std::uint32_t current = root_;
  for (;;) {
    if ((current & kLeaf) != 0) {
      const std::uint32_t begin = current & kFirstMask;
      const std::uint32_t end = begin + (current >> kFirstBits & std::uint32_t{kMaxLeaf - 1}) + 1;
      for (std::uint32_t i = begin; i < end; ++i) test(ids_[i]);
    } else {
      const Node& node = nodes_[current];
      TwoDoubles entry;
      const unsigned entered = box_ray.entered(node, first, limit, entry);
      if (entered == 3) {
        const std::size_t nearer = entry[1] < entry[0] ? 1 : 0;
        stack[waiting_count++] = {node.children[1 - nearer], nearer == 0 ? entry[1] : entry[0]};
        current = node.children[nearer];
        continue;
      }
      if (entered != 0) {
        current = node.children[entered == 1 ? 0 : 1];
        continue;
      }
    }
    do {
      if (waiting_count == 0) return;
      current = stack[--waiting_count].child;
    } while (stack[waiting_count].entry > limit);
  }
}

}  // namespace pipeline
