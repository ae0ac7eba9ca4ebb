#include "libpipeline/raytracing/bvh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace pipeline {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

/// The next float below `value`, which is at least that far away from it.
float below(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) < value ? nearest : std::nextafter(nearest, -HUGE_VALF);
}

float above(double value) {
  return -below(-value);
}

/// Finite: boxes of triangles beyond the range of floats are infinite.
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

/// Cuts runs of the list in two, until they are leaves.
struct Bvh::Builder {
  struct Range {
    std::size_t begin, end;
    [[nodiscard]] std::size_t size() const { return end - begin; }
  };
  /// A run that a task cuts further, and the place of its root.
  struct Part {
    Range range;
    std::size_t node;  // in the nodes above all parts
    std::size_t child;
    std::size_t depth;
    std::vector<Node> nodes;
    std::uint32_t root;
  };
  static constexpr std::size_t kBins = 16;
  // Cuts by area may be as lopsided as the boxes are; below this depth runs are cut in the middle.
  static constexpr std::size_t kMaxDepthByArea = 64;

  explicit Builder(std::vector<Primitive>& list) : primitives(list) {}

  [[nodiscard]] FloatBox box_of(const Range& range) const {
    FloatBox box;
    for (std::size_t i = range.begin; i < range.end; ++i) box.add(primitives[i].box);
    return box;
  }
  static std::uint32_t leaf(const Range& range) {
    return kLeaf | static_cast<std::uint32_t>((range.size() - 1) << kFirstBits | range.begin);
  }

  /// Where a run is cut: before the bin `first_right` of an axis.
  struct Cut {
    std::size_t axis = 0;
    std::size_t first_right = 0;
    double cost = std::numeric_limits<double>::infinity();  // area times count, of both sides
  };
  struct Bins {
    double begin = 0, per_unit = 0;
    [[nodiscard]] std::size_t of(double position) const {
      return std::min(static_cast<std::size_t>((position - begin) * per_unit), kBins - 1);
    }
  };

