#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libpipeline/picture/shading.h"
#include "libpipeline/picture/wireframe.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/stream/chunked_array.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// Where a surface is lit: nowhere, once per triangle, at its vertices, or at every pixel.
enum class ShadingModel { none, flat, gouraud, phong };

/// Gives pixels their colors once the triangle that each one shows is known: keeps the triangles of a scene
/// with colors or lights, each under an id by which the visibility algorithm refers to it. So hidden surfaces
/// are never lit or shaded. Attributes are interpolated between vertices perspective-correctly. Flat and
/// gouraud shading light each triangle that is seen, a clipped one as it was before the cut; phong shading
/// lights visible pixels. Gouraud shading clamps the vertices' colors before it interpolates them, as OpenGL
/// does. Without vertex normals, all models use the triangle's.
class SurfaceShader {
 public:
  using SurfaceId = KeptIds::Id;
  /// The id of a pixel without a triangle.
  static constexpr SurfaceId kNoSurface = KeptIds::kNoTriangle;

  /// How a scene is lit, by the number of the material. Every model but `none` needs a lighting for each and
  /// `view_from_clip`.
  struct Setup {
    ShadingModel model = ShadingModel::none;
    std::vector<Lighting> lightings;
    std::optional<ViewFromClip> view_from_clip;
    Color background;
    std::optional<Wireframe> wireframe;  // then pixels off the edges show the background
    bool says_what_was_clipped = false;  // as texts with lights do
  };

  SurfaceShader(const Viewport& screen, Setup setup) : grid_(screen), setup_(std::move(setup)) {}

  /// Keeps a triangle of a batch in NDC and returns its id; `own_color` is its color if it carries none.
  SurfaceId add(const TriangleBatch& p_ndc, std::size_t index, Color own_color);
  /// The count of triangles kept; their ids are less.
  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  /// Lets go of the triangles that are not kept; the others have new ids from now on. The one added last has
  /// to be kept.
  void keep(const KeptIds& kept);
  /// The colors of a row of the image, by the ids seen in it. Valid until the next call.
  std::span<const Color> shade(int row, std::span<const SurfaceId> ids);

  /// Whether some pixel shaded so far differs from the background, by more than one step in a channel.
  [[nodiscard]] bool shows_something() const { return shows_something_; }
  /// The largest channel of all colors that triangles carry, or some channel above 1; none if they carry
  /// none.
  [[nodiscard]] std::optional<double> greatest_channel() const { return greatest_channel_; }
  [[nodiscard]] const Setup& setup() const { return setup_; }

 private:
  /// A triangle ready to be shaded.
  struct Surface {
    Triangle screen_corners;  // x and y of clip space, and w for z
    std::array<SurfacePoint, 3>
        corners;  // in view space; the colors are lit already except for phong shading
    std::uint32_t material = 0;
  };
  struct CachedSurface {
    SurfaceId id = kNoSurface;
    Surface surface;
  };

  [[nodiscard]] ClipTriangle unclipped_in_clip_space(const TriangleBatch& p_ndc, std::size_t index,
                                                     Color own_color) const;
  [[nodiscard]] const Surface& surface(SurfaceId id);
  [[nodiscard]] Surface made_surface(const ClipTriangle& corners) const;
  [[nodiscard]] const Lighting& lighting_of(const Surface& surface) const {
    return setup_.lightings[surface.material];
  }
  void light_corners(Surface& surface) const;
  void look_for_something(std::span<const Color> colors);
  void note_colors(const std::array<Vec3, 3>& colors);
  void add_edges(const TriangleBatch& p_ndc, std::size_t index, const Triangle& screen_corners);
  void shade_columns(std::size_t begin, std::size_t end, double y, SurfaceId id);
  [[nodiscard]] Color color_at(const Surface& surface, double x, double y) const;

  PixelGrid grid_;
  Setup setup_;
  ChunkedArray<ClipTriangle> triangles_;
  bool has_normals_ = false;
  std::vector<CachedSurface>
      cache_;  // each id has one entry; those of a row are mostly seen in the next, too
  std::vector<Color> row_;
  bool shows_something_ = false;
  std::optional<double> greatest_channel_;
};

}  // namespace pipeline
