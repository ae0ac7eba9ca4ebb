#include "libpipeline/vertex/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/exact_sum.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// The sign of the determinant with rows (x, y, w) of the three vertices. This is the sign of the area in NDC
/// of the part in front of the eye, unless the projection mirrors one axis.
int winding_sign(const Triangle& p_view, bool is_perspective) {
  const auto w = [&](const Vec3& p) { return is_perspective ? -p.z : 1.0; };
  const auto& [a, b, c] = p_view;
  const double minor_a = b.x * c.y - b.y * c.x;
  const double minor_b = c.x * a.y - c.y * a.x;
  const double minor_c = a.x * b.y - a.y * b.x;
  const double determinant = minor_a * w(a) + minor_b * w(b) + minor_c * w(c);
  const auto size = [](double p, double q, double r, double s) {
    return std::fabs(p * q) + std::fabs(r * s);
  };
  const double magnitude = size(b.x, c.y, b.y, c.x) * std::fabs(w(a)) +
                           size(c.x, a.y, c.y, a.x) * std::fabs(w(b)) +
                           size(a.x, b.y, a.y, b.x) * std::fabs(w(c));
  // Minors that underflow lose up to 2^-1073.
  const double lost = 0x1p-1070 * (std::fabs(w(a)) + std::fabs(w(b)) + std::fabs(w(c))) + 0x1p-1000;
  if (std::fabs(determinant) > 8 * kUnitRoundoff * magnitude + lost) return determinant > 0 ? 1 : -1;
  return exact_sum({{b.x, c.y, w(a)},
                    {-b.y, c.x, w(a)},
                    {c.x, a.y, w(b)},
                    {-c.y, a.x, w(b)},
                    {a.x, b.y, w(c)},
                    {-a.y, b.x, w(c)}})
      .sign();
}

/// For messages, the location of the corner with the largest weight in a piece's vertex.
// N4
LineAndColumn location_of(const ClipVertex& vertex, const VertexLocations& corners) {
  const auto heaviest = std::max_element(vertex.weights.begin(), vertex.weights.end());
  return corners[static_cast<std::size_t>(heaviest - vertex.weights.begin())];
}

BallVec3 point_of(const ClipVertex& vertex) {
  return {vertex.x, vertex.y, vertex.z};
}

/// The point in NDC; w must not contain 0.
// P4
BallVec3 perspective_divide(const ClipVertex& p_clip) {
  return {p_clip.x / p_clip.w, p_clip.y / p_clip.w, p_clip.z / p_clip.w};
}

}  // namespace

ProjectionStage::ProjectionStage(const ProjectionTransform& projection, ClipMode clip, CullMode cull,
                                 CoordinateRounder& rounder, double clip_inset)
    : projection_(projection),
      clip_(clip),
      cull_(cull),
      clip_inset_(clip_inset),
      rounder_(rounder),
      coefficients_(coefficients_of(projection, clip_inset)),
      mirrored_(projection.x_scale.sign() * projection.y_scale.sign() < 0) {}

void ProjectionStage::project(const TriangleBatch& p_view, TriangleBatch& p_ndc) {
  p_ndc.clear();
  writes_w_ = error_ || p_view.attributes.names().any();
  for (std::size_t i = 0; i < p_view.size(); ++i) {
    if (i % VertexBlock::kTriangles == 0) {
      const std::size_t count = std::min(p_view.size() - i, VertexBlock::kTriangles);
      vertices_.fill(std::span(p_view.triangles).subspan(i, count));
      if (clips_all()) vertex_kernel().find_sides(coefficients_, vertices_, sides_, planes() != 1);
      has_images_ = false;
    }
    const std::size_t done_count = p_ndc.size();
    try {
      project_triangle(p_view, i, p_ndc);
    } catch (...) {
      p_ndc.truncate(done_count);
      throw;
    }
  }
}