  /// The bins of the centers of a run, by axis; no axis where all are in one place.
  [[nodiscard]] std::array<std::optional<Bins>, 3> bins_of(const Range& range) const {
    std::array<double, 3> low, high;
    low.fill(HUGE_VAL);
    high.fill(-HUGE_VAL);
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double position = center(primitives[i].box, axis);
        low[axis] = std::min(low[axis], position);
        high[axis] = std::max(high[axis], position);
      }
    std::array<std::optional<Bins>, 3> bins;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const double per_unit = kBins / (high[axis] - low[axis]);
          high[axis] > low[axis] && per_unit < HUGE_VAL)
        bins[axis] = {low[axis], per_unit};
    return bins;
  }

  [[nodiscard]] Cut best_cut(const Range& range, const std::array<std::optional<Bins>, 3>& bins) const {
    struct Bin {
      FloatBox box;
      std::size_t count = 0;
    };
    std::array<std::array<Bin, kBins>, 3> filled;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const FloatBox& box = primitives[i].box;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!bins[axis]) continue;
        Bin& bin = filled[axis][bins[axis]->of(center(box, axis))];
        bin.box.add(box);
        ++bin.count;
      }
    }
    Cut best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!bins[axis]) continue;
      std::array<double, kBins> left_costs;
      Bin left, right;
      for (std::size_t i = 0; i + 1 < kBins; ++i) {
        left.box.add(filled[axis][i].box);
        left.count += filled[axis][i].count;
        left_costs[i + 1] = left.box.half_area() * static_cast<double>(left.count);
      }
      for (std::size_t i = kBins - 1; i > 0; --i) {
        right.box.add(filled[axis][i].box);
        right.count += filled[axis][i].count;
        const double cost = left_costs[i] + right.box.half_area() * static_cast<double>(right.count);
        const bool has_both = right.count > 0 && right.count < range.size();
        if (has_both && cost < best.cost) best = {axis, i, cost};
      }
    }
    return best;
  }

  /// The end of the left part of a run; its begin if it had better be a leaf.
  std::size_t cut(const Range& range, const FloatBox& box, std::size_t depth) {
    constexpr double kCostOfNode = 1;  // in tests of a primitive
    const std::size_t middle = range.begin + range.size() / 2;
    if (range.size() <= 1) return range.begin;
    if (depth >= kMaxDepthByArea) return range.size() <= kMaxLeaf ? range.begin : middle;
    const auto bins = bins_of(range);
    const Cut best = best_cut(range, bins);
    if (best.cost == std::numeric_limits<double>::infinity())
      return range.size() <= kMaxLeaf ? range.begin : middle;
    const double area = box.half_area();
    const double saved = area * (static_cast<double>(range.size()) - kCostOfNode) - best.cost;
    if (range.size() <= kMaxLeaf && !(saved > 0)) return range.begin;
    const auto is_left = [&](const Primitive& p) {
      return bins[best.axis]->of(center(p.box, best.axis)) < best.first_right;
    };
    const auto first = primitives.begin() + static_cast<std::ptrdiff_t>(range.begin);
    const auto last = primitives.begin() + static_cast<std::ptrdiff_t>(range.end);
    return static_cast<std::size_t>(std::partition(first, last, is_left) - primitives.begin());
  }

  /// Adds the nodes of a run and returns its root. Runs of at most `part_size` become parts, to be cut later.
  std::uint32_t build(const Range& range, const FloatBox& box, std::size_t depth, std::vector<Node>& nodes,
                      std::size_t part_size) {
    const std::size_t middle = cut(range, box, depth);
    if (middle == range.begin) return leaf(range);
    const auto index = nodes.size();
    nodes.emplace_back();
    const std::array<Range, 2> halves = {{{range.begin, middle}, {middle, range.end}}};
    for (std::size_t child = 0; child < 2; ++child) {
      const FloatBox half = box_of(halves[child]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        nodes[index].sides[axis][0][child] = half.low[axis];
        nodes[index].sides[axis][1][child] = half.high[axis];
      }
      if (halves[child].size() <= part_size) {
        parts.push_back({halves[child], index, child, depth + 1, {}, 0});
      } else {
        const std::uint32_t root = build(halves[child], half, depth + 1, nodes, part_size);
        nodes[index].children[child] = root;
      }
    }
    return static_cast<std::uint32_t>(index);
  }

  std::vector<Primitive>& primitives;
  std::vector<Part> parts;
};

Bvh::Bvh(std::vector<Primitive> primitives, ThreadPool& pool) {
  assert(primitives.size() <= kMaxPrimitives);
  if (primitives.empty()) return;
  Builder builder(primitives);
  const Builder::Range all = {0, primitives.size()};
  // Small enough that threads share the work, large enough that a part is worth a task.
  constexpr std::size_t kMinPart = 1024;
  const auto threads = static_cast<std::size_t>(pool.size());
  const std::size_t part_size = threads == 1 ? 0 : std::max(kMinPart, all.size() / (8 * threads));
  root_ = builder.build(all, builder.box_of(all), 0, nodes_, part_size);
  pool.start(static_cast<int>(builder.parts.size()), [&](int number, int) {
    Builder::Part& part = builder.parts[static_cast<std::size_t>(number)];
    part.root = builder.build(part.range, builder.box_of(part.range), part.depth, part.nodes, 0);
  });
  pool.finish();
  for (Builder::Part& part : builder.parts) {
    const auto offset = static_cast<std::uint32_t>(nodes_.size());
    const auto moved = [&](std::uint32_t child) { return (child & kLeaf) != 0 ? child : child + offset; };
    for (Node& node : part.nodes) {
      for (std::uint32_t& child : node.children) child = moved(child);
      nodes_.push_back(node);
    }
    nodes_[part.node].children[part.child] = moved(part.root);
    part.nodes = {};
  }
  ids_.reserve(primitives.size());
  for (const Primitive& primitive : primitives) ids_.push_back(primitive.id);
}

}  // namespace pipeline
