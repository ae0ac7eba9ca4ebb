#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/ball.h"
#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/text_writer.h"
#include "libpipeline/visibility/raster.h"
#include "tools/zbuf/sampled_drawing.h"
#include "tools/zbuf/wireframe.h"

namespace pipeline {

/// Gives every triangle of the stream, in order, the tag of its pixels: the id under which the store keeps
/// its data or, if nothing is kept, the RGB value of its color.
/// Only visible triangles need to stay. They are found whenever twice as many are kept as were visible the
/// last time, so the picture bounds memory. This takes two passes over the pixels, so it is done only once
/// there is at least one kept triangle for every four pixels.
class TriangleStore {
 public:
  struct Setup {
    bool keeps_text = false;
    bool keeps_numbers = false;                         // the triangles' numbers, for set_numbers
    std::optional<CoverageRules::Object> exact_depths;  // the rule that calculates them; none if not wanted
    Color background;
    std::size_t pixel_count = 0;           // of the picture, or of its samples
    std::unique_ptr<Wireframe> wireframe;  // null unless edges are drawn
  };

  TriangleStore(Setup setup, std::optional<SurfaceShader>& shader);

  /// The tag of a pixel without a triangle.
  [[nodiscard]] PixelTag background() const {
    return has_ids() ? KeptIds::kNoTriangle : setup_.background.rgb();
  }
  [[nodiscard]] Color background_color() const { return setup_.background; }
  [[nodiscard]] Wireframe* wireframe() const { return setup_.wireframe.get(); }
  /// Makes the store keep the texts of triangles for which `is_needed` is true, even hidden ones.
  void keep_where(std::function<bool(const ExactTriangle&)> is_needed) { is_needed_ = std::move(is_needed); }
  /// Sets the tags of the next triangles.
  void set_tags(const TriangleBatch& p_ndc, std::vector<PixelTag>& tags) {
    tags.resize(p_ndc.size());
    if (has_ids())
      for (std::size_t i = 0; i < tags.size(); ++i) tags[i] = kept(p_ndc, i);
    else
      for (std::size_t i = 0; i < tags.size(); ++i) tags[i] = colors_.of(p_ndc.numbers[i]).rgb();
  }
  /// Sets the colors of pixels with these tags, without a shader.
  void color(std::span<const PixelTag> tags, std::span<Color> colors);

  /// Sets the numbers, if kept, of the triangles with these tags; -1 without a triangle.
  void set_numbers(std::span<const PixelTag> tags, std::vector<std::int64_t>& numbers) const;

  /// Sets the exact depths of a row of pixels, if wanted; they are meaningless without a triangle.
  void set_exact_depths(int row, std::span<const PixelTag> ids, std::vector<Ball>& depths) const;

  [[nodiscard]] bool keeps_text() const { return setup_.keeps_text; }
  /// Above any id.
  [[nodiscard]] std::size_t id_count() const { return next_id_; }
  /// Writes a stage text of the visible triangles, all pieces of each, with the header as read.
  void write_seen(TextWriter& text, const StageReader& reader, KeptIds& seen) const;

  /// True if it is time to drop triangles.
  [[nodiscard]] bool is_full() const { return has_ids() && next_id_ >= capacity_; }
  /// Drops the triangles that no pixel of the drawing shows; all triangles so far must be drawn.
  void keep_seen(SampledDrawing& drawing) {
    KeptIds kept(id_count());
    const auto for_each_tag = [&](const auto& visit) {
      drawing.for_each_drawn_row([&](std::span<PixelTag> tags) { std::ranges::for_each(tags, visit); });
      if (setup_.wireframe != nullptr) setup_.wireframe->for_each_id(visit);
    };
    for_each_tag([&](PixelTag& tag) { kept.keep(tag); });
    let_go(kept);
    for_each_tag([&](PixelTag& tag) { tag = kept.new_id(tag); });
  }

 private:
  /// The corners of an ExactTriangle.
  struct Corners {
    Triangle p_ndc, low_parts;
    std::uint16_t decimal_marks;
  };

  /// Keeps a triangle, and returns its id.
  KeptIds::Id kept(const TriangleBatch& p_ndc, std::size_t index) {
    if (setup_.wireframe != nullptr) setup_.wireframe->add(p_ndc, index, next_id_);
    if (keeps_numbers()) numbers_.push_back(p_ndc.numbers[index]);
    if (keeps_text()) add_text(p_ndc, index);
    if (keeps_corners()) {
      const auto [corners, low_parts, marks] = exact_triangle(p_ndc, index);
      corners_.push_back({corners, low_parts == nullptr ? Triangle() : *low_parts, marks});
    }
    if (!shader_) return next_id_++;
    shader_->add(p_ndc, index, colors_.of(p_ndc.numbers[index]));
    return next_id_++;
  }
  [[nodiscard]] bool has_ids() const { return shader_ || keeps_numbers() || keeps_corners(); }
  /// Without a shader, colors need the numbers.
  [[nodiscard]] bool keeps_numbers() const {
    return keeps_text() || setup_.keeps_numbers || (keeps_corners() && !shader_);
  }
  [[nodiscard]] bool keeps_corners() const { return setup_.exact_depths.has_value(); }
  void add_text(const TriangleBatch& p_ndc, std::size_t index);
  void complete(KeptIds& kept, bool may_go_on) const;
  [[nodiscard]] std::string_view text(std::size_t id) const {
    const std::size_t begin = id == 0 ? 0 : text_ends_[id - 1];
    return std::string_view(texts_).substr(begin, text_ends_[id] - begin);
  }
  void keep_texts(const KeptIds& kept);
  void let_go(KeptIds& kept);

  Setup setup_;
  std::optional<SurfaceShader>& shader_;
  std::string texts_;  // one after the other
  std::vector<std::size_t> text_ends_;
  std::function<bool(const ExactTriangle&)> is_needed_;
  ChunkedArray<std::uint8_t> are_needed_;  // of texts, 0 or 1; empty without is_needed_
  ChunkedArray<std::uint64_t> numbers_;
  ChunkedArray<Corners> corners_;
  KeptIds::Id next_id_ = 0;
  TriangleColors colors_;
  std::size_t min_capacity_;
  std::size_t capacity_;
};

}  // namespace pipeline