void ProjectionStage::project_triangle(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc) {
  const Triangle& triangle = p_view.triangles[index];
  if (culls(triangle)) {
    ++counts_.culled;
    return;
  }
  if (may_clip(triangle)) return project_or_clip(p_view, index, p_ndc);
  project_unclipped(p_view, index, p_ndc);
}

void ProjectionStage::project_or_clip(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc) {
  const Fate fate = fate_of(clips_all() ? sides_.of_triangle(index % VertexBlock::kTriangles)
                                        : certain_sides(coefficients_, p_view.triangles[index]));
  if (fate == Fate::stays_whole) return project_unclipped(p_view, index, p_ndc);
  if (fate == Fate::is_unsure) return project_clipped(p_view, index, p_ndc);
  drop_outside(p_view, index, p_ndc);
}

/// True if clipping might leave something of a triangle within the error bounds of this one.
bool ProjectionStage::may_be_inside(const Triangle& p_view) const {
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const Vec3& p : p_view) {
    const double distance = -p.z + error_->at(largest_in(p)) + std::fabs(p.z) * 0x1p-50;
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  return farthest >= projection_.near || (clip_ == ClipMode::automatic && nearest * 1024 >= projection_.near);
}

/// Adds a triangle that clipping has dropped, as a piece without area that keeps the whole.
void ProjectionStage::add_possible(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc) {
  const Vec3 on_far = {0, 0, 1};
  p_ndc.add({on_far, on_far, on_far}, p_view.numbers[index], p_view.locations[index]);
  const double w = projection_.is_perspective ? projection_.far : 1;
  add_attributes(p_view, index, {{{{1, 0, 0}, w}, {{0, 1, 0}, w}, {{0, 0, 1}, w}}}, p_ndc);
  p_ndc.set_last_unclipped(
      unclipped_in_clip_space(corners_in_clip_space(p_view.triangles[index]), p_view, index));
}

// P5
bool ProjectionStage::is_culled(const Triangle& p_view) const {
  const int sign = winding_sign(p_view, projection_.is_perspective) * (mirrored_ ? -1 : 1);
  return cull_ == CullMode::back ? sign < 0 : sign > 0;
}

// P7
ProjectionStage::Fate ProjectionStage::fate_of(const CertainSides& sides) const {
  if ((sides.all_outside & planes()) != 0) return Fate::is_dropped;
  const std::uint64_t unsure = clip_ == ClipMode::reject ? sides.none_inside : sides.some_unsure & planes();
  return unsure != 0 ? Fate::is_unsure : Fate::stays_whole;
}

void ProjectionStage::add_attributes(const TriangleBatch& p_view, std::size_t index,
                                     const std::array<CornerMix, 3>& mixes, TriangleBatch& p_ndc) {
  const AttributeArrays& corners = p_view.attributes;
  TriangleLines lines;
  AttributeSet names = corners.names();
  names.w = true;
  for (std::size_t v = 0; v < 3; ++v) lines.vertices[v].w = mixes[v].w;
  for_each_attribute([&](const auto& attribute) {
    const auto& array = corners.*attribute.array;  // the array of w is empty
    for (std::size_t v = 0; v < 3 && !array.empty(); ++v) {
      auto& value = lines.vertices[v].*attribute.value = mean(array[index], mixes[v].weights);
      // Rounded weights may push a value at a limit beyond it.
      for (double* number : numbers_of(value))
        *number = std::clamp(*number, attribute.least, attribute.greatest);
    }
  });
  if (names.material) lines.material = corners.materials[index];
  p_ndc.attributes.add(lines, names);
}

