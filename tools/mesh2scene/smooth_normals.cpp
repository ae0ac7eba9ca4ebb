#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <thread>
#include <utility>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/stream/thread_pool.h"
#include "tools/mesh2scene/readers.h"

namespace pipeline {
namespace {

constexpr auto kNone = static_cast<std::uint32_t>(-1);

std::size_t hash(const Vec3& p) {
  // Adding 0 removes a zero's sign, as both zeros are equal.
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
  std::uint64_t mixed = (bits(p.x) ^ std::rotl(bits(p.y), 32)) * 0x9e3779b97f4a7c15;
  mixed = (mixed ^ mixed >> 32 ^ bits(p.z)) * 0xbf58476d1ce4e5b9;
  return static_cast<std::size_t>(mixed ^ mixed >> 29);
}

/// The next corner at the same position, for each corner of triangles (3 t to 3 t + 2 for triangle t); after
/// the last, the first. Found by a hash table with linear probing.
std::vector<std::uint32_t> next_at_position(const std::vector<std::uint32_t>& corners,
                                            const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> next(corners.size()), last(std::bit_ceil(corners.size() + 1), kNone);
  const std::size_t mask = last.size() - 1;
  for (std::uint32_t corner = 0; corner < next.size(); ++corner) {
    const Vec3& p = points[corners[corner]];
    std::size_t slot = hash(p) & mask;
    while (last[slot] != kNone && points[corners[last[slot]]] != p) slot = (slot + 1) & mask;
    const std::uint32_t before = std::exchange(last[slot], corner);
    next[corner] = before == kNone ? corner : std::exchange(next[before], corner);
  }
  return next;
}

/// A triangle at one of its corners.
struct Share {
  Vec3 direction;  // of length 1, or 0 for a triangle without area
  double area, angle;
  double plane_area = area;  // of all triangles at this position in its plane

  [[nodiscard]] bool is_within(double cosine, const Vec3& other) const {
    return dot(direction, other) >= cosine;
  }
};

/// If more triangles share a position, each is compared only with the mean of all: time stays linear.
constexpr std::size_t kMany = 256;
/// Triangles count as in one plane if their normals differ by less than half a degree.
constexpr double kCoplanarCosine = 0.99996;
/// A plane with more than this share of the area at a position stays a plane there.
constexpr double kDominant = 0.8;

/// Sets the normals of all corners at a position.
struct Smoothing {
  const std::vector<std::uint32_t>& all_corners;
  const std::vector<Vec3>& points;
  double least_cosine, half_way_cosine;  // of the crease, and of half the crease
  std::vector<Floats>& normals;
  std::vector<Share> shares{};

  void smooth(std::span<const std::uint32_t> corners) {
    shares.clear();
    Vec3 mean;
    for (const std::uint32_t corner : corners) {
      shares.push_back(share_of(corner));
      mean = sum(mean, shares.back().direction);
    }
    mean = unit_vector(mean);
    const bool is_few = corners.size() <= kMany;
    double widest = 0, area = 0;
    for (Share& share : shares) {
      if (is_few) share.plane_area = plane_area(share);
      widest = std::max(widest, share.plane_area);
      area += share.area;
    }
    const auto is_near_mean = [&](const Share& share) { return share.is_within(half_way_cosine, mean); };
    const bool has_mean =
        !is_few || (widest <= kDominant * area && std::ranges::all_of(shares, is_near_mean));
    const Vec3 of_mean = has_mean ? weighted_sum(is_near_mean) : Vec3{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Share& own = shares[i];
      const bool is_of_mean = is_few || is_near_mean(own);
      const Vec3 n = !has_mean ? normal_beside(own) : is_of_mean ? of_mean : own.direction;
      normals[corners[i]] = floats(unit_vector(n));
    }
  }

