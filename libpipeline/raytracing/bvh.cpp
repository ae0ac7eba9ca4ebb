#include "libpipeline/raytracing/bvh.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <span>

namespace pipeline {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

/// The largest float below `value`.
float below(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) < value ? nearest : std::nextafter(nearest, -HUGE_VALF);
}

float above(double value) {
  return -below(-value);
}

/// The middle, made finite: boxes of triangles beyond the range of floats are infinite.
double center(const FloatBox& box, std::size_t axis) {
  const double low = std::max(box.low[axis], -kLargest), high = std::min(box.high[axis], kLargest);
  return (low + high) / 2;
}

}  // namespace

FloatBox::FloatBox(const BoundingBox& box, double padding)
    : low{below(box.low.x - padding), below(box.low.y - padding), below(box.low.z - padding)},
      high{above(box.high.x + padding), above(box.high.y + padding), above(box.high.z + padding)} {}

void FloatBox::add(const FloatBox& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], box.low[axis]);
    high[axis] = std::max(high[axis], box.high[axis]);
  }
}

double FloatBox::half_area() const {
  std::array<double, 3> size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size[axis] = double{std::min(high[axis], kLargest)} - double{std::max(low[axis], -kLargest)};
    if (!(size[axis] >= 0)) return 0;
  }
  return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

/// Cuts runs of the list in two until they are leaves.
struct Bvh::Builder {
  using Run = std::span<Primitive>;
  /// A run for a task to cut further, and the place of its root.
  struct Part {
    Run run;
    FloatBox box;
    std::size_t depth;
    std::uint32_t* root;
  };
  static constexpr std::size_t kBins = 16;
  // Cuts by area may be as lopsided as the boxes; below this depth, runs are cut in the middle.
  static constexpr std::size_t kMaxDepthByArea = 64;

  static FloatBox box_of(Run run) {
    FloatBox box;
    for (const Primitive& primitive : run) box.add(primitive.box);
    return box;
  }

  /// The place to cut a run: before the bin `first_right` of an axis. The bins divide the range of centers.
  struct Cut {
    [[nodiscard]] std::size_t bin_of(const FloatBox& box) const {
      return std::min(static_cast<std::size_t>((center(box, axis) - begin) * per_unit), kBins - 1);
    }

    std::size_t axis = 0;
    double begin = 0, per_unit = 0;
    std::size_t first_right = 0;
    double cost = std::numeric_limits<double>::infinity();  // area times count, summed over both sides
  };

  struct Bin {
    void add(const Bin& other) {
      box.add(other.box);
      count += other.count;
    }
    [[nodiscard]] double cost() const { return box.half_area() * static_cast<double>(count); }

    FloatBox box;
    std::size_t count = 0;
  };

  /// The best cut of a run along an axis; of infinite cost if all centers are equal there.
  static Cut best_cut(Run run, std::size_t axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Primitive& primitive : run) {
      const double position = center(primitive.box, axis);
      low = std::min(low, position);
      high = std::max(high, position);
    }
    Cut cut = {axis, low, kBins / (high - low)};
    Cut best = cut;
    if (!(high > low && cut.per_unit < HUGE_VAL)) return best;
    std::array<Bin, kBins> bins;
    for (const Primitive& primitive : run) bins[cut.bin_of(primitive.box)].add({primitive.box, 1});
    std::array<double, kBins> left_costs;
    Bin left, right;
    for (std::size_t i = 0; i < kBins; ++i) {
      if (bins[i].count == 0) continue;
      left_costs[i] = left.cost();
      left.add(bins[i]);
    }
    for (std::size_t i = kBins - 1; i > 0; --i) {
      if (bins[i].count == 0) continue;  // a cut before an empty bin costs as much as the next
      right.add(bins[i]);
      cut.first_right = i;
      cut.cost = left_costs[i] + right.cost();
      if (right.count > 0 && right.count < run.size() && cut.cost < best.cost) best = cut;
    }
    return best;
  }

  /// The size of the left part of a run; 0 if it should be a leaf.
  static std::size_t left_size(Run run, const FloatBox& box, std::size_t depth) {
    constexpr double kCostOfNode = 1;  // in tests of a primitive
    if (run.size() <= 1) return 0;
    Cut best;
    for (std::size_t axis = 0; axis < 3 && depth < kMaxDepthByArea; ++axis)
      if (const Cut cut = best_cut(run, axis); cut.cost < best.cost) best = cut;
    const bool may_be_leaf = run.size() <= kMaxLeaf;
    if (best.cost == HUGE_VAL) return may_be_leaf ? 0 : run.size() / 2;
    const double saved = box.half_area() * (static_cast<double>(run.size()) - kCostOfNode) - best.cost;
    if (may_be_leaf && !(saved > 0)) return 0;
    const auto is_left = [&](const Primitive& p) { return best.bin_of(p.box) < best.first_right; };
    return static_cast<std::size_t>(std::partition(run.begin(), run.end(), is_left) - run.begin());
  }

  /// Adds the nodes of a run and stores its root. Runs of at most `part_size` become parts, to be built
  /// later.
  void build(const Part& part, std::size_t part_size) {
    const auto& [run, box, depth, root] = part;
    const std::size_t middle = left_size(run, box, depth);
    if (middle == 0) {
      const auto first = static_cast<std::size_t>(run.data() - primitives.data());
      *root = kLeaf | static_cast<std::uint32_t>((run.size() - 1) << kFirstBits | first);
      return;
    }
    *root = node_count++;
    Node& node = nodes[*root];
    const std::array<Run, 2> halves = {run.first(middle), run.subspan(middle)};
    for (std::size_t child = 0; child < 2; ++child) {
      const Part half = {halves[child], box_of(halves[child]), depth + 1, &node.children[child]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.sides[axis][0][child] = half.box.low[axis];
        node.sides[axis][1][child] = half.box.high[axis];
      }
      if (half.run.size() <= part_size)
        parts.push_back(half);
      else
        build(half, part_size);
    }
  }

  Run primitives;
  Node* nodes;
  std::atomic<std::uint32_t> node_count = 0;
  std::vector<Part> parts = {};
};

Bvh::Bvh(std::vector<Primitive> primitives, ThreadPool& pool) {
  assert(primitives.size() <= kMaxPrimitives);
  if (primitives.empty()) return;
  // Every node cuts a run in two.
  nodes_ = std::make_unique_for_overwrite<Node[]>(primitives.size());
  Builder builder{primitives, nodes_.get()};
  // Parts are so small that threads share the work, but large enough to be worth a task.
  constexpr std::size_t kMinPart = 1024;
  const auto threads = static_cast<std::size_t>(pool.size());
  const std::size_t part_size = threads == 1 ? 0 : std::max(kMinPart, primitives.size() / (8 * threads));
  builder.build({primitives, Builder::box_of(primitives), 0, &root_}, part_size);
  pool.start(static_cast<int>(builder.parts.size()),
             [&](int number, int) { builder.build(builder.parts[static_cast<std::size_t>(number)], 0); });
  pool.finish();
  node_count_ = builder.node_count;
  ids_.reserve(primitives.size());
  for (const Primitive& primitive : primitives) ids_.push_back(primitive.id);
}

}  // namespace pipeline
