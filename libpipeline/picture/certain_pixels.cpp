#include "libpipeline/picture/certain_pixels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/stream/memory.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/picture/certain_pixels.cpp"
#include "libpipeline/picture/true_outline_lanes.h"

PIPELINE_BEGIN_KERNELS();

constexpr int kColumns = static_cast<int>(kLanes);
static_assert(kColumns <= PixelBounds::kPadding + 1);

/// For as many rows as a vector has lanes, the columns that a triangle may cover, and those that it surely
/// covers, counted from the first of its outline.
struct Columns {
  HWY_INLINE Columns(const TrueOutline<double>& outline, int row) {
    /// Of a column, more than the divisions for it can lose on a screen.
    constexpr double kMargin = 1e-6;
    const double count = outline.end_column - outline.first_column;
    std::array<Doubles, 2> low = {all(-0.5), all(-0.5)}, high = {all(count - 0.5), all(count - 0.5)};
    for (const Side<double>& side : outline.sides) {
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
  HWY_INLINE AddedOutline(const TrueOutline<double>& outline, std::uint64_t number, PixelBounds& bounds)
      : outline_(outline),
        bounds_(bounds),
        first_row_(static_cast<int>(outline.first_row)),
        is_near_limits_(outline.least <= bounds.front[1] || outline.greatest >= bounds.rear[0]),
        depths_{number,
                static_cast<int>(outline.first_column),
                0,
                outline.nearest.u,
                0,
                outline.farthest.u,
                outline.least,
                outline.greatest} {}

  HWY_INLINE void add() {
    const int end_row = std::min(static_cast<int>(outline_.end_row), bounds_.end_row);
    for (int row = std::max(first_row_, bounds_.first_row); row < end_row; row += kColumns) {
      const auto& [first, end] = Columns(outline_, row - first_row_);
      for (int i = 0; i < std::min(end_row - row, kColumns); ++i)
        add_row(row + i, {first[0][i], end[0][i]}, {first[1][i], end[1][i]});
    }
  }

 private:
  HWY_INLINE void add_row(int row, const RowRange& possible, const RowRange& sure) {
    if (possible.first >= possible.end) return;
    constexpr int kBlock = PixelBounds::kBlockColumns;
    const int first = depths_.first_column, in_outline = row - first_row_;
    depths_.nearest_at_0 = outline_.nearest.v * in_outline + outline_.nearest.constant;
    depths_.farthest_at_0 = outline_.farthest.v * in_outline + outline_.farthest.constant;
    const int nearest_in_block = outline_.nearest.u < 0 ? kBlock - 1 : 0;  // beyond the outline, too
    const int farthest_in_block = outline_.farthest.u < 0 ? 0 : kBlock - 1;
    int column = (first + possible.first) / kBlock * kBlock;
    PixelBounds::Block* blocks = &bounds_.blocks[bounds_.block_of(row, column)];
    for (; column < first + possible.end; column += kBlock) {
      PixelBounds::Block& block = *blocks++;
      const int begin = column - first, end = std::min(begin + kBlock, bounds_.columns - first);
      if (depths_.nearest(begin + nearest_in_block) > block.farthest) continue;  // hidden
      const bool is_whole = !is_near_limits_ && sure.first <= begin && sure.end >= end;
      if (is_whole) block.farthest = std::min(block.farthest, depths_.farthest(begin + farthest_in_block));
      if (is_whole && block.is_free) {
        block.alone = depths_;
      } else {
        if (block.alone) {
          const int to_its = first - block.alone->first_column;
          add_pixels(*block.alone, row, {begin + to_its, end + to_its}, {begin + to_its, end + to_its},
                     false);
          block.alone.reset();
        }
        const RowRange columns = {std::max(possible.first, begin), std::min(possible.end, end)};
        add_pixels(depths_, row, columns, sure, is_near_limits_);
      }
      block.is_free = false;
    }
  }

  void add_pixels(const RowDepths& of, int row, const RowRange& possible, const RowRange& sure,
                  bool is_near_limits) const {
    double* const at_sure = &bounds_.pixels[bounds_.index_of(row, of.first_column)];
    double *const at_number = at_sure + bounds_.stride, *const at_possible = at_number + bounds_.stride;
    double* const at_second = at_possible + bounds_.stride;
    for (int i = possible.first; i < possible.end; i += kColumns) {
      const auto columns = hn::Iota(kDoubles, i);
      auto nearest = hn::Max(all(of.nearest_at_0) + all(of.nearest_per_column) * columns, all(of.least));
      const auto farthest =
          hn::Min(all(of.farthest_at_0) + all(of.farthest_per_column) * columns, all(of.greatest));
      auto is_possible = hn::Lt(columns, all(possible.end));
      auto is_sure =
          hn::And(is_possible, hn::And(hn::Ge(columns, all(sure.first)), hn::Lt(columns, all(sure.end))));
      if (is_near_limits) {
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
      hn::StoreU(hn::IfThenElse(is_sure, all(std::bit_cast<double>(of.number)), number), kDoubles,
                 at_number + i);
    }
  }

  const TrueOutline<double> outline_;
  PixelBounds& bounds_;
  const int first_row_;
  const bool is_near_limits_;
  RowDepths depths_;  // of the row
};

/// Whether triangles surely cover every pixel of a small box, and are nearer.
bool is_hidden(const RowRange& columns, const RowRange& rows, double nearest, const PixelBounds& bounds) {
  /// A triangle whose box has at most so many pixels is looked up there before its sides are calculated.
  constexpr int kFewPixels = 64;
  if (std::int64_t{columns.end - columns.first} * (rows.end - rows.first) > kFewPixels) return false;
  for (int row = rows.first; row < rows.end; ++row) {
    const double* const sure = &bounds.pixels[bounds.index_of(row, 0)];
    for (int column = columns.first; column < columns.end; ++column)
      if (!(sure[column] < nearest) && !(bounds.blocks[bounds.block_of(row, column)].farthest < nearest))
        return false;
  }
  return true;
}

/// Adds the triangles of these indices.
void add_triangles(const TrueView& view, const TriangleBatch& p_ndc, std::span<const std::size_t> indices,
                   PixelBounds& bounds) {
  for (; !indices.empty(); indices = indices.subspan(std::min(kLanes, indices.size()))) {
    const UncertainVertices vertices(view, p_ndc, indices);
    TrueOutline<Doubles> outlines;
    set_box(view, vertices, outlines);
    unsigned open = 0;  // a bit for each triangle with a box that is not hidden
    for (std::size_t lane = 0; lane < std::min(kLanes, indices.size()); ++lane) {
      const auto whole = [&](Doubles number)
                             HWY_ATTR { return static_cast<int>(hn::ExtractLane(number, lane)); };
      const RowRange columns = {whole(outlines.first_column), whole(outlines.end_column)};
      const RowRange rows = {std::max(whole(outlines.first_row), bounds.first_row),
                             std::min(whole(outlines.end_row), bounds.end_row)};
      const bool is_empty = columns.first >= columns.end || rows.first >= rows.end;
      if (!is_empty && !is_hidden(columns, rows, hn::ExtractLane(outlines.least, lane), bounds))
        open |= 1u << lane;
    }
    if (open == 0) continue;
    set_sides(view, vertices, outlines);
    for (; open != 0; open &= open - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(open));
      AddedOutline(in_lane(outlines, lane), p_ndc.numbers[indices[lane]], bounds).add();
    }
  }
}

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {
namespace {

using AddTriangles = void (*)(const TrueView& view, const TriangleBatch& p_ndc,
                              std::span<const std::size_t> indices, PixelBounds& bounds);
constexpr KernelTable<AddTriangles> kAddTriangles = PIPELINE_KERNEL_TABLE(add_triangles);

}  // namespace

CertainPixels::CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : view_(screen, bounds, projected),
      bounds_{.columns = screen.columns,
              .first_row = screen.drawn_rows().first,
              .end_row = screen.drawn_rows().end,
              .stride = screen.columns + PixelBounds::kPadding,
              .block_count = (screen.columns + PixelBounds::kBlockColumns - 1) / PixelBounds::kBlockColumns,
              .front = view_.depths_at(screen.front),
              .rear = view_.depths_at(screen.rear)} {
  bounds_.front[1] = std::max(bounds_.front[1], view_.near_depth());  // what is nearer may be cut
  const std::size_t count = bounds_.index_of(screen.drawn_rows().end, 0);
  expect_available_memory(count * sizeof(double));
  bounds_.pixels.resize(count, PixelBounds::kFar);
  bounds_.blocks.resize(static_cast<std::size_t>(bounds_.block_count * screen.drawn_row_count()));
}

void CertainPixels::add(const TriangleBatch& p_ndc) {
  static const AddTriangles add_triangles = chosen_kernel(kAddTriangles);
  indices_.clear();
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    if (!p_ndc.unclipped.empty()) {
      if (p_ndc.unclipped[i] && p_ndc.unclipped[i] == last_whole_) continue;
      last_whole_ = p_ndc.unclipped[i];
    }
    indices_.push_back(i);
  }
  add_triangles(view_, p_ndc, indices_, bounds_);
}

}  // namespace pipeline

#endif
