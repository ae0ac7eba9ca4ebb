#include "tools/mesh2scene/smooth_normals.h"

#include <assimp/mesh.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <thread>
#include <utility>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/stream/thread_pool.h"

namespace pipeline {
namespace {

Vec3 position_of(const aiMesh& mesh, std::size_t corner) {
  const aiVector3D& v = mesh.mVertices[mesh.mFaces[corner / 3].mIndices[corner % 3]];
  return {v.x, v.y, v.z};
}

/// The corners of triangles, 3 t to 3 t + 2 for triangle t, by their positions: in the slots of a hash table
/// with linear probing, one for each position.
class CornersByPosition {
 public:
  CornersByPosition(const aiMesh& mesh)
      : mesh_(mesh),
        first_(std::bit_ceil(std::size_t{3} * mesh.mNumFaces + 1), kNone),
        next_(std::size_t{3} * mesh.mNumFaces) {
    for (auto corner = static_cast<std::uint32_t>(next_.size()); corner-- > 0;) {
      const Vec3 p = position(corner);
      std::size_t slot = hash(p) & (first_.size() - 1);
      while (first_[slot] != kNone && position(first_[slot]) != p) slot = (slot + 1) & (first_.size() - 1);
      next_[corner] = std::exchange(first_[slot], corner);
    }
  }

  [[nodiscard]] std::size_t slot_count() const { return first_.size(); }
  /// Fills `corners` with those at the position of a slot, in their order.
  void list(std::size_t slot, std::vector<std::uint32_t>& corners) const {
    corners.clear();
    for (std::uint32_t corner = first_[slot]; corner != kNone; corner = next_[corner])
      corners.push_back(corner);
  }

 private:
  static constexpr auto kNone = static_cast<std::uint32_t>(-1);

  static std::size_t hash(const Vec3& p) {
    // Adding 0 takes the sign from a zero, which equals the other one.
    const auto bits = [](double x) {
      return std::uint64_t{std::bit_cast<std::uint32_t>(static_cast<float>(x) + 0.0F)};
    };
    std::uint64_t mixed = (bits(p.x) << 32 | bits(p.y)) * 0x9e3779b97f4a7c15;
    mixed = (mixed ^ mixed >> 32 ^ bits(p.z)) * 0xbf58476d1ce4e5b9;
    return static_cast<std::size_t>(mixed ^ mixed >> 29);
  }
  [[nodiscard]] Vec3 position(std::size_t corner) const { return position_of(mesh_, corner); }

  const aiMesh& mesh_;
  std::vector<std::uint32_t> first_;  // of each slot; then the next one at the same position, for each corner
  std::vector<std::uint32_t> next_;
};

/// A triangle at one of its corners.
struct Share {
  Vec3 direction;  // of length 1, or 0 for a triangle without area
  double area, angle;
  double plane_area = area;  // of all triangles at this position in its plane
};

/// Above this many triangles at a position, each is compared only with the mean of all: time stays linear.
constexpr std::size_t kMany = 256;
/// Triangles are in one plane if their normals differ by less than half a degree.
constexpr double kCoplanarCosine = 0.99996;
/// A plane with more than this share of the area at a position stays a plane there.
constexpr double kDominant = 0.8;

class Smoothing {
 public:
  Smoothing(const aiMesh& mesh, double crease_degrees, CornerNormals& normals)
      : mesh_(mesh),
        least_cosine_(cosine(crease_degrees)),
        half_way_cosine_(cosine(crease_degrees / 2)),
        normals_(normals) {}