  [[nodiscard]] Share share_of(std::size_t corner) const {
    const auto vertex = [&](std::size_t k) {
      return points[all_corners[corner - corner % 3 + (corner + k) % 3]];
    };
    const Vec3 p = vertex(0), a = difference(vertex(1), p), b = difference(vertex(2), p), n = cross(a, b);
    const double area = std::sqrt(dot(n, n));
    return {unit_vector(n), area, std::atan2(area, dot(a, b))};
  }

  [[nodiscard]] double plane_area(const Share& own) const {
    double area = 0;
    for (const Share& share : shares)
      if (share.is_within(kCoplanarCosine, own.direction)) area += share.area;
    return area;
  }

  template <typename Predicate>
  [[nodiscard]] Vec3 weighted_sum(const Predicate& belongs) const {
    Vec3 total;
    for (const Share& share : shares)
      if (belongs(share)) total = sum(total, scaled(share.direction, share.plane_area * share.angle));
    return total;
  }

  [[nodiscard]] Vec3 normal_beside(const Share& own) const {
    const auto is_near = [&](const Share& share) { return share.is_within(least_cosine, own.direction); };
    double area = 0;
    const Share* widest = &own;
    for (const Share& share : shares)
      if (is_near(share)) {
        area += share.area;
        if (share.plane_area > widest->plane_area) widest = &share;
      }
    if (widest->plane_area <= kDominant * area) return weighted_sum(is_near);
    const auto is_in_plane = [&](const Share& share) {
      return share.is_within(kCoplanarCosine, widest->direction);
    };
    // A small turn from the plane continues it, like a fillet; a larger turn is a chamfer beside it.
    if (own.is_within(half_way_cosine, widest->direction)) return weighted_sum(is_in_plane);
    return weighted_sum([&](const Share& share) { return is_near(share) && !is_in_plane(share); });
  }
};

std::vector<Floats> smooth_normals(const std::vector<std::uint32_t>& all_corners,
                                   const std::vector<Vec3>& points, double crease_degrees) {
  const std::vector<std::uint32_t> next = next_at_position(all_corners, points);
  std::vector<Floats> normals(all_corners.size());
  constexpr std::size_t kAtOnce = 3 << 14;
  const std::size_t task_count = normals.size() / kAtOnce + 1;
  ThreadPool pool(task_count < 4 ? 1
                                 : static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U)));
  // A little smaller than the cosine, so that a crease of 0 smooths a plane.
  const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180) - 1e-6; };
  pool.start(static_cast<int>(task_count), [&](int task, int) {
    Smoothing smoothing = {all_corners, points, cosine(crease_degrees), cosine(crease_degrees / 2), normals};
    std::vector<std::uint32_t> corners;
    const std::size_t begin = static_cast<std::size_t>(task) * kAtOnce,
                      end = std::min(begin + kAtOnce, next.size());
    // In the file's order, in which neighbors mostly stand together, so that memory is near.
    for (std::size_t last = begin; last < end; ++last) {
      if (next[last] > last) continue;
      corners.clear();
      auto corner = static_cast<std::uint32_t>(last);
      do corners.push_back(corner = next[corner]);
      while (corner != last);
      smoothing.smooth(corners);
    }
  });
  pool.finish();
  return normals;
}

}  // namespace

void add_normals(Model& model, double crease_degrees) {
  std::map<std::size_t, std::vector<ModelMesh*>> surfaces;
  for (ModelMesh& mesh : model.meshes)
    if (mesh.normals.empty() && !mesh.shape) surfaces[mesh.surface].push_back(&mesh);
  for (const auto& [surface, meshes] : surfaces) {
    std::vector<std::uint32_t> corners;
    for (const ModelMesh* mesh : meshes)
      corners.insert(corners.end(), mesh->corners.begin(), mesh->corners.end());
    std::vector<Floats> normals(corners.size());  // 0, which makes them flat
    if (surface != 0) normals = smooth_normals(corners, model.points, crease_degrees);
    const Floats* begin = normals.data();
    for (ModelMesh* mesh : meshes) {
      mesh->normals.assign(begin, begin + mesh->corners.size());
      begin += mesh->corners.size();
    }
  }
}

}  // namespace pipeline
