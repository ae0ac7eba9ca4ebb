#include "libpipeline/vertex/lost_digits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include "libpipeline/numbers/decimal_units.h"

namespace pipeline {
namespace {

// Where it is too much work, every third row or column stays. Scenes of more than kSmallScene triangles have
// so little that it is less than a hundredth of the instructions of `project`. A unit is about ten.
constexpr std::size_t kSmallestScene = 256, kSmallScene = 1024, kLeastRows = 2, kLeastColumns = 27;
constexpr std::size_t kMostWork = 60'000, kWorkForLarge = 500;
constexpr unsigned kTrialCount = 5;
constexpr std::size_t kAskedForDecimals = 8;
constexpr int kMostDecimals = 12;       // more cost as much as all digits
constexpr int kFewestDecimals = 6;      // numbers with fewer were typed, unless those written have as few
constexpr double kFewUnits = 2000;      // over the window's height: a last decimal is half a row
constexpr double kLeastShare = 0.005;   // below it, nothing is found
constexpr double kNoPixel = 5e-7;       // a share
constexpr double kDoubleError = 1e-14;  // of a depth

double power_of_ten(int exponent) {
  return kPowersOfTen[static_cast<std::size_t>(exponent)];
}

double rounded(double value, int decimals) {
  return std::nearbyint(value * power_of_ten(decimals)) / power_of_ten(decimals);
}

/// A number from -1 to 1 that looks random; the same for the same arguments.
double scattered(double value, unsigned trial) {
  std::uint64_t bits = std::bit_cast<std::uint64_t>(value + 0.0) + trial * 0x9e3779b97f4a7c15u;
  for (const int shift : {30, 27, 31}) bits = (bits ^ (bits >> shift)) * 0xbf58476d1ce4e5b9u;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

Triangle with_numbers(Triangle triangle, const auto& change) {
  for (Vec3& p : triangle) p = {change(p.x), change(p.y), change(p.z)};
  return triangle;
}

/// The index of the triangle with this number; often `begin` or the next one, and rarely before them.
std::size_t whole_of(std::span<const std::uint64_t> numbers, std::uint64_t number, std::size_t begin) {
  constexpr std::size_t kNear = 100;
  for (const std::size_t index : {begin, begin + 1})
    if (index < numbers.size() && numbers[index] == number) return index;
  if (begin + kNear >= numbers.size() || numbers[begin + kNear] < number) begin = 0;
  const auto some = begin == 0 ? numbers : numbers.subspan(begin, kNear + 1);
  const auto found = std::ranges::lower_bound(some, number);
  return std::min(begin + static_cast<std::size_t>(found - some.begin()), numbers.size() - 1);
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

LostDigits::Steps::Steps(std::size_t step_count) : count(step_count) {
  constexpr double kOdd = 0.13;  // so that no grid of vertices meets them
  per_unit = (static_cast<double>(count) + kOdd) / 2;
}

std::size_t LostDigits::Steps::from(double value) const {
  const double index = value * per_unit + static_cast<double>(count) / 2 - 0.5;
  return static_cast<std::size_t>(std::ceil(std::clamp(index, 0.0, static_cast<double>(count))));
}

/// Decides whether a stage has rounded the first numbers read, so that they have lost digits: many do not end
/// in 0.
void LostDigits::look_for_decimals() {
  half_.written = decimals_ ? 0.5 / power_of_ten(*decimals_) : 0;
  if (decimals_read_ > kMostDecimals || (decimals_read_ < kFewestDecimals && decimals_read_ != decimals_))
    return;
  std::size_t count = 0;
  for (const Triangle& triangle : first_read_)
    for (const Vec3& p : triangle)
      for (const double number : {p.x, p.y, p.z}) {
        if (rounded(number, decimals_read_) != number) return;
        if (std::fmod(std::nearbyint(number * power_of_ten(decimals_read_)), 10) != 0) ++count;
      }
  unit_read_ = 1 / power_of_ten(decimals_read_);
  if (count >= first_read_.size() * 9 / 4) half_.read = unit_read_ / 2;
}

LostDigits::HalfUnits LostDigits::half_units(int more_decimals) const {
  return {half_.read / power_of_ten(more_decimals),
          decimals_ ? 0.5 / power_of_ten(*decimals_ + more_decimals) : 0};
}

void LostDigits::add(const TriangleBatch& p_view, const TriangleBatch& p_ndc) {
  for (; first_read_.size() < kAskedForDecimals && next_read_ < p_view.size();
       next_read_ += first_read_.size())
    first_read_.push_back(p_view.triangles[next_read_]);
  next_read_ -= std::min(next_read_, p_view.size());
  std::size_t whole = 0;
  const auto read = [&](std::size_t index) -> const Triangle& {
    const std::uint64_t number = p_ndc.numbers[index];
    const bool is_same = index < p_view.size() && p_view.numbers[index] == number;
    whole = is_same ? index : whole_of(p_view.numbers, number, whole);
    return p_view.triangles[whole];
  };
  const std::size_t count_before = triangle_count_;
  triangle_count_ += p_ndc.size();
  std::size_t i = 0;
  if (rows_.empty()) {
    if (p_ndc.size() > 1) kept_.reserve(kSmallScene + 1);
    for (; i < p_ndc.size() && kept_.size() <= kSmallScene; ++i)
      kept_.push_back({p_ndc.triangles[i], read(i)});
    if (kept_.size() <= kSmallScene) return;
    look_at_kept();
  }
  const std::span<const Triangle> triangles = p_ndc.triangles;
  const auto look_at_next = [&] {
    look_at({triangles[i], read(i)});
    thin_out_over(kWorkForLarge + (count_before + i) / 2);
  };
  for (std::size_t due = std::max(i, next_);; ++i) {
    for (; i < std::min(due, triangles.size()) && may_be_in_front(count_before + i); ++i)
      if (is_in_front(triangles[i])) look_at_next();
    i = std::max(i, due);
    if (i < triangles.size()) i += count_between_rows(triangles.subspan(i));
    next_ = i - std::min(i, triangles.size());
    if (i >= triangles.size()) break;
    look_at_next();
    due = i + stride_;
  }
}

/// True while few triangles were looked at because they are in front, however many others are skipped.
bool LostDigits::may_be_in_front(std::size_t triangle_count) const {
  constexpr std::size_t kFew = 6, kToOne = 1024;
  return in_front_count_ < kFew + triangle_count / kToOne;
}

/// True for a triangle on a row that is nearer than some place.
bool LostDigits::is_in_front(const Triangle& p_ndc) {
  const auto& [a, b, c] = p_ndc;
  if (!(std::max({a.z, b.z, c.z}) < farthest_) || count_between_rows({&p_ndc, 1}) > 0) return false;
  ++in_front_count_;
  return true;
}

/// How many triangles to skip, as those that would be looked at lie between two rows.
std::size_t LostDigits::count_between_rows(std::span<const Triangle> p_ndc) const {
  constexpr double kToWhole = 0x1.8p52;  // added and rounded; rows lie halfway between whole numbers
  const double per_unit = ys_.per_unit;
  std::size_t i = 0;
  for (const std::size_t size = p_ndc.size(); i < size; ++i) {
    const auto& [a, b, c] = p_ndc[i];
    const double strip = a.y * per_unit + kToWhole;
    if (strip != b.y * per_unit + kToWhole || strip != c.y * per_unit + kToWhole) break;
  }
  return i;
}

/// Chooses the rows, and looks at the triangles that are kept.
void LostDigits::look_at_kept() {
  look_for_decimals();
  for (std::size_t few = kSmallestScene; few < kSmallScene && kept_.size() > few; few *= 2) ys_.thin_out();
  rows_.resize(ys_.count);
  for (const Seen& triangle : kept_) {
    if (count_between_rows({&triangle.p_ndc, 1}) == 0) look_at({triangle.p_ndc, triangle.p_view});
    thin_out_over(kept_.size() > kSmallScene ? kWorkForLarge : kMostWork);
  }
  kept_ = {};
}

void LostDigits::look_at(Look look) {
  constexpr double kMostReach = 1e-3;  // of all that lie behind the places but for their reach
  const auto& [a, b, c] = look.p_ndc;
  look.nearest = std::min({a.z, b.z, c.z});
  work_ += 2;
  if (look.nearest > 1 || look.nearest - kMostReach > farthest_) return;
  look.plane = Plane(look.p_ndc);
  look.reach = depth_error(look.plane, std::max(look.nearest, -1.0), half_);  // the nearer, the larger
  work_ += 16;
  if (!std::isfinite(look.reach)) return;
  const std::size_t end = ys_.from(std::max({a.y, b.y, c.y}));
  for (std::size_t i = ys_.from(std::min({a.y, b.y, c.y})); i < end; ++i)
    look_along(rows_[i], ys_.at(i), look);
}

/// While there is too much work, keeps every third row or column, or looks at half as many triangles.
void LostDigits::thin_out_over(std::size_t most_work) {
  constexpr std::size_t kMostStride = 16;
  if (work_ <= most_work) return;
  const auto every_third = [](auto& all) {
    for (std::size_t i = 0; 3 * i + 1 < all.size(); ++i) all[i] = std::move(all[3 * i + 1]);
    all.resize(all.size() / 3);
  };
  if (ys_.count > kLeastRows) {
    every_third(rows_);
    ys_.thin_out();
    work_ -= most_work / 2;
  } else if (work_ > kMostWork / 3 + most_work) {
    if (columns_.count > kLeastColumns) {
      for (Row& row : rows_) every_third(row.places);
      columns_.thin_out();
    } else {
      stride_ = std::min(2 * stride_, kMostStride);
    }
    work_ -= kMostWork / 6;
  }
}

void LostDigits::look_along(Row& row, double y, Look& look) {
  if (look.nearest - look.reach > row.farthest) return;
  double left = 1, right = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = look.p_ndc[i], &q = look.p_ndc[(i + 1) % 3];
    if ((p.y < y) == (q.y < y)) continue;
    const double x = p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y));
    left = std::min(left, x);
    right = std::max(right, x);
  }
  const std::size_t begin = columns_.from(left), end = columns_.from(right);
  if (begin >= end) return;
  if (row.places.empty()) row.places.resize(columns_.count);
  work_ += 10 + end - begin;
  for (std::size_t column = begin; column < end; ++column) {
    const double z = look.plane.at(columns_.at(column), y);
    Place& place = row.places[column];
    if (z >= -1 && z <= 1 && z - look.reach <= place.z + place.reach) look_at(place, z, look);
  }
  constexpr unsigned kLooks = 16;
  if (++row.look_count % kLooks != 0) return;
  row.farthest = -1;
  for (const Place& place : row.places) row.farthest = std::max(row.farthest, place.z + place.reach);
  farthest_ = std::ranges::max_element(rows_, {}, &Row::farthest)->farthest;
}

/// The triangle is nearer than all others at this place, or may be.
void LostDigits::look_at(Place& place, double z, Look& look) {
  if (look.seen == kNone) {
    look.seen = static_cast<std::uint32_t>(seen_.size());
    seen_.push_back(unrounded(look));
  }
  const double gap = std::fabs(z - place.z);
  const bool is_rival = place.nearest != kNone && gap <= look.reach + place.reach &&
                        !std::ranges::is_permutation(seen_[place.nearest].p_ndc, seen_[look.seen].p_ndc);
  if (!is_rival && !(z < place.z)) return;
  if (is_rival && place.rival != kNone && place.gap < gap && !(z < place.z)) return;
  if (z < place.z)
    place = {z, look.reach, gap, look.seen, is_rival ? place.nearest : kNone};
  else
    std::tie(place.rival, place.gap) = std::tuple(look.seen, gap);
}

/// The triangle from what was read, where the numbers to be printed may be rounded; a piece as it is.
LostDigits::Seen LostDigits::unrounded(const Look& look) const {
  constexpr double kSame = 1e-6;
  Seen seen = {projected(look.p_view), look.p_view};
  bool is_whole = true;
  for (std::size_t i = 0; i < 3; ++i)
    is_whole &=
        std::fabs(seen.p_ndc[i].x - look.p_ndc[i].x) + std::fabs(seen.p_ndc[i].z - look.p_ndc[i].z) < kSame;
  if (is_whole) return seen;
  seen = {look.p_ndc, look.p_ndc};
  for (Vec3& p : seen.p_view) {
    const double w = view_from_clip_.w_of(p);
    p = view_from_clip_({p.x * w, p.y * w, p.z * w}, w);
  }
  return seen;
}

Triangle LostDigits::projected(const Triangle& p_view) const {
  const auto& [is_perspective, x_scale, x_offset, y_scale, y_offset, near, far, sides] = projection_;
  Triangle p_ndc;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = p_view[i];
    const double d = -p.z, w = is_perspective ? d : 1, q = is_perspective ? p.z : 1;
    p_ndc[i] = {(x_scale.nearest_double() * p.x + x_offset.nearest_double() * q) / w,
                (y_scale.nearest_double() * p.y + y_offset.nearest_double() * q) / w,
                is_perspective ? ((d - near) * far - (far - d) * near) / (d * (far - near))
                               : ((d - near) - (far - d)) / (far - near)};
  }
  return p_ndc;
}

