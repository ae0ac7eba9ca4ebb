#include "libpipeline/vertex/lost_digits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

// Over the limit of work, one row in three stays. A unit of work is about ten instructions. Beyond
// kSmallScene triangles, the limit (plus a unit per kTrianglesAUnit) is below 1 % of the work of `project`.
constexpr std::size_t kFewTriangles = 256, kSmallScene = 1024, kMostRows = 81, kLeastRows = 3;
constexpr std::size_t kMostWork = 90'000, kWorkForLarge = 5'500, kWorkForRows = 6'000, kTrianglesAUnit = 5;
constexpr unsigned kTrialCount = 5;
constexpr std::size_t kAskedForDecimals = 8;
constexpr int kMostDecimals = 12;       // more cost as much as all digits
constexpr int kFewestDecimals = 6;      // numbers with fewer were typed, unless the text written has as few
constexpr double kFewUnits = 2000;      // over the window's height; of 1000 rows, each is half a row
constexpr double kLeastShare = 0.005;   // below it, no loss is reported
constexpr double kNoPixel = 5e-7;       // a share
constexpr double kDoubleError = 1e-14;  // of a depth

// Places over the window's width or height, one of them near the middle, where no grid of vertices is.
constexpr std::size_t kColumns = 81;
constexpr double kMiddle = 0.0037, kPlacesPerUnit = 81.13 / 2 / 81;  // times their count

double place_at(std::size_t index, std::size_t count) {
  const auto places = static_cast<double>(count);
  return (static_cast<double>(index) - (places - 1) / 2) / (places * kPlacesPerUnit) + kMiddle;
}

/// The index of the first place that is at least at `value`.
std::size_t place_from(double value, std::size_t count) {
  const auto places = static_cast<double>(count);
  const double index = (value - kMiddle) * (places * kPlacesPerUnit) + (places - 1) / 2;
  return static_cast<std::size_t>(std::ceil(std::clamp(index, 0.0, places)));
}

double power_of_ten(int exponent) {
  return kPowersOfTen[static_cast<std::size_t>(exponent)];
}

double rounded(double value, int decimals) {
  return std::nearbyint(value * power_of_ten(decimals)) / power_of_ten(decimals);
}

/// A pseudorandom number from -1 to 1; the same for the same arguments.
double scattered(double value, unsigned trial) {
  std::uint64_t bits = std::bit_cast<std::uint64_t>(value + 0.0) + trial * 0x9e3779b97f4a7c15u;
  for (const int shift : {30, 27, 31}) bits = (bits ^ (bits >> shift)) * 0xbf58476d1ce4e5b9u;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

Triangle with_numbers(Triangle triangle, const auto& change) {
  for (Vec3& p : triangle) p = {change(p.x), change(p.y), change(p.z)};
  return triangle;
}

}  // namespace