void ProjectionStage::project_unclipped(const TriangleBatch& p_view, std::size_t index,
                                        TriangleBatch& p_ndc) {
  // A block is transformed as soon as one of its triangles is neither culled nor dropped: with AVX2 the
  // kernel takes 7 % of `project`'s instructions, so leaving out the other triangles would save little.
  if (!has_images_) {
    vertex_kernel().project(coefficients_, rounder_.rounding_test(), vertices_, block_);
    has_images_ = true;
  }
  const std::size_t target = p_ndc.size(), in_block = index % VertexBlock::kTriangles;
  const Triangle& triangle = p_view.triangles[index];
  p_ndc.add(block_.triangle(in_block), p_view.numbers[index], p_view.locations[index]);
  const auto* const passes = &block_.passes_rounding_test[3 * in_block];
  const bool is_in_front =
      !projection_.is_perspective || (triangle[0].z < 0 && triangle[1].z < 0 && triangle[2].z < 0);
  for (std::size_t v = 0; v < 3 && !(is_in_front && (passes[0] & passes[1] & passes[2]) != 0); ++v) {
    if (projection_.is_perspective && triangle[v].z >= 0)
      throw InputError(rounder_.location_of(p_view.locations[index][v]),
                       "a vertex in front of the eye (z below 0; --clip auto cuts the others)",
                       "z = " + shortest_text(triangle[v].z));
    if (passes[v] == 0)
      rounder_.set_vertex_exactly(
          p_ndc, target, v, perspective_divide(to_clip_space(projection_, triangle[v])), size_of(triangle));
  }
  if (!writes_w_) return;
  const auto& [a, b, c] = p_view.triangles[index];
  p_ndc.attributes.w.push_back({w_of(a), w_of(b), w_of(c)});
  p_ndc.attributes.add(p_view.attributes, index);
}

std::array<ClipVertex, 3> ProjectionStage::corners_in_clip_space(const Triangle& p_view) const {
  std::array<ClipVertex, 3> corners;
  for (std::size_t v = 0; v < 3; ++v) {
    corners[v] = to_clip_space(projection_, p_view[v], clip_inset_);
    corners[v].weights[v] = 1;
  }
  return corners;
}

/// The part of the triangle inside the planes of the clip mode, with the true w of its vertices.
std::vector<ClipVertex> ProjectionStage::clipped(const std::array<ClipVertex, 3>& corners,
                                                 const Triangle& p_view) const {
  std::vector<ClipVertex> polygon =
      clip_ == ClipMode::frustum ? clip_polygon(corners, kAllClipPlanes) : clip_polygon(corners, kNearPlane);
  if (clip_inset_ == 0) return polygon;
  for (ClipVertex& vertex : polygon) {
    const auto corner = std::ranges::find(corners, vertex);
    if (corner == corners.end())
      vertex.w = vertex.w / (Ball(1) - clip_inset_);
    else  // dividing again would lose digits
      vertex.w = w_of(p_view[static_cast<std::size_t>(corner - corners.begin())]);
  }
  return polygon;
}

// P10, P11
void ProjectionStage::project_clipped(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc) {
  const auto& corners = corners_ = corners_in_clip_space(p_view.triangles[index]);
  const Outcodes outside = outcodes(corners);
  if ((outside.all & planes()) != 0) return drop_outside(p_view, index, p_ndc);
  if ((outside.any & planes()) == 0 || clip_ == ClipMode::reject)
    return project_unclipped(p_view, index, p_ndc);
  const std::vector<ClipVertex> polygon = clipped(corners, p_view.triangles[index]);
  if (polygon.empty()) return drop_outside(p_view, index, p_ndc);
  ++counts_.clipped;
  const auto unclipped = keeps_unclipped_ ? unclipped_in_clip_space(corners, p_view, index) : nullptr;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    ++counts_.pieces;
    add_piece(p_view, index, {&polygon[0], &polygon[i], &polygon[i + 1]}, p_ndc);
    if (unclipped) p_ndc.set_last_unclipped(unclipped);
  }
}

