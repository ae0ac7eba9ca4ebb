#include "libpipeline/visibility/span_fill.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/visibility/span_fill.cpp"
#include "libpipeline/numbers/lanes.h"

PIPELINE_BEGIN_KERNELS();

constexpr hn::Rebind<PixelTag, decltype(kDoubles)> kTags;
template <typename Depth>
using StoredDepths = hn::Rebind<typename Depth::Stored, decltype(kDoubles)>;

constexpr int kStep = static_cast<int>(kLanes);
static_assert(kBlockColumns % kStep == 0 &&
              kStep <= static_cast<int>(HierarchicalDepth<DepthF64>::kPadding) + 1);

// The functions `store` of the depth formats, on vectors; scalar code does not use them.

template <typename Vector>
HWY_INLINE Vector store(const DepthF64&, Vector z) {
  return z;
}
template <typename Vector>
HWY_INLINE auto store(const DepthF32&, Vector z) {
  return hn::DemoteTo(StoredDepths<DepthF32>(), z);
}
template <typename Vector>
HWY_INLINE auto store(const DepthU24& format, Vector z) {
  const auto steps = (z - all(format.front)) * all(format.steps_per_depth) + all(0.5);
  const auto in_range = hn::Min(hn::Max(steps, hn::Zero(kDoubles)), all(DepthU24::kSteps));
  return hn::DemoteTo(StoredDepths<DepthU24>(), in_range);
}

/// The depth rule (depth_format.h) for some pixels at a time.
template <typename Vector>
HWY_INLINE auto are_nearer(Vector stored, Vector of_pixels) {
  return hn::Lt(stored, of_pixels);
}

/// A mask of depths, converted to one of their tags.
template <typename StoredTag, typename StoredMask>
HWY_INLINE hn::Mask<decltype(kTags)> mask_of_tags(StoredTag depths, StoredMask mask) {
  if constexpr (sizeof(hn::TFromD<StoredTag>) == sizeof(PixelTag)) {
    return hn::RebindMask(kTags, mask);
  } else {
    const hn::Rebind<std::uint64_t, StoredTag> wide;
    return hn::MaskFromVec(hn::TruncateTo(kTags, hn::BitCast(wide, hn::VecFromMask(depths, mask))));
  }
}

/// A span being drawn.
template <typename Depth>
class SpanLanes {
 public:
  HWY_INLINE explicit SpanLanes(const SpanFill<Depth>& pixels)
      : pixels_(pixels),
        format_(pixels.format),
        depth_(pixels.span.depth),
        is_rising_(depth_(pixels.span.first_column) <= depth_(pixels.span.last_column)) {}

  /// Draws the pixels from the column `first` to before `end`; true if any is visible.
  HWY_INLINE bool fill_columns(int first, int end) const {
    auto* depths = pixels_.depths + first;
    auto* tags = pixels_.tags + first;
    auto columns = hn::Iota(kDoubles, first);
    const auto tag = hn::Set(kTags, pixels_.tag);
    bool is_any_seen = false;
    for (; end - first >= kStep; first += kStep, depths += kStep, tags += kStep) {
      const auto stored = stored_at(columns), there = hn::LoadU(kStored, depths);
      columns = columns + all(kStep);
      const auto is_seen = are_nearer(stored, there);
      if (hn::AllFalse(kStored, is_seen)) continue;
      hn::StoreU(hn::IfThenElse(is_seen, stored, there), kStored, depths);
      hn::StoreU(hn::IfThenElse(mask_of_tags(kStored, is_seen), tag, hn::LoadU(kTags, tags)), kTags, tags);
      is_any_seen = true;
    }
    if (HWY_MEM_OPS_MIGHT_FAULT) {
      for (; first < end; ++first, ++depths, ++tags) is_any_seen |= draw_pixel(first, depths, tags);
    } else if (first < end) {
      const auto is_in_span = hn::FirstN(kStored, static_cast<std::size_t>(end - first));
      const auto stored = stored_at(columns), there = hn::MaskedLoad(is_in_span, kStored, depths);
      const auto is_seen = hn::And(is_in_span, are_nearer(stored, there));
      hn::BlendedStore(stored, is_seen, kStored, depths);
      hn::BlendedStore(tag, mask_of_tags(kStored, is_seen), kTags, tags);
      is_any_seen |= !hn::AllFalse(kStored, is_seen);
    }
    return is_any_seen;
  }