LostDigits::Surface::Surface(const Triangle& printed, const Triangle& read) : p_ndc(printed), p_view(read) {
  const auto& [a, b, c] = p_ndc;
  area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  z_x = ((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) / area;
  z_y = ((b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z)) / area;
}

LostDigits::LostDigits(const ProjectionTransform& projection, std::optional<int> decimals,
                       std::optional<int> decimals_read)
    : projection_(projection),
      view_from_clip_(projection),
      x_scale_(std::fabs(projection.x_scale.nearest_double())),
      y_scale_(std::fabs(projection.y_scale.nearest_double())),
      z_scale_(projection.is_perspective ? 2 * projection.near / (1 - projection.near / projection.far)
                                         : 2 / (projection.far - projection.near)),
      tilt_(projection.is_perspective ? 1 : 0),
      decimals_(decimals),
      decimals_read_(decimals_read.value_or(decimals.value_or(kMostDecimals + 1))),
      half_written_(decimals ? 0.5 / power_of_ten(*decimals) : 0) {}

/// Decides whether a stage has rounded the first numbers read, so that they have lost digits: then many of
/// them do not end in 0.
void LostDigits::look_for_decimals() {
  if (decimals_read_ > kMostDecimals || (decimals_read_ < kFewestDecimals && decimals_read_ != decimals_))
    return;
  std::size_t asked_count = 0, count = 0;
  for (std::size_t i = 0; i < kept_.size(); i += kept_.size() / kAskedForDecimals + 1, ++asked_count)
    for (const Vec3& p : kept_read_[i])
      for (const double number : {p.x, p.y, p.z}) {
        if (rounded(number, decimals_read_) != number) return;
        if (std::fmod(std::nearbyint(number * power_of_ten(decimals_read_)), 10) != 0) ++count;
      }
  unit_read_ = 1 / power_of_ten(decimals_read_);
  if (count >= asked_count * 9 / 4) half_read_ = unit_read_ / 2;
}

void LostDigits::add(const TriangleBatch& p_view, const TriangleBatch& p_ndc) {
  std::size_t whole = 0;
  const auto read = [&](std::size_t index) -> const Triangle& {
    // Facets of a sphere have one number; a piece's corners are at lines of its triangle.
    const auto is_whole = [&](std::size_t i) {
      const auto& [a, b, c] = p_view.locations[i];
      const LineAndColumn& corner = p_ndc.locations[index][0];
      return p_view.numbers[i] == p_ndc.numbers[index] && (corner == a || corner == b || corner == c);
    };
    if (index < p_view.size() && is_whole(index)) whole = index;
    while (whole + 1 < p_view.size() && !is_whole(whole)) ++whole;
    return p_view.triangles[whole];
  };
  std::size_t i = 0;
  if (rows_.empty()) {
    if (p_ndc.size() > 1)
      for (auto* kept : {&kept_, &kept_read_}) kept->reserve(kSmallScene + 1);
    for (; i < p_ndc.size() && kept_.size() <= kSmallScene; ++i) {
      kept_.push_back(p_ndc.triangles[i]);
      kept_read_.push_back(read(i));
    }
    if (kept_.size() > kSmallScene) look_at_kept();
  }
  if (!rows_.empty())
    look_at(std::span(p_ndc.triangles).subspan(i), [&](std::size_t index) { return read(i + index); });
}

/// Chooses the rows, and looks at the triangles that are kept.
void LostDigits::look_at_kept() {
  look_for_decimals();
  coefficients_ = coefficients_of(projection_);
  const std::size_t count = kept_.size();
  rows_.resize(kMostRows / (count > 2 * kFewTriangles ? 9 : count > kFewTriangles ? 3 : 1));
  look_at(kept_, [&](std::size_t index) { return kept_read_[index]; });
  kept_ = kept_read_ = {};
}

/// Looks at triangles, which `read` returns as they were read. Over the limit of work, drops rows or, at
/// kLeastRows, a triangle (a near one at twice the limit).
void LostDigits::look_at(std::span<const Triangle> p_ndc, const auto& read) {
  constexpr double kMostReach = 1e-3;  // of triangles that lie behind all places but for their reach
  const bool is_small = triangle_count_ + p_ndc.size() <= kSmallScene;
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    // Most triangles of large scenes lie between two rows.
    const double per_unit = static_cast<double>(rows_.size()) * kPlacesPerUnit;
    const double halfway = 0.5 - kMiddle * per_unit;
    const auto strip = [&](const Vec3& p) { return p.y * per_unit + halfway + kWholeRounder; };
    const auto is_between = [&](const Triangle& p) {
      return strip(p[0]) == strip(p[1]) && strip(p[0]) == strip(p[2]);
    };
    while (i < p_ndc.size() && is_between(p_ndc[i])) ++i;
    if (i == p_ndc.size()) break;
    const auto& [a, b, c] = p_ndc[i];
    const double nearest = std::min({a.z, b.z, c.z});
    const std::size_t most_work =
        is_small ? kMostWork : kWorkForLarge + (triangle_count_ + i) / kTrianglesAUnit;
    work_ += 2;
    if (nearest > 1 || nearest - kMostReach > farthest_) continue;
    for (; work_ > most_work && rows_.size() > kLeastRows; work_ /= 3) {
      // Every third row stays, from the second on.
      for (std::size_t j = 0; 3 * j + 1 < rows_.size(); ++j) rows_[j] = std::move(rows_[3 * j + 1]);
      rows_.resize(rows_.size() / 3);
    }
    if (work_ > (most_work + kWorkForRows) * (std::max({a.z, b.z, c.z}) < farthest_ ? 2 : 1)) continue;
    Surface surface(p_ndc[i], read(i));
    const double reach = depth_error(surface, std::max(nearest, -1.0), half_read_, half_written_);
    work_ += 16;
    if (!std::isfinite(reach)) continue;
    const auto index = static_cast<std::uint32_t>(seen_.size());
    const std::size_t end = place_from(std::max({a.y, b.y, c.y}), rows_.size());
    for (std::size_t j = place_from(std::min({a.y, b.y, c.y}), rows_.size()); j < end; ++j)
      if (nearest - reach <= rows_[j].farthest)
        look_along(rows_[j], place_at(j, rows_.size()), surface, reach, index);
  }
  triangle_count_ += p_ndc.size();
}