/// The triangle with its attributes in clip space; null if a coordinate is too large for a double. The w of
/// `corners` is not used: clip_inset may have scaled it.
std::shared_ptr<const ClipTriangle> ProjectionStage::unclipped_in_clip_space(
    const std::array<ClipVertex, 3>& corners, const TriangleBatch& p_view, std::size_t index) {
  const double input_size = size_of(p_view.triangles[index]);
  ClipTriangle triangle;
  p_view.attributes.copy(index, triangle);
  std::array<bool, 3> is_certain = {};
  for (std::size_t v = 0; v < 3; ++v) {
    const BallVec3 p = point_of(corners[v]);
    const PrintablePoint rounded = round_to_text(p, kShortest, rounder_.size_for_zero(input_size, p));
    if (rounded.overflow != 0) {
      if (error_) throw rounder_.without_bounds(p_view.locations[index][v]);
      return nullptr;
    }
    triangle[v].position = rounded.hi;
    triangle[v].w = w_of(p_view.triangles[index][v]);
    is_certain[v] = rounded.is_certain;
  }
  for (std::size_t v = 0; v < 3; ++v)
    if (!is_certain[v]) rounder_.add_uncertain(p_view.locations[index][v], point_of(corners[v]), input_size);
  return std::make_shared<const ClipTriangle>(triangle);
}

/// The image of a piece's vertex if that is a corner of its triangle and passed the rounding test.
std::optional<Vec3> ProjectionStage::image_of_corner(const ClipVertex& vertex, std::size_t index) const {
  if (!has_images_ || clip_inset_ != 0) return std::nullopt;
  const std::size_t first = 3 * (index % VertexBlock::kTriangles);
  for (std::size_t v = 0; v < 3; ++v)
    if (vertex.weights[v] == 1 && block_.passes_rounding_test[first + v] != 0 && vertex == corners_[v])
      return block_.vertex(first + v);
  return std::nullopt;
}

/// Adds the image of a piece of triangle `index`, with the triangle's number.
void ProjectionStage::add_piece(const TriangleBatch& p_view, std::size_t index, const Piece& piece,
                                TriangleBatch& p_ndc) {
  const std::size_t target = p_ndc.size();
  VertexLocations locations;
  for (std::size_t v = 0; v < 3; ++v) locations[v] = location_of(*piece[v], p_view.locations[index]);
  p_ndc.add({}, p_view.numbers[index], locations);
  const double input_size = size_of(p_view.triangles[index]);
  std::array<CornerMix, 3> mixes;
  for (std::size_t v = 0; v < 3; ++v) {
    // A divisor that may be 0 leaves the quotient unknown.
    if (piece[v]->w.sign() <= 0)
      throw InputError(rounder_.location_of(locations[v]),
                       "a cut that 31 digits can tell from the eye plane (a larger near helps)",
                       "one nearer to it");
    PrintableNumber w;
    if (writes_w_) w = round_to_shortest(piece[v]->w, input_size);
    mixes[v] = {piece[v]->weights, w.hi};
    const auto image = w.is_certain ? image_of_corner(*piece[v], index) : std::nullopt;
    if (image)
      p_ndc.triangles[target][v] = *image;
    else
      rounder_.set_vertex_exactly(p_ndc, target, v, perspective_divide(*piece[v]), input_size, w.is_certain);
  }
  if (writes_w_) add_attributes(p_view, index, mixes, p_ndc);
}

StageHeader projected_header(const StageHeader& p_view, const Located<Projection>& given,
                             const ProjectionTransform& projection) {
  StageHeader header = {.framed = p_view.framed, .camera = {}, .appearance = p_view.appearance};
  if (header.appearance.attributes) header.appearance.attributes->value.w = true;
  header.bounds = p_view.bounds;
  if (header.bounds && !header.appearance.attributes)
    header.appearance.attributes = {{.w = true}, header.bounds->location};
  if (!header.appearance.lights.empty() || header.bounds)
    header.projected = {volume_of(given, projection), given.location};
  return header;
}

}  // namespace pipeline