/// At most so far is the depth of a plane from the true one where it is `z`, by the digits that are lost.
/// model and view have rounded what is read.
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

/// How much of the triangle its edges move over. An edge is off by 0.38 half units in the mean, the square
/// root of 2 times that if rounded twice; half of it is the triangle's own loss.
double LostDigits::edge_share(const Triangle& p_ndc) const {
  const auto& [a, b, c] = p_ndc;
  const auto length = [](const Vec3& p, const Vec3& q) {
    return std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y));
  };
  double scale = (x_scale_ + y_scale_) / 2;
  if (projection_.is_perspective) scale = (scale + 0.5) / view_from_clip_.w_of({0, 0, (a.z + b.z + c.z) / 3});
  const double off = half_.written + std::numbers::sqrt2 * half_.read * std::fabs(scale);
  return std::min(0.38 * off * (length(a, b) + length(b, c) + length(c, a)) / std::fabs(Plane(p_ndc).area),
                  1.0);
}

/// The triangle by some numbers before model and view rounded them to those that were read. Equal numbers
/// stay equal.
Triangle LostDigits::possible_truth(const Seen& seen, unsigned trial) const {
  if (half_.read == 0) return seen.p_ndc;
  return projected(with_numbers(seen.p_view, [&](double number) {
    const double read = rounded(number, decimals_read_);
    return number + half_.read * (scattered(read, trial) + scattered(read, trial + kTrialCount));
  }));
}

