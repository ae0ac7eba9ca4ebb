#include "libpipeline/raytracing/bvh.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <optional>

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
  struct Range {
    std::size_t begin, end;
    [[nodiscard]] std::size_t size() const { return end - begin; }
  };
  /// A run for a task to cut further, and the place of its root.
  struct Part {
    Range range;
    FloatBox box;
    std::size_t depth;
    std::uint32_t* root;
  };
  static constexpr std::size_t kBins = 16;
  // Cuts by area may be as lopsided as the boxes; below this depth, runs are cut in the middle.
  static constexpr std::size_t kMaxDepthByArea = 64;

  Builder(std::vector<Primitive>& list, Node* room) : primitives(list), nodes(room) {}

  [[nodiscard]] FloatBox box_of(const Range& range) const {
    FloatBox box;
    for (std::size_t i = range.begin; i < range.end; ++i) box.add(primitives[i].box);
    return box;
  }
  static std::uint32_t leaf(const Range& range) {
    return kLeaf | static_cast<std::uint32_t>((range.size() - 1) << kFirstBits | range.begin);
  }

  /// The place to cut a run: before the bin `first_right` of an axis.
  struct Cut {
    std::size_t axis = 0;
    std::size_t first_right = 0;
    double cost = std::numeric_limits<double>::infinity();  // area times count, summed over both sides
  };
  struct Bins {
    double begin = 0, per_unit = 0;
    [[nodiscard]] std::size_t of(double position) const {
      return std::min(static_cast<std::size_t>((position - begin) * per_unit), kBins - 1);
    }
  };

  /// The bins for the centers of a run, by axis; none for an axis on which all centers are equal.
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

  /// The end of the left part of a run; the run's begin if it should be a leaf.
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

  /// Adds the nodes of a run and stores its root. Runs of at most `part_size` become parts, to be built
  /// later.
  void build(const Part& run, std::size_t part_size) {
    const Range& range = run.range;
    const std::size_t middle = cut(range, run.box, run.depth);
    if (middle == range.begin) {
      *run.root = leaf(range);
      return;
    }
    *run.root = node_count++;
    Node& node = nodes[*run.root];
    const std::array<Range, 2> halves = {{{range.begin, middle}, {middle, range.end}}};
    for (std::size_t child = 0; child < 2; ++child) {
      const Part half = {halves[child], box_of(halves[child]), run.depth + 1, &node.children[child]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.sides[axis][0][child] = half.box.low[axis];
        node.sides[axis][1][child] = half.box.high[axis];
      }
      if (half.range.size() <= part_size)
        parts.push_back(half);
      else
        build(half, part_size);
    }
  }

  std::vector<Primitive>& primitives;
  Node* nodes;
  std::atomic<std::uint32_t> node_count = 0;
  std::vector<Part> parts;
};

Bvh::Bvh(std::vector<Primitive> primitives, ThreadPool& pool) {
  assert(primitives.size() <= kMaxPrimitives);
  if (primitives.empty()) return;
  // Every node cuts a run in two.
  nodes_ = std::make_unique_for_overwrite<Node[]>(primitives.size());
  Builder builder(primitives, nodes_.get());
  const Builder::Range all = {0, primitives.size()};
  // Parts are so small that threads share the work, but large enough to be worth a task.
  constexpr std::size_t kMinPart = 1024;
  const auto threads = static_cast<std::size_t>(pool.size());
  const std::size_t part_size = threads == 1 ? 0 : std::max(kMinPart, all.size() / (8 * threads));
  builder.build({all, builder.box_of(all), 0, &root_}, part_size);
  pool.start(static_cast<int>(builder.parts.size()),
             [&](int number, int) { builder.build(builder.parts[static_cast<std::size_t>(number)], 0); });
  pool.finish();
  node_count_ = builder.node_count;
  ids_.reserve(primitives.size());
  for (const Primitive& primitive : primitives) ids_.push_back(primitive.id);
}

}  // namespace pipeline
