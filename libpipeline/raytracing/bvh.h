#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "libpipeline/numbers/bounding_box.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/stream/thread_pool.h"

namespace pipeline {

/// A box around a primitive, rounded outward.
struct FloatBox {
  FloatBox() = default;
  /// The box with every side moved outward by `padding`, and then to the next float.
  FloatBox(const BoundingBox& box, double padding);

  void add(const FloatBox& box);
  /// Half of the surface's area; 0 if the box is empty.
  [[nodiscard]] double half_area() const;

  std::array<float, 3> low = {kInfinity, kInfinity, kInfinity};
  std::array<float, 3> high = {-kInfinity, -kInfinity, -kInfinity};

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
};

/// A bounding volume hierarchy: finds the primitives near a ray, the nearer boxes first. Built top-down by
/// the surface area heuristic, in bins (I. Wald, "On fast construction of SAH-based bounding volume
/// hierarchies", 2007). It takes about 35 bytes a primitive, and while it is built another 28.
class Bvh {
 public:
  /// An entry of the list that the hierarchy is built from.
  struct Primitive {
    FloatBox box;
    std::uint32_t id;
  };
  static constexpr std::size_t kMaxPrimitives = std::size_t{1} << 28;

  Bvh() = default;
  /// At most kMaxPrimitives. The pool may have no other work. The number of threads changes nothing but the
  /// order of the nodes in memory.
  Bvh(std::vector<Primitive> primitives, ThreadPool& pool);

  /// The count of nodes that have children.
  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }

  /// Calls `test(id)` for all primitives whose boxes the ray enters at a distance of at most `limit`, which
  /// tests may lower. Calculates as if the sides of boxes were off by 2^-51 of their coordinates, if the ray
  /// begins at the origin or is parallel to an axis: their padding has to cover that.
  template <typename Test>
  void for_each_candidate(const Ray& ray, double first, const double& limit, Test&& test) const;

 private:
  // A leaf is a run of primitives in `ids_`, as a number: a mark, the count less 1, and where they begin.
  static constexpr std::uint32_t kLeaf = std::uint32_t{1} << 31;
  static constexpr int kFirstBits = 28;
  static constexpr std::uint32_t kFirstMask = (std::uint32_t{1} << kFirstBits) - 1;
  static constexpr std::size_t kMaxLeaf = 8;
  static constexpr std::size_t kMaxDepth = 120;  // 64 for the cuts by area, and those in the middle

  struct Node {
    // By axis, then child: both are tested at a time.
    std::array<std::array<float, 2>, 3> low;
    std::array<std::array<float, 2>, 3> high;
    std::array<std::uint32_t, 2> children;  // nodes or leaves
  };
  struct Builder;

  /// A ray's distances from the sides of a node's two boxes.
  struct Slopes {
    explicit Slopes(const Ray& ray)
        : origin{ray.origin.x, ray.origin.y, ray.origin.z},
          inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z} {}
    std::array<double, 3> origin;
    std::array<double, 3> inverse;
  };

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> ids_;
  std::uint32_t root_ = 0;
};

template <typename Test>
void Bvh::for_each_candidate(const Ray& ray, double first, const double& limit, Test&& test) const {
  if (ids_.empty()) return;
  const Slopes slopes(ray);
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
      std::array<double, 2> entry = {first, first};
      std::array<double, 2> exit = {limit, limit};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t child = 0; child < 2; ++child) {
          const double low = (node.low[axis][child] - slopes.origin[axis]) * slopes.inverse[axis];
          const double high = (node.high[axis][child] - slopes.origin[axis]) * slopes.inverse[axis];
          const double nearer = low < high ? low : high, farther = low < high ? high : low;
          entry[child] = nearer > entry[child] ? nearer : entry[child];
          exit[child] = farther < exit[child] ? farther : exit[child];
        }
      }
      const bool enters_first = entry[0] <= exit[0], enters_second = entry[1] <= exit[1];
      if (enters_first && enters_second) {
        const std::size_t nearer = entry[1] < entry[0] ? 1 : 0;
        stack[waiting_count++] = {node.children[1 - nearer], entry[1 - nearer]};
        current = node.children[nearer];
        continue;
      }
      if (enters_first || enters_second) {
        current = node.children[enters_first ? 0 : 1];
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
