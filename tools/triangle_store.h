#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "libpipeline/coverage/span.h"
#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/text_store.h"
#include "libpipeline/stream/triangle_batch.h"
#include "tools/fragment_report.h"

namespace pipeline {

/// Assigns every triangle of the stream, in order, the tag of its pixels: the id under which it is kept, for
/// the surface shader or for its text, or, if it is kept for neither, the RGB value of its color. Hands each
/// to the report, if there is one.
///
/// Of the triangles kept only those that are seen need to stay. They are found whenever twice as many are
/// kept as were seen the last time; so memory is bounded by the picture. That takes two passes over its
/// pixels, so it is done only when at least one triangle per pixel has been kept.
class TriangleStore {
 public:
  struct Setup {
    bool keeps_text = false;
    Color background;
    std::size_t pixel_count = 0;  // of the picture, or of its samples
  };

  TriangleStore(const Setup& setup, std::optional<SurfaceShader>& shader, FragmentReport* report);

  /// The tag of a pixel without a triangle.
  [[nodiscard]] PixelTag background() const {
    return has_ids() ? KeptIds::kNoTriangle : setup_.background.rgb();
  }
  /// Adds the triangles of the next batch. `is_needed(index)`, called in order, is true for those whose text
  /// is to be kept for good.
  template <typename IsNeeded>
  void add(const TriangleBatch& p_ndc, const IsNeeded& is_needed) {
    if (!texts_) return;
    first_of_batch_ = static_cast<KeptIds::Id>(texts_->size());
    texts_->add(p_ndc);
    for (std::size_t i = 0; i < p_ndc.size(); ++i)
      if (is_needed(i)) texts_->keep_always(id_of(i));
  }
  /// The tag of each triangle of that batch, to be called in order.
  PixelTag tag_of(const TriangleBatch& p_ndc, std::size_t index) {
    if (report_ != nullptr) report_->add(p_ndc, index);
    if (texts_ && !shader_) return id_of(index);
    const Color color = colors_.of(p_ndc.numbers[index]);
    return shader_ ? shader_->add(p_ndc, index, color) : color.rgb();
  }
  /// The colors of pixels with these tags, unless there is a shader.
  void color(std::span<const PixelTag> tags, std::span<Color> colors);

  [[nodiscard]] bool keeps_text() const { return texts_.has_value(); }
  /// The count of triangles kept.
  [[nodiscard]] std::size_t size() const { return texts_ ? texts_->size() : shader_ ? shader_->size() : 0; }
  /// Writes the texts of the triangles that are seen, all pieces of each.
  void write_texts(TextWriter& text, KeptIds& seen) const;

  /// True if it is time to let go of triangles.
  [[nodiscard]] bool is_full() const { return size() >= capacity_; }
  /// Lets go of the triangles that no pixel shows. `for_each_tag(visit)` calls visit(tag), which changes it,
  /// for every pixel; all triangles so far are drawn.
  template <typename ForEachTag>
  void keep_seen(const ForEachTag& for_each_tag) {
    KeptIds kept(size());
    for_each_tag([&](PixelTag& tag) { kept.keep(tag); });
    let_go(kept);
    for_each_tag([&](PixelTag& tag) { tag = kept.new_id(tag); });
  }

 private:
  [[nodiscard]] bool has_ids() const { return shader_ || texts_; }
  [[nodiscard]] KeptIds::Id id_of(std::size_t index) const {
    return first_of_batch_ + static_cast<KeptIds::Id>(index);
  }
  void let_go(KeptIds& kept);

  Setup setup_;
  std::optional<SurfaceShader>& shader_;
  std::optional<TextStore> texts_;
  KeptIds::Id first_of_batch_ = 0;
  FragmentReport* report_;
  TriangleColors colors_;
  std::size_t min_capacity_;
  std::size_t capacity_;
};

}  // namespace pipeline
