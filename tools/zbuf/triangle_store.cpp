#include "tools/zbuf/triangle_store.h"

#include <algorithm>

namespace pipeline {
namespace {

// A few MiB.
constexpr std::size_t kMinCapacity = std::size_t{1} << 14;
// Corners are many bytes, and new memory costs more than two passes over the pixels; texts are fewer bytes,
// as few triangles win a pixel when they are drawn, and they have to be moved.
constexpr std::size_t kPixelsPerSurface = 4;
constexpr std::size_t kPixelsPerText = 1;
// Triangles that win no pixel have ids, but their texts are not kept. Looking for those that are seen takes
// four bytes for each id.
constexpr std::size_t kIdsPerTriangle = 4;

}  // namespace

TriangleStore::TriangleStore(const Setup& setup, std::optional<SurfaceShader>& shader, FragmentReport* report)
    : setup_(setup),
      shader_(shader),
      report_(report),
      min_capacity_(std::max(setup.pixel_count / (setup.keeps_text ? kPixelsPerText : kPixelsPerSurface),
                             kMinCapacity)),
      capacity_(min_capacity_),
      max_id_count_(kIdsPerTriangle * min_capacity_) {
  if (setup.keeps_text) texts_.emplace();
  tags_are_colors_ = report_ == nullptr && !has_ids();
}

void TriangleStore::color(std::span<const PixelTag> tags, std::span<Color> colors) {
  if (!has_ids()) {
    std::ranges::transform(tags, colors.begin(), Color::from_rgb);
    return;
  }
  PixelTag last = KeptIds::kNoTriangle;
  Color color = setup_.background;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (tags[i] != last) {
      last = tags[i];
      color = last == KeptIds::kNoTriangle ? setup_.background : colors_.of(number(last));
    }
    colors[i] = color;
  }
}

std::span<const std::int64_t> TriangleStore::numbers_of(std::span<const PixelTag> tags,
                                                        std::vector<std::int64_t>& numbers) const {
  numbers.resize(tags.size());
  std::ranges::transform(tags, numbers.begin(), [this](PixelTag id) { return shown_number(id); });
  return numbers;
}

/// Pieces of a triangle stay together, and the last triangle may be the first piece of one.
void TriangleStore::add_texts(const TriangleBatch& p_ndc, KeptIds::Id first_id,
                              std::span<const std::uint8_t> winners, std::span<const std::uint8_t> needed) {
  const std::vector<std::uint64_t>& numbers = p_ndc.numbers;
  const std::size_t last = p_ndc.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const bool is_needed = !needed.empty() && needed[i] != 0;
    const bool is_piece =
        i == last || numbers[i + 1] == numbers[i] || numbers[i] == (i == 0 ? last_number_ : numbers[i - 1]);
    if (winners.empty() || winners[i] != 0 || is_needed || is_piece)
      texts_->add({numbers[i], first_id + static_cast<KeptIds::Id>(i), is_needed}, p_ndc.texts[i]);
  }
  last_number_ = numbers[last];
}

void TriangleStore::write_seen(TextWriter& text, const StageReader& reader, KeptIds& seen) const {
  text.append(reader.header_text());
  texts_->complete(seen, false);
  texts_->write(text, seen);
  if (reader.header().framed) text.append("end\n");
}

/// Keeps the last triangle, too: the next may be another piece of it.
void TriangleStore::let_go(KeptIds& kept) {
  if (texts_) texts_->complete(kept, true);
  if (shader_) kept.keep(static_cast<KeptIds::Id>(kept.size() - 1));
  const std::size_t count = kept.renumber();
  capacity_ = std::max(2 * count, min_capacity_);
  max_id_count_ = count + kIdsPerTriangle * min_capacity_;
  next_id_ = static_cast<KeptIds::Id>(count);
  if (shader_) shader_->keep(kept);
  if (texts_) texts_->keep(kept);
  if (keeps_numbers()) numbers_.keep(kept);
  if (keeps_corners()) corners_.keep(kept);
}

}  // namespace pipeline