/// How often the two surfaces at a place are printed in another order than the true one, of equally likely
/// cases. Of equal depths, the earlier triangle is seen.
double LostDigits::wrong_share(const Place& place, double x, double y) const {
  const auto [first, second] = std::minmax(place.nearest, place.rival);
  const Seen &a = seen_[first], &b = seen_[second];
  const auto is_second_nearer = [&](const Triangle& p, const Triangle& q) {
    return Plane(q).at(x, y) < Plane(p).at(x, y) - kDoubleError;
  };
  const auto printed = [&](const Seen& seen) {
    if (!decimals_) return seen.p_ndc;
    return with_numbers(seen.p_ndc, [&](double number) { return rounded(number, *decimals_); });
  };
  const bool is_printed_nearer = is_second_nearer(printed(a), printed(b));
  // Where numbers are as coarse as pixels, surfaces printed in one plane were probably layers.
  const double w = projection_.is_perspective ? view_from_clip_.w_of({0, 0, place.z}) : 1;
  if (place.gap <= kDoubleError && unit_read_ * y_scale_ / w > 2 / kFewUnits) return 0.5;
  unsigned wrong_count = 0;
  for (unsigned trial = 0; trial < kTrialCount; ++trial)
    if (is_second_nearer(possible_truth(a, trial), possible_truth(b, trial)) != is_printed_nearer)
      ++wrong_count;
  return static_cast<double>(wrong_count) / kTrialCount;
}