  void smooth(std::span<const std::uint32_t> corners) {
    shares_.clear();
    Vec3 mean;
    for (const std::uint32_t corner : corners) {
      shares_.push_back(share_of(corner));
      mean = sum(mean, shares_.back().direction);
    }
    mean = unit_vector(mean);
    const bool is_few = corners.size() <= kMany;
    double widest = 0, area = 0;
    for (Share& share : shares_) {
      if (is_few) share.plane_area = plane_area(share);
      widest = std::max(widest, share.plane_area);
      area += share.area;
    }
    const auto is_near_mean = [&](const Share& share) {
      return dot(share.direction, mean) >= half_way_cosine_;
    };
    const bool is_one_surface = widest <= kDominant * area && std::ranges::all_of(shares_, is_near_mean);
    const CornerNormals::value_type of_surface =
        is_one_surface || !is_few ? unit_normal(weighted_sum(is_near_mean)) : CornerNormals::value_type{};
    for (std::size_t i = 0; i < corners.size(); ++i)
      normals_[corners[i]] = is_one_surface || (!is_few && is_near_mean(shares_[i])) ? of_surface
                             : is_few ? unit_normal(normal_beside(shares_[i]))
                                      : unit_normal(shares_[i].direction);
  }

 private:
  static double cosine(double degrees) {
    // A little less, so that a crease of 0 smooths a plane.
    return std::cos(degrees * std::numbers::pi / 180) - 1e-6;
  }

  [[nodiscard]] Share share_of(std::size_t corner) const {
    const auto vertex = [&](std::size_t k) {
      return position_of(mesh_, corner - corner % 3 + (corner + k) % 3);
    };
    const Vec3 p = vertex(0), a = difference(vertex(1), p), b = difference(vertex(2), p), n = cross(a, b);
    const double area = std::sqrt(dot(n, n));
    return {unit_vector(n), area, std::atan2(area, dot(a, b))};
  }

  [[nodiscard]] double plane_area(const Share& own) const {
    double area = 0;
    for (const Share& share : shares_)
      if (dot(share.direction, own.direction) >= kCoplanarCosine) area += share.area;
    return area;
  }

  template <typename Predicate>
  [[nodiscard]] Vec3 weighted_sum(const Predicate& belongs) const {
    Vec3 total;
    for (const Share& share : shares_)
      if (belongs(share)) total = sum(total, scaled(share.direction, share.plane_area * share.angle));
    return total;
  }

  [[nodiscard]] Vec3 normal_beside(const Share& own) const {
    const auto is_near = [&](const Share& share) {
      return dot(share.direction, own.direction) >= least_cosine_;
    };
    double area = 0;
    const Share* widest = &own;
    for (const Share& share : shares_)
      if (is_near(share)) {
        area += share.area;
        if (share.plane_area > widest->plane_area) widest = &share;
      }
    if (widest->plane_area <= kDominant * area) return weighted_sum(is_near);
    const auto is_in_plane = [&](const Share& share) {
      return dot(share.direction, widest->direction) >= kCoplanarCosine;
    };
    // A small turn from the plane continues it, as a fillet; a larger one makes a chamfer beside it.
    if (dot(own.direction, widest->direction) >= half_way_cosine_) return weighted_sum(is_in_plane);
    return weighted_sum([&](const Share& share) { return is_near(share) && !is_in_plane(share); });
  }

  static CornerNormals::value_type unit_normal(const Vec3& normal) {
    const Vec3 n = unit_vector(normal);
    return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
  }

  const aiMesh& mesh_;
  double least_cosine_, half_way_cosine_;
  CornerNormals& normals_;
  std::vector<Share> shares_;
};

}  // namespace

CornerNormals smooth_normals(const aiMesh& mesh, double crease_degrees) {
  const CornersByPosition by_position(mesh);
  CornerNormals normals(std::size_t{3} * mesh.mNumFaces);
  constexpr std::size_t kSlotsAtOnce = 1 << 14;
  const std::size_t task_count = by_position.slot_count() / kSlotsAtOnce + 1;
  ThreadPool pool(task_count < 4 ? 1
                                 : static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U)));
  pool.start(static_cast<int>(task_count), [&](int task, int) {
    Smoothing smoothing(mesh, crease_degrees, normals);
    std::vector<std::uint32_t> corners;
    const std::size_t begin = static_cast<std::size_t>(task) * kSlotsAtOnce;
    for (std::size_t i = begin; i < std::min(begin + kSlotsAtOnce, by_position.slot_count()); ++i) {
      by_position.list(i, corners);
      if (!corners.empty()) smoothing.smooth(corners);
    }
  });
  pool.finish();
  return normals;
}

}  // namespace pipeline
