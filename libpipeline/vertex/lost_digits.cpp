#include "libpipeline/vertex/lost_digits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "libpipeline/numbers/decimal_units.h"

namespace pipeline {
namespace {

// Over the limit of work, one row in three stays. A unit of work is about ten instructions. Beyond
// kSmallScene triangles, the limit (plus a unit per kTrianglesAUnit) is below 1 % of the work of `project`.
constexpr std::size_t kSmallestScene = 256, kSmallScene = 1024, kLeastRows = 3;
constexpr std::size_t kMostWork = 90'000, kWorkForLarge = 5'500, kWorkForRows = 6'000, kTrianglesAUnit = 5;
constexpr unsigned kTrialCount = 5;
constexpr std::size_t kAskedForDecimals = 8;
constexpr int kMostDecimals = 12;       // more cost as much as all digits
constexpr int kFewestDecimals = 6;      // numbers with fewer were typed, unless the text written has as few
constexpr double kFewUnits = 2000;      // over the window's height; of 1000 rows, each is half a row
constexpr double kLeastShare = 0.005;   // below it, no loss is reported
constexpr double kNoPixel = 5e-7;       // a share
constexpr double kDoubleError = 1e-14;  // of a depth

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

LostDigits::Plane::Plane(const Triangle& p_ndc) : corner(p_ndc[0]), z(corner.z) {
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
      decimals_(decimals),
      decimals_read_(decimals_read.value_or(decimals.value_or(kMostDecimals + 1))) {}

std::size_t LostDigits::Steps::from(double value) const {
  const double index = (value - kMiddle) * per_unit + (static_cast<double>(count) - 1) / 2;
  return static_cast<std::size_t>(std::ceil(std::clamp(index, 0.0, static_cast<double>(count))));
}

/// Decides whether a stage has rounded the first numbers read, so that they have lost digits: then many of
/// them do not end in 0.
void LostDigits::look_for_decimals() {
  half_.written = decimals_ ? 0.5 / power_of_ten(*decimals_) : 0;
  if (decimals_read_ > kMostDecimals || (decimals_read_ < kFewestDecimals && decimals_read_ != decimals_))
    return;
  std::size_t asked_count = 0, count = 0;
  for (std::size_t i = 0; i < kept_.size(); i += kept_.size() / kAskedForDecimals + 1, ++asked_count)
    for (const Vec3& p : kept_[i].p_view)
      for (const double number : {p.x, p.y, p.z}) {
        if (rounded(number, decimals_read_) != number) return;
        if (std::fmod(std::nearbyint(number * power_of_ten(decimals_read_)), 10) != 0) ++count;
      }
  unit_read_ = 1 / power_of_ten(decimals_read_);
  if (count >= asked_count * 9 / 4) half_.read = unit_read_ / 2;
}

void LostDigits::add(const TriangleBatch& p_view, const TriangleBatch& p_ndc) {
  std::size_t whole = 0;
  const auto read = [&](std::size_t index) -> const Triangle& {
    const std::uint64_t number = p_ndc.numbers[index];
    if (index < p_view.size() && p_view.numbers[index] == number) whole = index;
    while (whole + 1 < p_view.size() && p_view.numbers[whole] != number) ++whole;
    return p_view.triangles[whole];
  };
  std::size_t i = 0;
  if (rows_.empty()) {
    if (p_ndc.size() > 1) kept_.reserve(kSmallScene + 1);
    for (; i < p_ndc.size() && kept_.size() <= kSmallScene; ++i)
      kept_.push_back({p_ndc.triangles[i], read(i)});
    if (kept_.size() > kSmallScene) look_at_kept();
  }
  const std::span<const Triangle> triangles = p_ndc.triangles;
  for (; i < triangles.size(); ++i) {
    i += count_between_rows(triangles.subspan(i));
    if (i == triangles.size()) break;
    look_at(triangles[i], read(i), kWorkForLarge + (triangle_count_ + i) / kTrianglesAUnit);
  }
  triangle_count_ += triangles.size();
}

/// The count of first triangles to skip: each lies between two rows.
std::size_t LostDigits::count_between_rows(std::span<const Triangle> p_ndc) const {
  constexpr double kToWhole = 0x1.8p52;  // added and rounded
  const double per_unit = ys_.per_unit, halfway = 0.5 - Steps::kMiddle * per_unit;
  std::size_t i = 0;
  for (const std::size_t size = p_ndc.size(); i < size; ++i) {
    const auto& [a, b, c] = p_ndc[i];
    const auto strip = [&](const Vec3& p) { return p.y * per_unit + halfway + kToWhole; };
    if (strip(a) != strip(b) || strip(a) != strip(c)) break;
  }
  return i;
}

/// Chooses the rows, and looks at the triangles that are kept.
void LostDigits::look_at_kept() {
  look_for_decimals();
  coefficients_ = coefficients_of(projection_);
  for (std::size_t few = kSmallestScene; few < kSmallScene && kept_.size() > few; few *= 2) ys_.thin_out();
  rows_.resize(ys_.count);
  const std::size_t most_work = kept_.size() > kSmallScene ? kWorkForLarge : kMostWork;
  for (const Surface& surface : kept_)
    if (count_between_rows({&surface.p_ndc, 1}) == 0) look_at(surface.p_ndc, surface.p_view, most_work);
  kept_ = {};
}

/// Looks at a triangle. Over the limit of work, drops rows or, at kLeastRows, the triangle (a near one at
/// twice the limit).
void LostDigits::look_at(const Triangle& p_ndc, const Triangle& p_view, std::size_t most_work) {
  constexpr double kMostReach = 1e-3;  // of triangles that lie behind all places but for their reach
  const auto& [a, b, c] = p_ndc;
  const double nearest = std::min({a.z, b.z, c.z});
  work_ += 2;
  if (nearest > 1 || nearest - kMostReach > farthest_) return;
  while (work_ > most_work && ys_.count > kLeastRows) thin_out();
  if (work_ > (most_work + kWorkForRows) * (std::max({a.z, b.z, c.z}) < farthest_ ? 2 : 1)) return;
  Surface surface = {p_ndc, p_view, Plane(p_ndc)};
  surface.reach = depth_error(surface.plane, std::max(nearest, -1.0), half_);  // the nearer, the larger
  work_ += 16;
  if (!std::isfinite(surface.reach)) return;
  std::uint32_t index = kNone;
  const std::size_t end = ys_.from(std::max({a.y, b.y, c.y}));
  for (std::size_t i = ys_.from(std::min({a.y, b.y, c.y})); i < end; ++i)
    if (nearest - surface.reach <= rows_[i].farthest) look_along(rows_[i], ys_.at(i), surface, index);
}

/// Keeps every third row.
void LostDigits::thin_out() {
  for (std::size_t i = 0; 3 * i + 1 < rows_.size(); ++i) rows_[i] = std::move(rows_[3 * i + 1]);
  ys_.thin_out();
  rows_.resize(ys_.count);
  work_ /= 3;
}

void LostDigits::look_along(Row& row, double y, Surface& surface, std::uint32_t& index) {
  double left = 1, right = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = surface.p_ndc[i], &q = surface.p_ndc[(i + 1) % 3];
    if ((p.y < y) == (q.y < y)) continue;
    const double x = p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y));
    left = std::min(left, x);
    right = std::max(right, x);
  }
  const std::size_t begin = columns_.from(left), end = columns_.from(right);
  if (begin >= end) return;
  if (row.places.empty()) row.places.resize(columns_.count);
  work_ += 10 + end - begin;
  const Plane plane = surface.plane;
  for (std::size_t column = begin; column < end; ++column) {
    const double z = plane.at(columns_.at(column), y);
    Place& place = row.places[column];
    if (z >= -1 && z <= 1 && z - surface.reach <= place.z + place.reach) look_at(place, z, surface, index);
  }
  constexpr unsigned kLooks = 16;
  if (++row.look_count % kLooks != 0) return;
  row.farthest = -1;
  for (const Place& place : row.places) row.farthest = std::max(row.farthest, place.z + place.reach);
  farthest_ = std::ranges::max_element(rows_, {}, &Row::farthest)->farthest;
}

