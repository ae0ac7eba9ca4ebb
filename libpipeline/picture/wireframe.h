#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// The width and height of a pixel in NDC.
struct PixelSize {
  double dx;
  double dy;
};

/// The edges of the triangles of a wireframe, by the order in which they are added.
class Wireframe {
 public:
  explicit Wireframe(const PixelSize& pixel) : pixel_(pixel) {}

  /// Adds a triangle all of whose edges are drawn. A corner is given as its x, y and w in clip space; w may
  /// have any sign.
  void add(const Triangle& screen_corners);
  /// Adds a triangle of a text that does not record clipping. Edges are not drawn if they lie in a plane of
  /// the view volume, or are shared with the triangle before and both are pieces of triangle `number`.
  void add_piece(const Triangle& p_ndc, const Triangle& screen_corners, std::uint64_t number);

  /// True if (x, y) in NDC lies within half a pixel of an edge of triangle `index` that is drawn. Edges are
  /// straight lines without ends here: a line leaves its triangle at a corner, through another edge.
  [[nodiscard]] bool is_on_edge(std::size_t index, double x, double y) const;

 private:
  /// The signed distance in pixels is a x + b y + c.
  struct Line {
    double a, b, c;
  };
  struct Piece {
    std::uint64_t number;
    Triangle p_ndc;
  };
  static constexpr Line kNotDrawn = {0, 0, 1e300};

  [[nodiscard]] Line line(const Vec3& p, const Vec3& q) const;

  PixelSize pixel_;
  std::vector<std::array<Line, 3>> edges_;  // edge i goes from corner i to the next
  std::optional<Piece> last_;
};

}  // namespace pipeline
