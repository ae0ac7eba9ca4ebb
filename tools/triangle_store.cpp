#include "tools/triangle_store.h"

#include <algorithm>

namespace pipeline {
namespace {

// A few MiB.
constexpr std::size_t kMinCapacity = std::size_t{1} << 14;

}  // namespace

TriangleStore::TriangleStore(std::optional<SurfaceShader>& shader, FragmentReport* report,
                             std::size_t pixel_count)
    : shader_(shader),
      report_(report),
      min_capacity_(std::max(pixel_count, kMinCapacity)),
      capacity_(min_capacity_) {}

PixelTag TriangleStore::add(const TriangleBatch& p_ndc, std::size_t index) {
  if (report_ != nullptr) report_->add(p_ndc, index);
  const Color color = colors_.of(p_ndc.numbers[index]);
  return shader_ ? shader_->add(p_ndc, index, color) : color.rgb();
}

/// Keeps the last triangle, too: the next may be another piece of it.
void TriangleStore::let_go(KeptIds& kept) {
  kept.keep(static_cast<KeptIds::Id>(kept.size() - 1));
  capacity_ = std::max(2 * kept.renumber(), min_capacity_);
  shader_->keep(kept);
}

}  // namespace pipeline
