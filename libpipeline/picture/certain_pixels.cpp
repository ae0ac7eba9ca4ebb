#include "libpipeline/picture/certain_pixels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/stream/memory.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/picture/certain_pixels.cpp"
#include "libpipeline/numbers/vector_lanes.h"

PIPELINE_BEGIN_KERNELS();

constexpr int kColumns = static_cast<int>(kLanes);
static_assert(kColumns <= PixelBounds::kPadding + 1);

/// For as many rows as a vector has lanes, the columns that a triangle may cover, and those that it surely
/// covers, counted from the first of its outline.
struct Columns {
  HWY_INLINE Columns(const TrueOutline& outline, int row) {
    /// Of a column, more than the divisions for it can lose on a screen.
    constexpr double kMargin = 1e-6;
    const double count = outline.columns.end - outline.columns.first;
    std::array<Doubles, 2> low = {all(-0.5), all(-0.5)}, high = {all(count - 0.5), all(count - 0.5)};
    for (const Side& side : outline.sides) {
      const auto value = all(side.v) * hn::Iota(kDoubles, row) + all(side.constant);
      const auto crossing = value * all(side.columns_per_value);
      for (std::size_t i = 0; i < 2; ++i) {
        low[i] = hn::Max(low[i], crossing + all(side.low[i]));
        high[i] = hn::Min(high[i], crossing + all(side.high[i]));
      }
    }
    const std::array margins = {-kMargin, kMargin};
    for (std::size_t i = 0; i < 2; ++i) {
      // Conversions round down.
      hn::StoreU(hn::DemoteTo(kWhole, hn::Min(low[i], all(count)) + all(1 + margins[i])), kWhole,
                 first[i].data());
      hn::StoreU(hn::DemoteTo(kWhole, hn::Max(high[i], all(-1)) + all(1 - margins[i])), kWhole,
                 end[i].data());
    }
  }
  static constexpr hn::Rebind<std::int32_t, decltype(kDoubles)> kWhole{};

  std::array<std::array<std::int32_t, kLanes>, 2> first, end;  // of the possible, of the sure ones
};

/// A triangle that is added.
class AddedOutline {
 public:
  HWY_INLINE AddedOutline(const TrueOutline& outline, std::uint64_t number, PixelBounds& bounds)
      : outline_(outline),
        bounds_(bounds),
        number_(std::bit_cast<double>(number)),
        is_near_limits_(outline.least <= bounds.front[1] || outline.greatest >= bounds.rear[0]) {}

  HWY_INLINE void add_row(int row, const RowRange& possible, const RowRange& sure) {
    if (possible.first >= possible.end) return;
    constexpr int kBlock = PixelBounds::kBlockColumns;
    const int first = outline_.columns.first, in_outline = row - outline_.rows.first;
    pixels_ = &bounds_.pixels[bounds_.index_of(row, first)];
    nearest_at_0_ = outline_.nearest.v * in_outline + outline_.nearest.constant;
    farthest_at_0_ = outline_.farthest.v * in_outline + outline_.farthest.constant;
    double* const farthest =
        &bounds_.farthest[static_cast<std::size_t>((row - bounds_.first_row) * bounds_.block_count)];
    const int nearest_in_block = outline_.nearest.u < 0 ? kBlock - 1 : 0;  // beyond the outline, too
    const int farthest_in_block = outline_.farthest.u < 0 ? 0 : kBlock - 1;
    const int end_block = (first + possible.end - 1) / kBlock + 1;
    for (int block = (first + possible.first) / kBlock; block < end_block; ++block) {
      const int begin = block * kBlock - first, end = std::min(begin + kBlock, bounds_.columns - first);
      if (nearest(begin + nearest_in_block) > farthest[block]) continue;  // hidden
      add_pixels({std::max(possible.first, begin), std::min(possible.end, end)}, sure);
      if (is_near_limits_ || sure.first > begin || sure.end < end) continue;
      farthest[block] = std::min(farthest[block], this->farthest(begin + farthest_in_block));
    }
  }

 private:
  [[nodiscard]] double nearest(int column) const {
    return std::max(nearest_at_0_ + outline_.nearest.u * column, outline_.least);
  }
  [[nodiscard]] double farthest(int column) const {
    return std::min(farthest_at_0_ + outline_.farthest.u * column, outline_.greatest);
  }