/// Compares a triangle with the nearest one at each place of a row.
void LostDigits::look_along(Row& row, double y, Surface& surface, double reach, std::uint32_t index) {
  double left = 1, right = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = surface.p_ndc[i], &q = surface.p_ndc[(i + 1) % 3];
    if ((p.y < y) == (q.y < y)) continue;
    const double x = p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y));
    left = std::min(left, x);
    right = std::max(right, x);
  }
  const std::size_t begin = place_from(left, kColumns), end = place_from(right, kColumns);
  if (begin >= end) return;
  if (row.places.empty()) row.places.resize(kColumns);
  work_ += 10 + end - begin;
  const Surface plane = surface;  // stays the same along the row
  for (std::size_t column = begin; column < end; ++column) {
    const double z = plane.at(place_at(column, kColumns), y);
    Place& place = row.places[column];
    if (!(z >= -1 && z <= 1 && z - reach <= place.z + place.reach)) continue;
    if (index == seen_.size()) {
      undo_rounding(surface);
      seen_.push_back(surface);
    }
    const double gap = std::fabs(z - place.z);
    const bool is_rival = place.nearest != kNone && gap <= reach + place.reach &&
                          !std::ranges::is_permutation(seen_[place.nearest].p_ndc, surface.p_ndc);
    if (z < place.z)
      place = {z, reach, gap, index, is_rival ? place.nearest : kNone};
    else if (is_rival && (place.rival == kNone || gap <= place.gap))
      std::tie(place.rival, place.gap) = std::tuple(index, gap);
  }
  constexpr unsigned kLooks = 16;
  if (++row.look_count % kLooks != 0) return;
  row.farthest = -1;
  for (const Place& place : row.places) row.farthest = std::max(row.farthest, place.z + place.reach);
  farthest_ = std::ranges::max_element(rows_, {}, &Row::farthest)->farthest;
}

/// Recalculates p_ndc, which may be rounded, from p_view, as read. A piece's p_view becomes the points of the
/// uncut triangle's plane that are seen where its corners are.
void LostDigits::undo_rounding(Surface& surface) const {
  constexpr double kSame = 1e-6;
  Triangle p_view = surface.p_view;
  const auto are_same = [](const Vec3& p, const Vec3& q) {
    return std::fabs(p.x - q.x) + std::fabs(p.z - q.z) < kSame;
  };
  if (!std::ranges::equal(projected(p_view), surface.p_ndc, are_same)) {
    const Vec3 normal = face_normal(p_view), corner = p_view[0];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto seen_at = [&](double z) {
        const double w = view_from_clip_.w_of({0, 0, z});
        return view_from_clip_({surface.p_ndc[i].x * w, surface.p_ndc[i].y * w, z * w}, w);
      };
      const Vec3 near = seen_at(-1), along = difference(seen_at(1), near);
      const double share = dot(normal, difference(corner, near)) / dot(normal, along);
      const Vec3 p = sum(near, scaled(along, share));
      // There is no such point, or it is unknown, if the triangle is seen edge-on, or huge.
      p_view[i] = std::isfinite(p.x + p.y + p.z) ? p : seen_at(surface.p_ndc[i].z);
    }
  }
  surface = Surface(projected(p_view), p_view);
}

Triangle LostDigits::projected(const Triangle& p_view) const {
  VertexBlock vertices;
  ImageBlock images;
  vertices.fill({&p_view, 1});
  vertex_kernel().project(coefficients_, {}, vertices, images);
  return images.triangle(0);
}

/// A bound on the error, from lost digits, of a plane's depth where it is `z`: the nearer, the larger. Model
/// and view have rounded the numbers read.
double LostDigits::depth_error(const Surface& surface, double z, double read, double written) const {
  const double z_x = std::fabs(surface.z_x), z_y = std::fabs(surface.z_y),
               w = view_from_clip_.w_of({0, 0, z});
  const double by_view = (z_x * (x_scale_ + tilt_) + z_y * (y_scale_ + tilt_) + z_scale_ / w) / w;
  return (written + kDoubleError) * (1 + z_x + z_y) + 2 * read * by_view;
}

/// The share of the triangle that its edges sweep over, if they all move as where it is at `z`. On average,
/// an edge is off by 0.38 half units, or sqrt(2) times that if rounded twice; half of the swept area is the
/// triangle's own loss.
double LostDigits::edge_share(const Surface& surface, double z) const {
  const double scale = (x_scale_ + y_scale_ + tilt_) / 2 / view_from_clip_.w_of({0, 0, z});
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = surface.p_ndc[i], &q = surface.p_ndc[(i + 1) % 3];
    length += std::hypot(p.x - q.x, p.y - q.y);
  }
  const double off = half_written_ + std::numbers::sqrt2 * half_read_ * scale;
  return std::min(0.38 * off * length / std::fabs(surface.area), 1.0);
}

