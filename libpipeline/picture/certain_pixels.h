#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "libpipeline/picture/true_outline.h"

namespace pipeline {

/// Which pixels show, by rule `center`, the triangle that exact arithmetic shows, whatever the true vertices
/// are within the bounds of a projected text: the pixels of which some triangle surely covers the center, and
/// no other may be as near there, or that no triangle may cover.
class CertainPixels {
 public:
  /// `projected` is the header's, a Frustum or an Orthographic, and `bounds` has both of its parts.
  CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// Takes the next triangles. Pieces stand for the triangle that they were cut from.
  void add(const TriangleBatch& p_ndc);
  /// Whether the pixel of a drawn row certainly shows the triangle `number`; -1: none.
  [[nodiscard]] bool is_certain(int row, int column, std::int64_t number) const;

 private:
  /// Distances in front of the eye: the least upper bound of those who surely cover the pixel's center, and
  /// the two least lower bounds of those who may.
  struct Pixel {
    static constexpr double kFar = std::numeric_limits<double>::infinity();
    double sure = kFar, possible = kFar, second_possible = kFar;
    std::int64_t sure_number = -1;
  };
  /// Those of a row whose centers a triangle may cover, and those that it surely covers.
  struct Columns {
    RowRange possible, sure;
  };
  [[nodiscard]] Columns columns_of(const TrueOutline& outline, double v) const;
  void add_row(const TrueOutline& outline, int row, std::int64_t number);
  [[nodiscard]] std::size_t index_of(int row, int column) const;

  Viewport screen_;
  TrueOutlines outlines_;
  std::pair<double, double> front_, rear_;  // distances that these limits lie between
  std::shared_ptr<const ClipTriangle> last_whole_;
  std::vector<Pixel> pixels_;
};

}  // namespace pipeline