  HWY_INLINE void add_pixels(const RowRange& possible, const RowRange& sure) const {
    double* const at_sure = pixels_;
    double *const at_number = at_sure + bounds_.stride, *const at_possible = at_number + bounds_.stride;
    double* const at_second = at_possible + bounds_.stride;
    for (int i = possible.first; i < possible.end; i += kColumns) {
      const auto columns = hn::Iota(kDoubles, i);
      auto nearest = hn::Max(all(nearest_at_0_) + all(outline_.nearest.u) * columns, all(outline_.least));
      const auto farthest =
          hn::Min(all(farthest_at_0_) + all(outline_.farthest.u) * columns, all(outline_.greatest));
      auto is_possible = hn::Lt(columns, all(possible.end));
      auto is_sure =
          hn::And(is_possible, hn::And(hn::Ge(columns, all(sure.first)), hn::Lt(columns, all(sure.end))));
      if (is_near_limits_) {
        const std::array front = bounds_.front, rear = bounds_.rear;
        is_sure = hn::And(is_sure, hn::And(hn::Gt(nearest, all(front[1])), hn::Lt(farthest, all(rear[0]))));
        is_possible =
            hn::And(is_possible, hn::And(hn::Ge(farthest, all(front[0])), hn::Le(nearest, all(rear[1]))));
        nearest = hn::Max(nearest, all(front[0]));
      }
      nearest = hn::IfThenElse(is_possible, nearest, all(PixelBounds::kFar));
      const auto before = hn::LoadU(kDoubles, at_possible + i), second = hn::LoadU(kDoubles, at_second + i);
      hn::StoreU(hn::Min(before, nearest), kDoubles, at_possible + i);
      hn::StoreU(hn::Min(second, hn::Max(before, nearest)), kDoubles, at_second + i);
      if (i >= sure.end || i + kColumns <= sure.first) continue;
      const auto sure_before = hn::LoadU(kDoubles, at_sure + i), number = hn::LoadU(kDoubles, at_number + i);
      is_sure = hn::And(is_sure, hn::Lt(farthest, sure_before));
      hn::StoreU(hn::IfThenElse(is_sure, farthest, sure_before), kDoubles, at_sure + i);
      hn::StoreU(hn::IfThenElse(is_sure, all(number_), number), kDoubles, at_number + i);
    }
  }

  const TrueOutline& outline_;
  PixelBounds& bounds_;
  const double number_;  // its bits
  const bool is_near_limits_;
  // Of the row:
  double* pixels_ = nullptr;
  double nearest_at_0_ = 0, farthest_at_0_ = 0;
};

void add_outline(const TrueOutline& outline, std::uint64_t number, PixelBounds& bounds) {
  AddedOutline added(outline, number, bounds);
  for (int row = outline.rows.first; row < outline.rows.end; row += kColumns) {
    const auto& [first, end] = Columns(outline, row - outline.rows.first);
    const int count = std::min(outline.rows.end - row, kColumns);
    for (int i = 0; i < count; ++i)
      added.add_row(row + i, {first[0][i], end[0][i]}, {first[1][i], end[1][i]});
  }
}

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {
namespace {

using AddOutline = void (*)(const TrueOutline& outline, std::uint64_t number, PixelBounds& bounds);
constexpr KernelTable<AddOutline> kAddOutline = PIPELINE_KERNEL_TABLE(add_outline);

/// A triangle whose box has at most so many pixels is looked up there before its sides are calculated.
constexpr int kFewPixels = 64;

}  // namespace

CertainPixels::CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : outlines_(screen, bounds, projected),
      bounds_{.columns = screen.columns,
              .first_row = screen.drawn_rows().first,
              .stride = screen.columns + PixelBounds::kPadding,
              .block_count = (screen.columns + PixelBounds::kBlockColumns - 1) / PixelBounds::kBlockColumns,
              .front = outlines_.depths_at(screen.front),
              .rear = outlines_.depths_at(screen.rear)} {
  bounds_.front[1] = std::max(bounds_.front[1], outlines_.near_depth());  // what is nearer may be cut
  const std::size_t count = bounds_.index_of(screen.drawn_rows().end, 0);
  expect_available_memory(count * sizeof(double));
  bounds_.pixels.resize(count, PixelBounds::kFar);
  bounds_.farthest.resize(static_cast<std::size_t>(bounds_.block_count * screen.drawn_row_count()),
                          PixelBounds::kFar);
}

void CertainPixels::add(const TriangleBatch& p_ndc) {
  static const AddOutline add_outline = chosen_kernel(kAddOutline);
  TrueOutline outline;
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    if (!p_ndc.unclipped.empty()) {
      if (p_ndc.unclipped[i] && p_ndc.unclipped[i] == last_whole_) continue;
      last_whole_ = p_ndc.unclipped[i];
    }
    outlines_.set_box(outline, p_ndc, i);
    if (outline.is_empty() || is_hidden(outline)) continue;
    outlines_.set_sides(outline);
    add_outline(outline, p_ndc.numbers[i], bounds_);
  }
}

bool CertainPixels::is_hidden(const TrueOutline& outline) const {
  const int first = outline.columns.first, end = outline.columns.end;
  if (std::int64_t{end - first} * (outline.rows.end - outline.rows.first) > kFewPixels) return false;
  for (int row = outline.rows.first; row < outline.rows.end; ++row) {
    const double* const sure = &bounds_.pixels[bounds_.index_of(row, 0)];
    for (int column = first; column < end; ++column)
      if (!(sure[column] < outline.least)) return false;
  }
  return true;
}

}  // namespace pipeline

#endif
