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

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/stream/thread_pool.h"

namespace pipeline {
namespace {

Vec3 position_of(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// Numbers the positions of vertices from 0 on, equal ones alike, by a hash table with linear probing.
class PositionNumbers {
 public:
  explicit PositionNumbers(const aiMesh& mesh) : of_vertex_(mesh.mNumVertices) {
    std::vector<std::uint32_t> table(std::bit_ceil(std::size_t{2} * mesh.mNumVertices + 1), kEmpty);
    std::vector<std::uint32_t> first_vertices;
    for (std::uint32_t i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& p = mesh.mVertices[i];
      std::size_t place = hash(p) & (table.size() - 1);
      while (table[place] != kEmpty && mesh.mVertices[first_vertices[table[place]]] != p)
        place = (place + 1) & (table.size() - 1);
      if (table[place] == kEmpty) {
        table[place] = static_cast<std::uint32_t>(first_vertices.size());
        first_vertices.push_back(i);
      }
      of_vertex_[i] = table[place];
    }
    count_ = first_vertices.size();
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::uint32_t operator[](std::size_t vertex) const { return of_vertex_[vertex]; }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffff;

  static std::size_t hash(const aiVector3D& p) {
    // Adding 0 takes the sign from a zero, which equals the other one.
    const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0F)}; };
    std::uint64_t mixed = (bits(p.x) << 32 | bits(p.y)) * 0x9e3779b97f4a7c15;
    mixed = (mixed ^ mixed >> 32 ^ bits(p.z)) * 0xbf58476d1ce4e5b9;
    return static_cast<std::size_t>(mixed ^ mixed >> 29);
  }

  std::vector<std::uint32_t> of_vertex_;
  std::size_t count_ = 0;
};

/// The corners of triangles, 3 t to 3 t + 2 for triangle t, in the order of their positions.
class CornersByPosition {
 public:
  explicit CornersByPosition(const aiMesh& mesh) {
    const PositionNumbers numbers(mesh);
    begins_.resize(numbers.count() + 1);
    const auto number_of = [&](std::size_t corner) {
      return numbers[mesh.mFaces[corner / 3].mIndices[corner % 3]];
    };
    const std::size_t corner_count = std::size_t{3} * mesh.mNumFaces;
    for (std::size_t corner = 0; corner < corner_count; ++corner) ++begins_[number_of(corner) + 1];
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    std::vector<std::size_t> ends(begins_.begin(), begins_.end() - 1);
    corners_.resize(corner_count);
    for (std::size_t corner = 0; corner < corner_count; ++corner)
      corners_[ends[number_of(corner)]++] = corner;
  }

  [[nodiscard]] std::size_t count() const { return begins_.size() - 1; }
  /// Those at one position.
  [[nodiscard]] std::span<const std::size_t> operator[](std::size_t i) const {
    return {corners_.data() + begins_[i], begins_[i + 1] - begins_[i]};
  }

 private:
  std::vector<std::size_t> begins_;
  std::vector<std::size_t> corners_;
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
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const bool is_few = corners.size() <= kMany;
      normals_[corners[i]] = are_all_near || (!is_few && is_near_mean(shares_[i]))
                                 ? normal_of_all
                                 : unit_normal(is_few ? mean_beside(shares_[i]) : shares_[i].direction);
    }
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
  const CornersByPosition corners(mesh);
  CornerNormals normals(std::size_t{3} * mesh.mNumFaces);
  constexpr std::size_t kAtOnce = 4096, kMostTasks = 64;
  const std::size_t task_count = std::min(corners.count() / kAtOnce + 1, kMostTasks);
  ThreadPool pool(task_count < 4 ? 1
                                 : static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U)));
  pool.start(static_cast<int>(task_count), [&](int task, int) {
    Smoothing smoothing(mesh, crease_degrees, normals);
    const auto begin_of = [&](int number) {
      return corners.count() * static_cast<std::size_t>(number) / task_count;
    };
    for (std::size_t i = begin_of(task); i < begin_of(task + 1); ++i) smoothing.smooth(corners[i]);
  });
  pool.finish();
  return normals;
}

}  // namespace pipeline
