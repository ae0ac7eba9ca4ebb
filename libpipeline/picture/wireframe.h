#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/stream/chunked_array.h"
#include "libpipeline/stream/kept_ids.h"

namespace pipeline {

/// The width and height of a pixel in NDC.
struct PixelSize {
  double dx;
  double dy;
};

/// The edges of the triangles of a wireframe, by the order in which they are added.
class Wireframe {
 public:
  /// The signed distance in pixels is a x + b y + c.
  struct Line {
    double a, b, c;
  };
  /// Of a triangle; edge i goes from corner i to the next.
  using Edges = std::array<Line, 3>;

  explicit Wireframe(const PixelSize& pixel) : pixel_(pixel) {}

  /// Adds a triangle all of whose edges are drawn. A corner is given as its x, y and w in clip space; w may
  /// have any sign.
  void add(const Triangle& screen_corners);
  /// Adds a triangle of a text that does not record clipping. Edges are not drawn if they lie in a plane of
  /// the view volume, or are shared with the triangle before and both are pieces of triangle `number`.
  void add_piece(const Triangle& p_ndc, const Triangle& screen_corners, std::uint64_t number);
  /// Keeps the triangles that are kept, under their new ids. The last one has to be: another piece may
  /// follow.
  void keep(const KeptIds& kept) { edges_.keep(kept); }

  [[nodiscard]] const Edges& edges(std::size_t index) const { return edges_[index]; }
  /// True if (x, y) in NDC lies within half a pixel of an edge that is drawn. Edges are straight lines
  /// without ends here: a line leaves its triangle at a corner, through another edge.
  [[nodiscard]] static bool is_on_edge(const Edges& edges, double x, double y);

 private:
  struct Piece {
    std::uint64_t number;
    Triangle p_ndc;
  };
  static constexpr Line kNotDrawn = {0, 0, 1e300};

  [[nodiscard]] Line line(const Vec3& p, const Vec3& q) const;

  PixelSize pixel_;
  ChunkedArray<Edges> edges_;
  std::optional<Piece> last_;
};

}  // namespace pipeline
