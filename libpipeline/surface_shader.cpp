#include "libpipeline/surface_shader.h"

#include <algorithm>
#include <cassert>

#include "libpipeline/vec_math.h"

namespace pipeline {
namespace {

using Weights = std::array<double, 3>;

SurfacePoint mean(const std::array<SurfacePoint, 3>& p, const Weights& w) {
  return {mean(Triangle{p[0].position, p[1].position, p[2].position}, w),
          mean(Triangle{p[0].normal, p[1].normal, p[2].normal}, w),
          mean(Triangle{p[0].color, p[1].color, p[2].color}, w)};
}

Vec3 to_vec3(Color color) {
  return {static_cast<double>(color.red()), static_cast<double>(color.green()),
          static_cast<double>(color.blue())};
}

/// The normal of a triangle's plane, of any length.
Vec3 face_normal(const std::array<SurfacePoint, 3>& p) {
  return cross(difference(p[1].position, p[0].position), difference(p[2].position, p[0].position));
}

/// Gives every corner the normal of the triangle.
void use_face_normal(std::array<SurfacePoint, 3>& corners) {
  const Vec3 normal = face_normal(corners);
  for (SurfacePoint& corner : corners) corner.normal = normal;
}

/// Twice the signed area of (p, q, (x, y)).
double area(const Vec3& p, const Vec3& q, double x, double y) {
  return (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x);
}

/// The weights of the corners at a point of the screen, each divided by the corner's w and all by their sum,
/// so that they are those in view space (J. Blinn, "Hyperbolic interpolation", 1992). A pixel's centre may
/// lie a little outside: no weight leaves [0, 1].
Weights weights_at(const Triangle& p_ndc, const std::array<double, 3>& w, double x, double y) {
  const auto& [a, b, c] = p_ndc;
  const double side = area(a, b, c.x, c.y) < 0 ? -1 : 1;
  Weights weights = {side * area(b, c, x, y) / w[0], side * area(c, a, x, y) / w[1],
                     side * area(a, b, x, y) / w[2]};
  for (double& weight : weights) weight = std::max(weight, 0.0);
  const double sum = weights[0] + weights[1] + weights[2];
  if (!(sum > 0)) return {1, 0, 0};
  return {weights[0] / sum, weights[1] / sum, weights[2] / sum};
}

}  // namespace

Color SurfaceShader::add(const TriangleBatch& p_ndc, std::size_t index, Color own_color) {
  const AttributeArrays& attributes = p_ndc.attributes;
  Surface surface{p_ndc.triangles[index], {1, 1, 1}, {}};
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3& p = surface.p_ndc[v];
    SurfacePoint& corner = surface.corners[v];
    if (!attributes.w.empty()) {
      surface.w[v] = attributes.w[index][v];
    } else if (setup_.view_from_ndc) {
      surface.w[v] = setup_.view_from_ndc->w_of(p);
    }
    if (setup_.view_from_ndc) corner.position = (*setup_.view_from_ndc)(p, surface.w[v]);
    corner.color = to_vec3(own_color);
    if (!attributes.colors.empty()) corner.color = attributes.colors[index][v];
    if (!attributes.normals.empty()) corner.normal = attributes.normals[index][v];
  }
  if (attributes.normals.empty() || setup_.model == ShadingModel::flat) use_face_normal(surface.corners);
  light_corners(surface);
  surfaces_.push_back(surface);
  assert(surfaces_.size() < kNoSurface.rgb());
  return Color::from_rgb(static_cast<std::uint32_t>(surfaces_.size() - 1));
}

void SurfaceShader::light_corners(Surface& surface) const {
  if (setup_.model == ShadingModel::flat) {
    const Vec3 color = lit_color(mean(surface.corners, {1.0 / 3, 1.0 / 3, 1.0 / 3}), setup_.lighting);
    for (SurfacePoint& corner : surface.corners) corner.color = color;
  } else if (setup_.model == ShadingModel::gouraud) {
    for (SurfacePoint& corner : surface.corners) corner.color = lit_color(corner, setup_.lighting);
  }
}

std::span<const Color> SurfaceShader::shade(int row, std::span<const Color> ids) {
  row_.resize(ids.size());
  const double y = grid_.y_of(row);
  for (std::size_t column = 0; column < ids.size(); ++column) {
    const Color id = ids[column];
    row_[column] = id == kNoSurface ? setup_.background
                                    : color_at(surfaces_[id.rgb()], grid_.x_of(static_cast<int>(column)), y);
  }
  return row_;
}

Color SurfaceShader::color_at(const Surface& surface, double x, double y) const {
  const SurfacePoint point = mean(surface.corners, weights_at(surface.p_ndc, surface.w, x, y));
  return rounded_color(setup_.model == ShadingModel::phong ? lit_color(point, setup_.lighting) : point.color);
}

}  // namespace pipeline
