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

Vec3 position_of(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// The corners of triangles, 3 t to 3 t + 2 for triangle t, by their positions: in the slots of a hash table
/// with linear probing, one for each position.
class CornersByPosition {
 public:
  explicit CornersByPosition(const aiMesh& mesh)
      : mesh_(mesh),
        first_(std::bit_ceil(std::size_t{2} * mesh.mNumVertices + 1), kNone),
        next_(std::size_t{3} * mesh.mNumFaces) {
    for (std::size_t corner = next_.size(); corner-- > 0;) {
      const aiVector3D& p = position(corner);
      std::size_t slot = hash(p) & (first_.size() - 1);
      while (first_[slot] != kNone && position(first_[slot]) != p) slot = (slot + 1) & (first_.size() - 1);
      next_[corner] = std::exchange(first_[slot], corner);
    }
  }

  [[nodiscard]] std::size_t slot_count() const { return first_.size(); }
  /// Fills `corners` with those at the position of a slot, in their order.
  void list(std::size_t slot, std::vector<std::size_t>& corners) const {
    corners.clear();
    for (std::size_t corner = first_[slot]; corner != kNone; corner = next_[corner])
      corners.push_back(corner);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  static std::size_t hash(const aiVector3D& p) {
    // Adding 0 takes the sign from a zero, which equals the other one.
    const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0F)}; };
    std::uint64_t mixed = (bits(p.x) << 32 | bits(p.y)) * 0x9e3779b97f4a7c15;
    mixed = (mixed ^ mixed >> 32 ^ bits(p.z)) * 0xbf58476d1ce4e5b9;
    return static_cast<std::size_t>(mixed ^ mixed >> 29);
  }
  [[nodiscard]] const aiVector3D& position(std::size_t corner) const {
    return mesh_.mVertices[mesh_.mFaces[corner / 3].mIndices[corner % 3]];
  }

  const aiMesh& mesh_;
  std::vector<std::size_t> first_;  // of each slot; then the next one at the same position, for each corner
  std::vector<std::size_t> next_;
};

/// A triangle's contribution to the normal at one of its corners.
struct Share {
  Vec3 direction;  // of length 1, or 0 for a triangle without area
  Vec3 weighted;
};

Share share_of(const aiMesh& mesh, std::size_t corner) {
  const unsigned* const indices = mesh.mFaces[corner / 3].mIndices;
  const auto vertex = [&](std::size_t k) { return position_of(mesh.mVertices[indices[(corner + k) % 3]]); };
  const Vec3 p = vertex(0);
  const Vec3 a = difference(vertex(1), p), b = difference(vertex(2), p);
  const Vec3 n = cross(a, b);
  const double lengths = dot(a, a) * dot(b, b);
  return {unit_vector(n), lengths > 0 ? scaled(n, 1 / lengths) : Vec3{}};
}

/// Above this many triangles at a position, each is compared only with the mean of all: time stays linear.
constexpr std::size_t kMany = 256;

class Smoothing {
 public:
  Smoothing(const aiMesh& mesh, double crease_degrees, CornerNormals& normals)
      : mesh_(mesh),
        least_cosine_(cosine(crease_degrees)),
        half_way_cosine_(cosine(crease_degrees / 2)),
        normals_(normals) {}

  void smooth(std::span<const std::size_t> corners) {
    shares_.clear();
    Vec3 mean, all;
    for (const std::size_t corner : corners) {
      shares_.push_back(share_of(mesh_, corner));
      mean = sum(mean, shares_.back().direction);
      all = sum(all, shares_.back().weighted);
    }
    mean = unit_vector(mean);
    const auto is_near_mean = [&](const Share& share) {
      return dot(share.direction, mean) >= half_way_cosine_;
    };
    const bool are_all_near = std::all_of(shares_.begin(), shares_.end(), is_near_mean);
    const auto normal_of_all = unit_normal(all);
    const bool is_few = corners.size() <= kMany;
    for (std::size_t i = 0; i < corners.size(); ++i)
      normals_[corners[i]] = are_all_near || (!is_few && is_near_mean(shares_[i]))
                                 ? normal_of_all
                                 : unit_normal(is_few ? mean_beside(shares_[i]) : shares_[i].direction);
  }

 private:
  static double cosine(double degrees) {
    // A little less, so that a crease of 0 smooths a plane.
    return std::cos(degrees * std::numbers::pi / 180) - 1e-6;
  }

  [[nodiscard]] Vec3 mean_beside(const Share& own) const {
    Vec3 total;
    for (const Share& share : shares_)
      if (dot(share.direction, own.direction) >= least_cosine_) total = sum(total, share.weighted);
    return total;
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
    std::vector<std::size_t> corners;
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