/// Compares a triangle that is, or may be, the nearest at a place.
void LostDigits::look_at(Place& place, double z, Surface& surface, std::uint32_t& index) {
  if (index == kNone) {
    index = static_cast<std::uint32_t>(seen_.size());
    undo_rounding(surface);
    seen_.push_back(surface);
  }
  const double gap = std::fabs(z - place.z);
  const bool is_rival = place.nearest != kNone && gap <= surface.reach + place.reach &&
                        !std::ranges::is_permutation(seen_[place.nearest].p_ndc, surface.p_ndc);
  if (!is_rival && !(z < place.z)) return;
  if (is_rival && place.rival != kNone && place.gap < gap && !(z < place.z)) return;
  if (z < place.z)
    place = {z, surface.reach, gap, index, is_rival ? place.nearest : kNone};
  else
    std::tie(place.rival, place.gap) = std::tuple(index, gap);
}

/// Recalculates p_ndc from p_view, as read: p_ndc may be rounded. For a piece, p_view from p_ndc.
void LostDigits::undo_rounding(Surface& surface) const {
  constexpr double kSame = 1e-6;
  const Triangle whole = projected(surface.p_view);
  const auto are_same = [](const Vec3& p, const Vec3& q) {
    return std::fabs(p.x - q.x) + std::fabs(p.z - q.z) < kSame;
  };
  if (std::ranges::equal(whole, surface.p_ndc, are_same)) {
    surface.plane = Plane(surface.p_ndc = whole);
    return;
  }
  surface.p_view = surface.p_ndc;
  for (Vec3& p : surface.p_view) {
    const double w = view_from_clip_.w_of(p);
    p = view_from_clip_({p.x * w, p.y * w, p.z * w}, w);
  }
}