/// The triangle with possible numbers, which model and view would round to those read. Equal numbers stay
/// equal.
Triangle LostDigits::possible_truth(const Surface& surface, unsigned trial) const {
  if (half_read_ == 0) return surface.p_ndc;
  const auto truth = [&](double number) {
    const double read = rounded(number, decimals_read_);
    return number + half_read_ * (scattered(read, trial) + scattered(read, ~trial));
  };
  return projected(with_numbers(surface.p_view, truth));
}

/// The share of equally likely cases, which should differ from place to place, in which the two surfaces at a
/// place are printed in the wrong order. Among equal depths, the earlier triangle is seen.
double LostDigits::wrong_share(const Place& place, double x, double y, unsigned first_trial) const {
  const auto [first, second] = std::minmax(place.nearest, place.rival);
  const Surface &a = seen_[first], &b = seen_[second];
  const auto is_second_nearer = [&](const auto& image) {
    return Surface(image(b), {}).at(x, y) < Surface(image(a), {}).at(x, y) - kDoubleError;
  };
  const bool is_printed_nearer = is_second_nearer([&](const Surface& surface) {
    return !decimals_ ? surface.p_ndc
                      : with_numbers(surface.p_ndc, [&](double n) { return rounded(n, *decimals_); });
  });
  // If numbers are as coarse as pixels, surfaces printed in one plane were probably layers.
  const double w = view_from_clip_.w_of({0, 0, place.z});
  if (place.gap <= kDoubleError && unit_read_ * y_scale_ / w > 2 / kFewUnits) return 0.5;
  unsigned wrong_count = 0;
  for (unsigned trial = first_trial; trial < first_trial + kTrialCount; ++trial)
    if (is_second_nearer([&](const Surface& s) { return possible_truth(s, trial); }) != is_printed_nearer)
      ++wrong_count;
  return static_cast<double>(wrong_count) / kTrialCount;
}

std::optional<LostDigits::Found> LostDigits::found() {
  if (kept_.size() == 1) return std::nullopt;  // one triangle has no rival
  if (rows_.empty()) look_at_kept();
  // Counts of places; those that may be wrong count by their share.
  double shown = 0, wrong = 0, at_edges = 0, in_one_plane = 0, nearest = 2;
  int more = 1;  // decimals, so that no pixel should be wrong
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t column = 0; column < rows_[i].places.size(); ++column) {
      const Place& place = rows_[i].places[column];
      if (place.nearest == kNone) continue;
      const Surface& a = seen_[place.nearest];
      ++shown;
      nearest = std::min(nearest, place.z);
      at_edges += edge_share(a, place.z);
      if (place.rival == kNone) continue;
      const Surface& b = seen_[place.rival];
      const double x = place_at(column, kColumns), y = place_at(i, rows_.size());
      const double gap = std::fabs(a.at(x, y) - b.at(x, y));
      const auto are_close = [&](double read, double written, int decimals = 0) {
        const double times = power_of_ten(decimals);
        const auto error = [&](const Surface& s) {
          return depth_error(s, place.z, read / times, written / times);
        };
        return gap <= error(a) + error(b);
      };
      if (!are_close(half_read_, half_written_)) continue;
      const double share = wrong_share(place, x, y, kTrialCount * static_cast<unsigned>(shown));
      if (share == 0) continue;
      wrong += share;
      if (are_close(half_read_, 0)) in_one_plane += share;
      while (more <= kMostDecimals && are_close(half_read_, half_written_, more)) ++more;
    }
  while (more <= kMostDecimals && at_edges / shown / power_of_ten(more) >= kNoPixel) ++more;
  const double share = (wrong + at_edges) / shown;
  if (!(share >= kLeastShare)) return std::nullopt;
  Found found;
  found.share = share;
  found.is_of_edges = at_edges > wrong;
  found.decimals = decimals_.value_or(decimals_read_);
  found.may_be_one_plane = in_one_plane > share * shown / 2;
  found.near_helps = projection_.is_perspective && !found.is_of_edges && !found.may_be_one_plane &&
                     view_from_clip_.w_of({0, 0, nearest}) > 4 * projection_.near;
  if (in_one_plane == 0 && found.decimals + more <= kMostDecimals) found.enough = found.decimals + more;
  return found;
}

}  // namespace pipeline