  /// Draws the span without its hidden blocks.
  HWY_INLINE void fill_blocks() const {
    const SpanBlocks blocks(pixels_);
    const auto first_column = all(pixels_.span.first_column);
    const auto last_column = all(pixels_.span.last_column);
    for (int block = blocks.first; block <= blocks.last; block += kStep) {
      // The columns where the span is nearest in each of some blocks.
      const auto columns =
          hn::Iota(kDoubles, block) * all(kBlockColumns) + all(is_rising_ ? 0 : kBlockColumns - 1);
      const auto nearest = stored_at(hn::Min(hn::Max(columns, first_column), last_column));
      const auto is_near = are_nearer(nearest, hn::LoadU(kStored, pixels_.farthest + block));
      const int count = std::min(blocks.last - block + 1, kStep);
      unsigned open = bits_of(kStored, is_near) & ((1u << count) - 1);
      while (open != 0) {
        const int begin = std::countr_zero(open), end = begin + std::countr_one(open >> begin);
        fill_run(blocks, block + begin, block + end);
        open &= ~0u << end;
      }
    }
  }

 private:
  using Stored = typename Depth::Stored;
  static constexpr StoredDepths<Depth> kStored{};

  /// The depths at some columns, as stored: SpanDepth's roundings in the same order.
  HWY_INLINE auto stored_at(Doubles columns) const {
    const auto x = (all(depth_.left_x) + columns * all(depth_.dx)) - all(depth_.x0);
    const auto z = all(depth_.z0) + x * all(depth_.slope);
    // Highway's scalar conversion has no infinite floats.
    if constexpr (kStep == 1)
      return hn::Set(kStored, format_.store(hn::GetLane(z)));
    else
      return store(format_, z);
  }

  HWY_INLINE bool draw_pixel(int column, Stored* depth, PixelTag* tag) const {
    const Stored stored = format_.store(depth_(column));
    if (!is_nearer(stored, *depth)) return false;
    *depth = stored;
    *tag = pixels_.tag;
    return true;
  }

  /// Draws into the blocks from `begin` to before `end`.
  HWY_INLINE void fill_run(const SpanBlocks& blocks, int begin, int end) const {
    const bool is_any_seen = fill_columns(std::max(begin * kBlockColumns, pixels_.span.first_column),
                                          std::min(end * kBlockColumns, pixels_.span.last_column + 1));
    if (!is_any_seen) {
      for (int block = begin; block < end; ++block) pixels_.farthest[block] = farthest_of(block);
      return;
    }
    const int end_whole = std::min(end, blocks.last_whole + 1);
    for (int block = std::max(begin, blocks.first_whole); block < end_whole; ++block) {
      const int column = block * kBlockColumns + (is_rising_ ? kBlockColumns - 1 : 0);
      const double z = depth_(std::min(column, pixels_.span.last_column));
      pixels_.farthest[block] = std::min(pixels_.farthest[block], format_.store(z));
    }
  }

  HWY_INLINE Stored farthest_of(int block) const {
    const int begin = block * kBlockColumns, count = std::min(kBlockColumns, pixels_.columns - begin);
    const Stored* const depths = pixels_.depths + begin;
    if (count < kBlockColumns) return *std::max_element(depths, depths + count);
    auto farthest = hn::LoadU(kStored, depths);
    for (int i = kStep; i < kBlockColumns; i += kStep)
      farthest = hn::Max(farthest, hn::LoadU(kStored, depths + i));
    return hn::GetLane(hn::MaxOfLanes(kStored, farthest));
  }

  const SpanFill<Depth>& pixels_;
  const Depth format_;
  const SpanDepth depth_;
  const bool is_rising_;
};

template <typename Depth>
void fill_span(const SpanFill<Depth>& pixels) {
  const SpanLanes<Depth> lanes(pixels);
  if (pixels.farthest == nullptr)
    lanes.fill_columns(pixels.span.first_column, pixels.span.last_column + 1);
  else
    lanes.fill_blocks();
}

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {

template <typename Depth>
const KernelTable<FillSpan<Depth>>& span_fill_kernels() {
  static constexpr KernelTable<FillSpan<Depth>> kKernels = PIPELINE_KERNEL_TABLE(fill_span<Depth>);
  return kKernels;
}

// NOLINTNEXTLINE(bugprone-macro-parentheses): Depth is a type
#define PIPELINE_INSTANTIATE(Depth) template const KernelTable<FillSpan<Depth>>& span_fill_kernels<Depth>();
PIPELINE_FOR_EACH_DEPTH_FORMAT(PIPELINE_INSTANTIATE)
#undef PIPELINE_INSTANTIATE

}  // namespace pipeline

#endif