Triangle LostDigits::projected(const Triangle& p_view) const {
  VertexBlock vertices;
  ImageBlock p_ndc;
  vertices.fill({&p_view, 1});
  vertex_kernel().project(coefficients_, {}, vertices, p_ndc);
  return p_ndc.triangle(0);
}

/// A bound on the error, from lost digits, of a plane's depth where it is `z`. Model and view have rounded
/// the numbers read.
double LostDigits::depth_error(const Plane& plane, double z, const HalfUnits& half) const {
  const double near = projection_.near, far = projection_.far;
  const double z_x = std::fabs(plane.z_x), z_y = std::fabs(plane.z_y);
  double by_view = z_x * x_scale_ + z_y * y_scale_ + 2 / (far - near);
  if (projection_.is_perspective) {
    const double d = view_from_clip_.w_of({0, 0, z});
    by_view = (z_x * (x_scale_ + 1) + z_y * (y_scale_ + 1) + 2 * near / (1 - near / far) / d) / d;
  }
  return (half.written + kDoubleError) * (1 + z_x + z_y) + 2 * half.read * by_view;
}

/// The share of the triangle that its edges sweep over, if they all move as at this place. On average, an
/// edge is off by 0.38 half units, or sqrt(2) times that if rounded twice; half of the swept area is the
/// triangle's own loss.
double LostDigits::edge_share(const Place& place) const {
  const auto& [p_ndc, p_view, plane, reach] = seen_[place.nearest];
  double scale = (x_scale_ + y_scale_) / 2, length = 0;
  if (projection_.is_perspective) scale = (scale + 0.5) / view_from_clip_.w_of({0, 0, place.z});
  for (std::size_t i = 0; i < 3; ++i)
    length += std::hypot(p_ndc[i].x - p_ndc[(i + 1) % 3].x, p_ndc[i].y - p_ndc[(i + 1) % 3].y);
  const double off = half_.written + std::numbers::sqrt2 * half_.read * std::fabs(scale);
  return std::min(0.38 * off * length / std::fabs(plane.area), 1.0);
}

/// The triangle with possible numbers, which model and view would round to those read. Equal numbers stay
/// equal.
Triangle LostDigits::possible_truth(const Surface& surface, unsigned trial) const {
  if (half_.read == 0) return surface.p_ndc;
  return projected(with_numbers(surface.p_view, [&](double number) {
    const double read = rounded(number, decimals_read_);
    return number + half_.read * (scattered(read, trial) + scattered(read, ~trial));
  }));
}

