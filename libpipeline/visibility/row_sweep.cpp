#include "libpipeline/visibility/row_sweep.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/coverage/span.h"

namespace pipeline {
namespace {

/// True if the first polygon hides the second; at equal depths, the earlier one does.
template <typename Stored>
bool hides(Stored depth, PolygonId id, Stored other_depth, PolygonId other_id) {
  return is_nearer(depth, other_depth) || (depth == other_depth && id < other_id);
}

}  // namespace

template <typename Depth>
RowSweep<Depth>::RowSweep(const Viewport& screen, PixelTag background)
    : format_(screen),
      front_(screen.front),
      rear_limit_(screen.rear),
      rear_(format_.store(screen.rear)),
      reach_columns_(screen.columns),
      background_(background),
      depths_(static_cast<std::size_t>(screen.columns), screen.rear),
      tags_(static_cast<std::size_t>(screen.columns), background) {}

template <typename Depth>
RowPolygon<Depth> RowSweep<Depth>::polygon(const Span& span, PolygonId id, PixelTag tag) const {
  Polygon polygon = {span.depth, span.first_column, span.last_column, {}, {}, {}, {}, id, tag};
  const SpanDepth& depth = span.depth;
  double left_z = depth(polygon.first_column), right_z = depth(polygon.last_column);
  const auto is_seen = [&](double z) { return is_drawn(z, front_) && is_before_rear(z); };
  if (!is_seen(left_z) || !is_seen(right_z)) {
    // Each rounding in a SpanDepth is monotone, so calculated depths rise or fall along the row, and cross a
    // limit once.
    const bool is_rising = left_z <= right_z;
    const int end = span.last_column + 1;
    const auto first_where = [&](auto&& is_true) {
      return first_column_where(span.first_column, end, is_true);
    };
    if (is_rising) {
      polygon.first_column = first_where([&](int column) { return is_drawn(depth(column), front_); });
      polygon.last_column = first_where([&](int column) { return !is_before_rear(depth(column)); }) - 1;
    } else {
      polygon.first_column = first_where([&](int column) { return is_before_rear(depth(column)); });
      polygon.last_column = first_where([&](int column) { return !is_drawn(depth(column), front_); }) - 1;
    }
    if (polygon.is_empty()) return polygon;
    left_z = depth(polygon.first_column);
    right_z = depth(polygon.last_column);
  }
  polygon.nearest = format_.store(std::min(left_z, right_z));
  polygon.farthest = format_.store(std::max(left_z, right_z));
  // With X = |left_x| + columns |dx|, the five roundings are off by at most 2^-53 (|slope| (5 X + 3 |x0|) +
  // |z0|); without a slope, they are exact.
  const double reach = std::fabs(depth.left_x) + reach_columns_ * std::fabs(depth.dx) + std::fabs(depth.x0);
  polygon.size = std::fabs(depth.z0);
  if (depth.slope != 0) {
    polygon.size += std::fabs(depth.slope) * reach;
    polygon.error = polygon.size * 0x1p-49 + 0x1p-1000;
  }
  return polygon;
}

template <typename Depth>
VisibleRow RowSweep<Depth>::sweep(std::span<const ActiveEdge> edges, std::span<Polygon> polygons) {
  clear_pixels();
  if (edges.empty()) return {depths_, tags_};
  polygons_ = polygons;
  first_painted_ = edges.front().column;
  end_painted_ = edges.back().column;
  visible_ = nullptr;
  for (auto edge = edges.begin(); edge != edges.end();) {
    const int column = edge->column;
    for (; edge != edges.end() && edge->column == column; ++edge) {
      if (edge->is_right)
        leave(polygons_[edge->slot]);
      else
        enter(edge->slot, column);
    }
    if (edge != edges.end()) give(column, edge->column);
  }
  return {depths_, tags_};
}

template <typename Depth>
void RowSweep<Depth>::clear_pixels() {
  std::fill(depths_.begin() + first_painted_, depths_.begin() + end_painted_, rear_limit_);
  std::fill(tags_.begin() + first_painted_, tags_.begin() + end_painted_, background_);
  end_painted_ = first_painted_;
}

template <typename Depth>
void RowSweep<Depth>::enter(std::uint32_t slot, int column) {
  Polygon& polygon = polygons_[slot];
  polygon.index_in_list = static_cast<std::uint32_t>(active_.size());
  active_.push_back({polygon.nearest, slot});
  if (visible_ != nullptr && column < visible_end_) compare_with_visible(polygon, column);
}

template <typename Depth>
void RowSweep<Depth>::leave(Polygon& polygon) {
  active(active_.size() - 1).index_in_list = polygon.index_in_list;
  active_[polygon.index_in_list] = active_.back();
  active_.pop_back();
  polygon.index_in_list = Polygon::kOut;
  if (&polygon == visible_) visible_ = nullptr;
  std::erase(contenders_, &polygon);
}

/// `polygon` begins at `column`. If it is nearer than the visible polygon, it is nearer than all polygons
/// behind it, too.
template <typename Depth>
void RowSweep<Depth>::compare_with_visible(Polygon& polygon, int column) {
  if (visible_->farthest < polygon.nearest) return;
  const int visible_end = end_of_nearer(*visible_, polygon, column, visible_end_);
  if (visible_end > column) {
    visible_end_ = visible_end;
    return;
  }
  const int polygon_end = end_of_nearer(polygon, *visible_, column, visible_end_);
  if (polygon_end == column) {
    contenders_.push_back(&polygon);
  } else if (contenders_.empty()) {
    visible_ = &polygon;
    visible_end_ = std::min(polygon_end, polygon.last_column + 1);
  } else {
    visible_ = nullptr;
  }
}

/// Finds the nearest polygon at `column`, and the column up to which it is surely nearest.
template <typename Depth>
void RowSweep<Depth>::choose_visible(int column) {
  visible_ = nearest_at(column);
  visible_end_ = visible_->last_column + 1;
  contenders_.clear();
  for (const ActivePolygon& other : active_) {
    if (visible_->farthest < other.nearest) continue;
    Polygon& polygon = polygons_[other.slot];
    if (&polygon == visible_) continue;
    const int nearer_end = end_of_nearer(*visible_, polygon, column, visible_end_);
    if (nearer_end > column)
      visible_end_ = nearer_end;
    else
      contenders_.push_back(&polygon);
  }
  // Near a crossing a few pixels are enough; coplanar polygons get longer and longer runs.
  constexpr int kFirstRun = 4, kMaxRun = 1 << 16;
  run_length_ = contenders_.empty() ? kFirstRun : std::min(2 * run_length_, kMaxRun);
  if (!contenders_.empty()) visible_end_ = std::min(visible_end_, column + run_length_);
}

template <typename Depth>
RowPolygon<Depth>* RowSweep<Depth>::nearest_at(int column) {
  Polygon* nearest = nullptr;
  typename Depth::Stored nearest_depth = rear_;
  for (const ActivePolygon& candidate : active_) {
    if (candidate.nearest > nearest_depth) continue;
    Polygon& polygon = polygons_[candidate.slot];
    const auto depth = format_.store(polygon.depth(column));
    if (nearest != nullptr && !hides(depth, polygon.id, nearest_depth, nearest->id)) continue;
    nearest = &polygon;
    nearest_depth = depth;
  }
  return nearest;
}

/// The column in [column, end] up to which, exclusive, `front` is surely nearer than `back` wherever both
/// have pixels; perhaps less than it could be.
template <typename Depth>
int RowSweep<Depth>::end_of_nearer(const Polygon& front, const Polygon& back, int column, int end) const {
  const int last = std::min({end - 1, front.last_column, back.last_column});
  double needed = front.error + back.error;
  // A later polygon must be stored as nearer.
  if (front.id > back.id) needed += format_.separation(std::max(front.size, back.size));
  const auto is_nearer_at = [&](int c) { return back.depth(c) - front.depth(c) >= needed; };
  const double distance = back.depth(column) - front.depth(column);
  if (!(distance >= needed)) return column;
  const double last_distance = back.depth(last) - front.depth(last);
  if (last_distance >= needed) return end;
  // The crossing is at the calculated column or one before it.
  const double part = (distance - needed) / (distance - last_distance);
  const int crossing = column + static_cast<int>(part > 0 ? part * (last - column) : 0);
  if (is_nearer_at(crossing)) return crossing + 1;
  return is_nearer_at(std::max(crossing - 1, column)) ? std::max(crossing, column + 1) : column + 1;
}

/// Assigns the pixels of the interval [column, end) to the polygons visible there.
template <typename Depth>
void RowSweep<Depth>::give(int column, int end) {
  while (column < end) {
    if (active_.empty()) {
      std::fill(depths_.begin() + column, depths_.begin() + end, rear_limit_);
      std::fill(tags_.begin() + column, tags_.begin() + end, background_);
      return;
    }
    if (visible_ == nullptr || column >= visible_end_) choose_visible(column);
    const int visible_end = std::min(end, visible_end_);
    if (contenders_.empty())
      paint(*visible_, column, visible_end);
    else
      paint_pixel_by_pixel(column, visible_end);
    column = visible_end;
  }
}

template <typename Depth>
void RowSweep<Depth>::paint(const Polygon& polygon, int column, int end) {
  const Depth format = format_;
  const SpanDepth depth = polygon.depth;
  double* const depths = depths_.data();
  for (int c = column; c < end; ++c) depths[c] = format.depth(format.store(depth(c)));
  std::fill(tags_.begin() + column, tags_.begin() + end, polygon.tag);
}

template <typename Depth>
void RowSweep<Depth>::paint_pixel_by_pixel(int column, int end) {
  for (int c = column; c < end; ++c) {
    const Polygon* nearest = visible_;
    auto nearest_depth = format_.store(visible_->depth(c));
    for (const Polygon* contender : contenders_) {
      const auto depth = format_.store(contender->depth(c));
      if (!hides(depth, contender->id, nearest_depth, nearest->id)) continue;
      nearest = contender;
      nearest_depth = depth;
    }
    depths_[static_cast<std::size_t>(c)] = format_.depth(nearest_depth);
    tags_[static_cast<std::size_t>(c)] = nearest->tag;
  }
}

#define PIPELINE_INSTANTIATE(Depth) template class RowSweep<Depth>;
PIPELINE_FOR_EACH_DEPTH_FORMAT(PIPELINE_INSTANTIATE)
#undef PIPELINE_INSTANTIATE

}  // namespace pipeline
