#pragma once

#include <cstddef>
#include <variant>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/stream/unseen_places.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/pixel_rules.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {

/// The sides of the depth limits on which a triangle has fragments.
struct FragmentDepths {
  void add(DepthTestResult result) {
    before_front |= result == DepthTestResult::before_front;
    beyond_rear |= result == DepthTestResult::beyond_rear;
    visible |= result < DepthTestResult::before_front;
  }

  bool before_front = false;
  bool visible = false;
  bool beyond_rear = false;
};

/// The reason why a triangle with the box `extent` shows nowhere; never `behind`. Fragments before or beyond
/// a limit decide only if neither the box nor a missing area does.
UnseenPlace unseen_place(const Triangle& p_ndc, const BoundingBox& extent, const FragmentDepths& fragments,
                         const Viewport& screen);

/// A quick test by the box `extent` around a triangle: false only if it surely shows at no pixel.
bool may_be_visible(const Triangle& p_ndc, const BoundingBox& extent, const Viewport& screen);

/// False for a triangle seen edge-on, or whose corners lie on a line.
bool has_area(const Triangle& p_ndc);

/// Watches the triangles of a stream until the first with an area shows at a pixel; if none does, the picture
/// is empty or shows lines alone.
class EmptyPicture {
 public:
  EmptyPicture(const PixelRules& rules, const Viewport& screen)
      : screen_(screen), coverage_(CoverageRules::made(rules.coverage, screen)), test_(rules, screen) {}

  /// Takes the next triangles, unless an earlier one shows an area.
  void add(const TriangleBatch& p_ndc) {
    for (std::size_t i = 0; i < p_ndc.size() && !shows_area_; ++i) add(exact_triangle(p_ndc, i));
  }
  /// True while no triangle shows.
  [[nodiscard]] bool is_empty() const { return is_empty_; }
  /// True if no triangle with an area shows.
  [[nodiscard]] bool has_no_area() const { return !shows_area_; }
  /// The triangles before the first that shows an area.
  [[nodiscard]] const UnseenPlaces& triangles() const { return triangles_; }

 private:
  void add(const ExactTriangle& triangle) {
    const BoundingBox extent(triangle.p_ndc);
    FragmentDepths found;
    if (may_be_visible(triangle.p_ndc, extent, screen_)) found = fragments(triangle);
    is_empty_ &= !found.visible;
    shows_area_ = found.visible && has_area(triangle.p_ndc);
    if (shows_area_) return;
    triangles_.add(unseen_place(triangle.p_ndc, extent, found, screen_), extent);
  }

  /// The depths of a triangle's fragments, up to the first visible one.
  [[nodiscard]] FragmentDepths fragments(const ExactTriangle& triangle) const {
    FragmentDepths found;
    const auto add_rows = [&](const auto& rule) {
      const auto rows = rule.rows(triangle);
      for (int row = rows.first_row(); row <= rows.last_row() && !found.visible; ++row)
        if (const auto span = rows.span(row))
          for (int column = span->first_column; column <= span->last_column && !found.visible; ++column) {
            FragmentTest::Seen nothing = test_.nothing();
            found.add(test_.judge(nothing, {column, row}, 0, span->depth(column)).result);
          }
    };
    std::visit(add_rows, coverage_);
    return found;
  }

  Viewport screen_;
  CoverageRules::Object coverage_;
  FragmentTest test_;
  bool is_empty_ = true, shows_area_ = false;
  UnseenPlaces triangles_;
};

}  // namespace pipeline
