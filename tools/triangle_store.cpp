#include "tools/triangle_store.h"

#include <algorithm>

namespace pipeline {
namespace {

// A few MiB.
constexpr std::size_t kMinCapacity = std::size_t{1} << 14;

}  // namespace

TriangleStore::TriangleStore(const Setup& setup, std::optional<SurfaceShader>& shader, FragmentReport* report)
    : setup_(setup),
      shader_(shader),
      report_(report),
      min_capacity_(std::max(setup.pixel_count, kMinCapacity)),
      capacity_(min_capacity_) {
  if (setup.keeps_text) texts_.emplace();
}

void TriangleStore::color(std::span<const PixelTag> tags, std::span<Color> colors) {
  const auto color_of = [this](PixelTag id) {
    return id == KeptIds::kNoTriangle ? setup_.background : colors_.of(texts_->number(id));
  };
  if (has_ids())
    std::ranges::transform(tags, colors.begin(), color_of);
  else
    std::ranges::transform(tags, colors.begin(), Color::from_rgb);
}

void TriangleStore::write_texts(TextWriter& text, KeptIds& seen) const {
  texts_->complete(seen);
  texts_->write(text, seen);
}

/// Keeps the last triangle, too: the next may be another piece of it.
void TriangleStore::let_go(KeptIds& kept) {
  if (texts_) {
    kept.keep(texts_->begin_of_last());
    texts_->complete(kept);
  }
  kept.keep(static_cast<KeptIds::Id>(kept.size() - 1));
  capacity_ = std::max(2 * kept.renumber(), min_capacity_);
  if (shader_) shader_->keep(kept);
  if (texts_) texts_->keep(kept);
}

}  // namespace pipeline