double LostDigits::depth_error(const Close& close, const HalfUnits& half) const {
  return depth_error(close.a, close.z, half) + depth_error(close.b, close.z, half);
}

void LostDigits::add_rival(const Place& place, double x, double y, Losses& losses) const {
  Close close = {0, place.z, Plane(seen_[place.nearest].p_ndc), Plane(seen_[place.rival].p_ndc)};
  close.gap = std::fabs(close.a.at(x, y) - close.b.at(x, y));
  if (close.gap > depth_error(close, half_)) return;
  const double share = wrong_share(place, x, y);
  if (share == 0) return;
  losses.wrong += share;
  const double by_reading = depth_error(close, {half_.read, 0});
  if (close.gap <= by_reading) losses.in_one_plane += share;
  losses.by_writing += depth_error(close, {0, half_.written}) - by_reading;
  losses.close.push_back(close);
}

LostDigits::Losses LostDigits::losses() const {
  Losses losses;
  std::vector<double> edge_shares(seen_.size(), -1);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    for (std::size_t column = 0; column < row.places.size(); ++column) {
      const Place& place = row.places[column];
      if (place.nearest == kNone) continue;
      ++losses.shown;
      losses.nearest = std::min(losses.nearest, place.z);
      double& edges = edge_shares[place.nearest];
      if (edges < 0) edges = edge_share(seen_[place.nearest].p_ndc);
      losses.at_edges += edges;
      if (place.rival != kNone) add_rival(place, columns_.at(column), ys_.at(i), losses);
    }
  }
  return losses;
}

/// True if no pixel should be wrong with this many decimals more.
bool LostDigits::suffice(int more_decimals, const Losses& losses) const {
  const HalfUnits half = half_units(more_decimals);
  return losses.in_one_plane == 0 &&
         losses.at_edges / losses.shown / power_of_ten(more_decimals) < kNoPixel &&
         std::ranges::all_of(losses.close,
                             [&](const Close& close) { return close.gap > depth_error(close, half); });
}

std::optional<LostDigits::Found> LostDigits::found() {
  if (kept_.size() == 1) return std::nullopt;  // nothing is close to it
  if (rows_.empty()) look_at_kept();
  const Losses lost = losses();
  const double share = (lost.wrong + lost.at_edges) / lost.shown;
  if (!(share >= kLeastShare)) return std::nullopt;
  Found found;
  found.share = share;
  found.is_of_edges = lost.at_edges > lost.wrong;
  found.decimals = decimals_.value_or(decimals_read_);
  found.may_be_one_plane = lost.in_one_plane > share * lost.shown / 2;
  found.near_helps = projection_.is_perspective && lost.by_writing > 0 &&
                     view_from_clip_.w_of({0, 0, lost.nearest}) > 4 * projection_.near;
  for (int more = 1; found.decimals + more <= kMostDecimals && !found.enough; ++more)
    if (suffice(more, lost)) found.enough = found.decimals + more;
  return found;
}

}  // namespace pipeline
