#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libpipeline/picture/corner_weights.h"
#include "libpipeline/picture/shading.h"
#include "libpipeline/picture/shown_colors.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// Colors pixels once the triangle that each shows is known: keeps the triangles of a scene with colors or
/// lights, each under an id for the visibility algorithm. So hidden surfaces are never lit or shaded.
/// Attributes are interpolated between vertices perspective-correctly. Flat and gouraud shading light each
/// visible triangle, a clipped one as before the cut; phong shading lights visible pixels. Gouraud shading
/// clamps the vertices' colors before it interpolates them, as OpenGL does. Without vertex normals, all
/// models use the triangle's normal.
class SurfaceShader {
 public:
  using SurfaceId = KeptIds::Id;
  /// The id of a pixel without a triangle.
  static constexpr SurfaceId kNoSurface = KeptIds::kNoTriangle;

  /// The shading and its data. Every model but `none` needs at least one material, and `view_from_clip`.
  struct Setup {
    ShadingModel model = ShadingModel::none;
    Lighting lighting;
    std::vector<Material> materials;  // indexed by their numbers
    std::optional<ViewFromClip> view_from_clip;
    Color background;
  };

  /// A triangle ready to be shaded.
  struct Surface {
    CornerWeights weights;
    // In view space; the colors are already lit except for phong shading.
    std::array<SurfacePoint, 3> corners;
    std::uint32_t material = 0;
    double greatest_channel = 0;  // of its own colors
  };

  SurfaceShader(const Viewport& screen, Setup setup) : grid_(screen), setup_(std::move(setup)) {}

  /// Keeps a triangle of a batch in NDC and returns its id; `own_color` is its color if the batch has none.
  SurfaceId add(const TriangleBatch& p_ndc, std::size_t index, Color own_color);
  /// The count of kept triangles, which is above all ids.
  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  /// Drops all other triangles, and gives the kept ones their new ids.
  void keep(const KeptIds& kept);
  /// Makes room for the workers of a pool; at first, there is one.
  void set_workers(int count) { workers_.resize(static_cast<std::size_t>(count)); }
  /// The colors of a row of the image whose pixels show these ids; valid until the worker's next call.
  /// Workers may call it at the same time.
  std::span<const Color> shade(int row, std::span<const SurfaceId> ids, int worker = 0);

  // The next three keep no triangles, and may be called on any number of threads at a time.
  /// The surface of a triangle of a batch in NDC; `own_color` is its color if the batch has none.
  [[nodiscard]] Surface surface_of(const TriangleBatch& p_ndc, std::size_t index, Color own_color) const {
    return made_surface(unclipped(p_ndc, index, own_color));
  }
  /// The color of a surface at the center of a pixel.
  [[nodiscard]] Color color_at(const Surface& surface, int row, int column) const;
  /// The data that explain why a surface looks black.
  [[nodiscard]] DarkSurface dark_surface(const Surface& surface) const;

  /// Statistics of the pixels shaded so far; of some of them in a high picture, or once these show enough.
  [[nodiscard]] ShownColors shown() const;
  /// True if the triangles seen lie in one plane; known only while they show one color.
  [[nodiscard]] bool is_plane() const;
  [[nodiscard]] bool is_lit() const { return setup_.model != ShadingModel::none; }
  [[nodiscard]] const Setup& setup() const { return setup_; }
  [[nodiscard]] const PixelGrid& grid() const { return grid_; }

 private:
  struct KeptTriangle {
    ClipTriangle corners;     // positions in NDC if they are divided by w, else in clip space
    bool is_divided = false;  // false for pieces, whose corners may lie behind the eye
    bool has_normals = false;
    std::uint32_t material = 0;
  };
  struct CachedSurface {
    SurfaceId id = kNoSurface;
    Surface surface;
  };
  struct Worker {
    std::vector<CachedSurface> cache;  // an id has one possible entry; the next row mostly shows the same ids
    std::vector<Color> row;
    ShownColors shown;                       // excludes pixels that look black
    std::vector<std::uint32_t> dark_pixels;  // their count for each id; empty if there are none
    std::vector<bool> seen;                  // by id, as long as all have one color
  };

  [[nodiscard]] KeptTriangle unclipped(const TriangleBatch& p_ndc, std::size_t index, Color own_color) const;
  [[nodiscard]] const Surface& surface(SurfaceId id, Worker& worker) const;
  [[nodiscard]] Surface made_surface(const KeptTriangle& kept) const;
  void light_corners(Surface& surface) const;
  void look_at_run(SurfaceId id, std::span<const Color> colors, Worker& worker) const;
  /// In a tall picture, statistics cover every fourth row.
  [[nodiscard]] int row_stride() const { return grid_.rows > 256 ? 4 : 1; }
  /// With this many visible pixels, the others no longer matter.
  [[nodiscard]] double enough_visible() const {
    const int row_count = grid_.rows / row_stride();
    return ShownColors::kVisibleShare * grid_.columns * row_count;
  }
  void shade_run(const Surface& surface, int row, int column, int count, Color* colors) const;

  PixelGrid grid_;
  Setup setup_;
  ChunkedArray<KeptTriangle> triangles_;
  std::vector<Worker> workers_ = std::vector<Worker>(1);
};

}  // namespace pipeline