/// The share of equally likely cases, which should differ from place to place, in which the two surfaces at a
/// place are printed in the wrong order. Among equal depths, the earlier triangle is seen.
double LostDigits::wrong_share(const Place& place, double x, double y, unsigned first_trial) const {
  const auto [first, second] = std::minmax(place.nearest, place.rival);
  const Surface &a = seen_[first], &b = seen_[second];
  const auto is_second_nearer = [&](const Triangle& p, const Triangle& q) {
    return Plane(q).at(x, y) < Plane(p).at(x, y) - kDoubleError;
  };
  const auto printed = [&](const Surface& surface) {
    if (!decimals_) return surface.p_ndc;
    return with_numbers(surface.p_ndc, [&](double number) { return rounded(number, *decimals_); });
  };
  const bool is_printed_nearer = is_second_nearer(printed(a), printed(b));
  // If numbers are as coarse as pixels, surfaces printed in one plane were probably layers.
  const double w = projection_.is_perspective ? view_from_clip_.w_of({0, 0, place.z}) : 1;
  if (place.gap <= kDoubleError && unit_read_ * y_scale_ / w > 2 / kFewUnits) return 0.5;
  unsigned wrong_count = 0;
  for (unsigned trial = first_trial; trial < first_trial + kTrialCount; ++trial)
    if (is_second_nearer(possible_truth(a, trial), possible_truth(b, trial)) != is_printed_nearer)
      ++wrong_count;
  return static_cast<double>(wrong_count) / kTrialCount;
}

double LostDigits::depth_error(const Close& close, const HalfUnits& half) const {
  return depth_error(close.a.plane, close.z, half) + depth_error(close.b.plane, close.z, half);
}

void LostDigits::add_rival(const Place& place, double x, double y, Losses& losses) const {
  const Surface &a = seen_[place.nearest], &b = seen_[place.rival];
  const Close close = {std::fabs(a.plane.at(x, y) - b.plane.at(x, y)), place.z, a, b};
  if (close.gap > depth_error(close, half_)) return;
  const double share = wrong_share(place, x, y, kTrialCount * static_cast<unsigned>(losses.shown));
  if (share == 0) return;
  losses.wrong += share;
  if (close.gap <= depth_error(close, {half_.read, 0})) losses.in_one_plane += share;
  losses.close.push_back(close);
}

LostDigits::Losses LostDigits::losses() const {
  Losses losses;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    for (std::size_t column = 0; column < row.places.size(); ++column) {
      const Place& place = row.places[column];
      if (place.nearest == kNone) continue;
      ++losses.shown;
      losses.nearest = std::min(losses.nearest, place.z);
      losses.at_edges += edge_share(place);
      if (place.rival != kNone) add_rival(place, columns_.at(column), ys_.at(i), losses);
    }
  }
  return losses;
}

/// True if no pixel should be wrong with this many decimals more.
bool LostDigits::suffice(int more_decimals, const Losses& losses) const {
  const double times = power_of_ten(more_decimals);
  const HalfUnits half = {half_.read / times, half_.written / times};
  return losses.in_one_plane == 0 && losses.at_edges / losses.shown / times < kNoPixel &&
         std::ranges::all_of(losses.close,
                             [&](const Close& close) { return close.gap > depth_error(close, half); });
}

std::optional<LostDigits::Found> LostDigits::found() {
  if (kept_.size() == 1) return std::nullopt;  // one triangle has no rival
  if (rows_.empty()) look_at_kept();
  const Losses lost = losses();
  const double share = (lost.wrong + lost.at_edges) / lost.shown;
  if (!(share >= kLeastShare)) return std::nullopt;
  Found found;
  found.share = share;
  found.is_of_edges = lost.at_edges > lost.wrong;
  found.decimals = decimals_.value_or(decimals_read_);
  found.may_be_one_plane = lost.in_one_plane > share * lost.shown / 2;
  found.near_helps = projection_.is_perspective && !found.is_of_edges && !found.may_be_one_plane &&
                     view_from_clip_.w_of({0, 0, lost.nearest}) > 4 * projection_.near;
  for (int more = 1; found.decimals + more <= kMostDecimals && !found.enough; ++more)
    if (suffice(more, lost)) found.enough = found.decimals + more;
  return found;
}

}  // namespace pipeline
