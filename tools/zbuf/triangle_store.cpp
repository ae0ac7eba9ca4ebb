#include "tools/zbuf/triangle_store.h"

#include <algorithm>
#include <cstring>
#include <variant>

namespace pipeline {
namespace {

// Corresponds to a few MiB.
constexpr std::size_t kMinCapacity = std::size_t{1} << 14;
// Corners and texts are large, and new memory costs more than two passes over the pixels.
constexpr std::size_t kPixelsPerTriangle = 4;

}  // namespace

TriangleStore::TriangleStore(Setup setup, std::optional<SurfaceShader>& shader)
    : setup_(std::move(setup)),
      shader_(shader),
      min_capacity_(std::max(setup_.pixel_count / kPixelsPerTriangle, kMinCapacity)),
      capacity_(min_capacity_) {}

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
      color = last == KeptIds::kNoTriangle ? setup_.background : colors_.of(numbers_[last]);
    }
    colors[i] = color;
  }
}

void TriangleStore::set_numbers(std::span<const PixelTag> tags, std::vector<std::int64_t>& numbers) const {
  numbers.resize(tags.size());
  std::ranges::transform(tags, numbers.begin(), [this](PixelTag id) {
    return id == KeptIds::kNoTriangle ? -1 : static_cast<std::int64_t>(numbers_[id]);
  });
}

void TriangleStore::set_exact_depths(int row, std::span<const PixelTag> ids,
                                     std::vector<Ball>& depths) const {
  if (!keeps_corners()) return;
  depths.resize(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == KeptIds::kNoTriangle) continue;
    const auto& [p, low_parts, marks] = corners_[ids[i]];
    const ExactTriangle triangle = {p, &low_parts, marks};
    const auto depth = [&](const auto& rule) { return rule.exact_depth(triangle, row, static_cast<int>(i)); };
    const bool is_flat = p[0].z == p[1].z && p[0].z == p[2].z;
    depths[i] = is_flat ? Ball(p[0].z) : std::visit(depth, *setup_.exact_depths);
  }
}

void TriangleStore::add_text(const TriangleBatch& p_ndc, std::size_t index) {
  texts_.append(p_ndc.texts[index]);
  text_ends_.push_back(texts_.size());
  if (is_needed_) are_needed_.push_back(is_needed_(exact_triangle(p_ndc, index)) ? 1 : 0);
}

/// Adds to the kept triangles the needed ones, and all pieces of each (a run with one number): from them, a
/// wireframe finds the edges that are cuts. With `may_go_on`, more pieces of the last triangle may follow, so
/// it is kept.
void TriangleStore::complete(KeptIds& kept, bool may_go_on) const {
  for (std::size_t begin = 0, end = 0; begin < text_ends_.size(); begin = end) {
    for (end = begin + 1; end < text_ends_.size() && numbers_[end] == numbers_[begin];) ++end;
    bool is_any_kept = may_go_on && end == text_ends_.size();
    for (std::size_t i = begin; i < end; ++i)
      is_any_kept |= kept.is_kept(static_cast<KeptIds::Id>(i)) || (is_needed_ && are_needed_[i] != 0);
    for (std::size_t i = begin; is_any_kept && i < end; ++i) kept.keep(static_cast<KeptIds::Id>(i));
  }
}

void TriangleStore::write_seen(TextWriter& text, const StageReader& reader, KeptIds& seen) const {
  if (setup_.wireframe != nullptr) setup_.wireframe->for_each_id([&](PixelTag id) { seen.keep(id); });
  text.append(reader.header_text());
  complete(seen, false);
  std::uint64_t next_number = 0;
  for (std::size_t i = 0; i < text_ends_.size(); ++i) {
    if (!seen.is_kept(static_cast<KeptIds::Id>(i))) continue;
    if (numbers_[i] != next_number) text.append("triangle " + std::to_string(numbers_[i]) + "\n");
    text.append(this->text(i));
    next_number = numbers_[i] + 1;
  }
  if (reader.header().framed) text.append("end\n");
}

void TriangleStore::keep_texts(const KeptIds& kept) {
  std::size_t length = 0, count = 0;
  for (std::size_t id = 0; id < text_ends_.size(); ++id) {
    if (!kept.is_kept(static_cast<KeptIds::Id>(id))) continue;
    const std::string_view moved = text(id);
    std::memmove(texts_.data() + length, moved.data(), moved.size());
    length += moved.size();
    text_ends_[count++] = length;
  }
  texts_.resize(length);
  text_ends_.resize(count);
}

void TriangleStore::let_go(KeptIds& kept) {
  complete(kept, true);
  const std::size_t count = kept.renumber();
  capacity_ = std::max(2 * count, min_capacity_);
  next_id_ = static_cast<KeptIds::Id>(count);
  if (shader_) shader_->keep(kept);
  if (setup_.wireframe != nullptr) setup_.wireframe->keep(kept);
  keep_texts(kept);
  are_needed_.keep(kept);
  if (keeps_numbers()) numbers_.keep(kept);
  if (keeps_corners()) corners_.keep(kept);
}

}  // namespace pipeline
