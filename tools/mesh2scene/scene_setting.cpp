#include "tools/mesh2scene/scene_setting.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "libpipeline/numbers/angle.h"
#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

/// The part of the picture's width or height that a framed model fills.
constexpr double kShare = 0.9;

/// Up to this elevation, in degrees, the world's axis is the camera's `up`: readers recognize it, and the
/// view does not change. Nearer to the axis, rounding of the eye would turn the picture.
constexpr double kSteepestWithWorldUp = 85;

/// Nearer to each other than this share of their distance from the origin, the eye and the point it looks at
/// are rounded to one point.
constexpr double kLeastDistance = 1e-12;

/// The distance of a light from afar, in distances of the eye.
constexpr double kFar = 1000;

/// The axes of a camera's view, unit vectors to the right, upwards, and from the model to the eye.
NodeMatrix axes_of(const ModelCamera& camera) {
  const Vec3 back = unit_vector(difference(camera.eye, camera.look));
  const Vec3 right = unit_vector(cross(camera.up, back));
  return {right, cross(back, right), back, {}};
}

/// The coordinates of a direction along axes.
Vec3 along(const NodeMatrix& axes, const Vec3& v) {
  return {dot(v, axes.x), dot(v, axes.y), dot(v, axes.z)};
}

/// The setting with the file's lights; without any, with a key light from the upper left, a weaker fill from
/// the right, and a little ambient light.
SceneSetting setting_with(const ModelCamera& camera, double aspect, const Model& model) {
  SceneSetting setting;
  setting.camera = camera;
  setting.aspect = aspect;
  constexpr double kSmall = 0.03, kLarge = 1e12;
  if (camera.distance < kSmall || camera.distance > kLarge)
    setting.scale = std::pow(10, -std::floor(std::log10(camera.distance)));
  setting.lights = model.lights;
  for (ModelLight& light : setting.lights)
    if (light.is_far)
      light.position = sum(camera.look, scaled(unit_vector(light.position), -kFar * camera.distance));
  if (!model.lights.empty()) return setting;
  const auto beside = [&, axes = axes_of(camera)](const Vec3& place) {  // in distances from eye to model
    return sum(camera.look, scaled(axes.direction(place), camera.distance));
  };
  setting.ambient = {0.22, 0.22, 0.22};
  setting.lights = {{beside({-0.7, 1, 1.4}), {0.74, 0.74, 0.72}},
                    {beside({1.5, 0.3, 0.8}), {0.24, 0.24, 0.26}}};
  return setting;
}

/// Cosine and sine, without libm, whose last bits differ between systems.
std::pair<double, double> direction_of(double degrees) {
  const SineCosine angle = sine_cosine_of_degrees({degrees, 0});
  return {angle.cosine.nearest_double(), angle.sine.nearest_double()};
}

double tangent(double degrees) {
  const auto [cosine, sine] = direction_of(degrees);
  return sine / cosine;
}

/// The depth of the view behind and before the model, as a fraction of its distance: room for objects added
/// to the scene.
constexpr double kDepthMargin = 0.5;
/// The largest far / near for which a depth buffer is fine enough.
constexpr double kMostDepth = 10000;

}  // namespace

SceneSetting framed_setting(const Model& model, const ViewChoice& view) {
  // The view from the model's front, its +z side (-y if z is up; -z or +y if -y or -z is up), turned about
  // the up axis by the azimuth to the right, and upwards by the elevation.
  const Vec3 front = view.up.z != 0 ? Vec3{0, -view.up.z, 0} : Vec3{0, 0, view.up.y < 0 ? -1.0 : 1.0};
  const Vec3 side = cross(view.up, front);
  const auto [cos_a, sin_a] = direction_of(view.azimuth_degrees);
  const auto [cos_e, sin_e] = direction_of(view.elevation_degrees);
  const Vec3 toward = sum(scaled(front, cos_a), scaled(side, sin_a));
  const Vec3 back = sum(scaled(toward, cos_e), scaled(view.up, sin_e));
  const Vec3 right = difference(scaled(side, cos_a), scaled(front, sin_a));
  const NodeMatrix axes = {right, cross(back, right), back, {}};
  const double slope_y = kShare * tangent(view.fov_y_degrees / 2), slope_x = view.aspect * slope_y;
  // Of points (a, b, c) in the view's axes, the boxes of a + slope c and a - slope c; likewise for b.
  BoundingBox plus, minus;
  model.for_each_corner([&](const Vec3& p) {
    const auto [a, b, c] = along(axes, p);
    const double x = slope_x * c, y = slope_y * c;
    const Vec3 more = {a + x, b + y, c}, less = {a - x, b - y, c};
    plus.add(Triangle{more, more, more});
    minus.add(Triangle{less, less, less});
  });
  const double nearest = plus.high.z, farthest = plus.low.z;
  // An eye at (x, y, z) sees a point (a, b, c) within the share if |a - x| <= slope_x (z - c) and |b - y| <=
  // slope_y (z - c): a + slope_x c <= x + slope_x z and a - slope_x c >= x - slope_x z. Their difference
  // gives the least z.
  const double x = (plus.high.x + minus.low.x) / 2, y = (plus.high.y + minus.low.y) / 2;
  const double z =
      std::max((plus.high.x - minus.low.x) / (2 * slope_x), (plus.high.y - minus.low.y) / (2 * slope_y));
  const double middle = nearest + (farthest - nearest) / 2;
  const bool is_steep = std::fabs(view.elevation_degrees) > kSteepestWithWorldUp;
  ModelCamera camera = {axes.direction({x, y, z}), axes.direction({x, y, middle}),
                        is_steep ? axes.y : view.up, view.fov_y_degrees};
  camera.distance = z - middle;
  double eye_depth = z;
  if (view.at || view.zoom != 1) {
    camera.look = view.at.value_or(camera.look);
    camera.distance /= view.zoom;
    camera.eye = sum(camera.look, scaled(axes.z, camera.distance));
    eye_depth = dot(camera.eye, axes.z);
  }
  camera.far = (eye_depth - farthest) + kDepthMargin * camera.distance;
  camera.near = std::max((eye_depth - nearest) * kDepthMargin, camera.far / kMostDepth);
  const bool is_apart = camera.distance > kLeastDistance * largest_in(camera.look);
  if (view.at && std::isfinite(camera.far) && !(is_apart && camera.far > 0))
    throw std::runtime_error(model.name + ": expected a point --at near the model, which is before the eye");
  if (!is_apart || !std::isfinite(camera.far) || !(camera.near > 0))
    model.fail("a model with an extent", "all vertices in one point, or farther apart than numbers go");
  return setting_with(camera, view.aspect, model);
}

SceneSetting setting_of_file(const Model& model, double aspect) {
  ModelCamera camera = *model.camera;
  camera.up = unit_vector(camera.up);
  // A file gives a camera's direction, not the distance of `look`; lights should fall on the model's middle.
  Vec3 total;
  double farthest = 0;
  const Vec3 direction = unit_vector(difference(camera.look, camera.eye));
  model.for_each_corner([&](const Vec3& p) {
    total = sum(total, p);
    farthest = std::max(farthest, dot(difference(p, camera.eye), direction));
  });
  const double ahead =
      dot(difference(scaled(total, 1.0 / static_cast<double>(3 * model.triangle_count())), camera.eye),
          direction);
  camera.distance = std::max({camera.near, kLeastDistance * largest_in(camera.eye), ahead});
  camera.look = sum(camera.eye, scaled(direction, camera.distance));
  // If the file gives no end, the view reaches beyond the model.
  if (!std::isfinite(camera.far)) camera.far = 2 * std::max(camera.near, farthest);
  return setting_with(camera, aspect, model);
}

double shown_share(const Model& model, const SceneSetting& setting) {
  const ModelCamera& camera = setting.camera;
  const NodeMatrix axes = axes_of(camera);
  const double slope_y = tangent(camera.fov_y_degrees / 2), slope_x = setting.aspect * slope_y;
  Triangle corners;
  std::size_t count = 0;
  double area = 0;
  bool is_cut = false;
  model.for_each_corner([&](const Vec3& p) {
    const auto [x, y, back] = along(axes, difference(p, camera.eye));
    const double depth = -back, side = depth < camera.near ? -1 : depth > camera.far ? 1 : 0;
    corners[count++] = {x / (slope_x * depth), y / (slope_y * depth), side};  // NDC, but for z
    if (count < 3) return;
    count = 0;
    // A triangle cut by the near or the far plane, such as a floor, may cover much.
    const BoundingBox box(corners);
    is_cut = is_cut || box.low.z != box.high.z;
    const double width = std::min(box.high.x, 1.0) - std::max(box.low.x, -1.0);
    const double height = std::min(box.high.y, 1.0) - std::max(box.low.y, -1.0);
    if (box.low.z == 0 && width > 0 && height > 0)
      area += std::min(std::fabs(face_normal(corners).z) / 2, width * height);
  });
  return is_cut ? 1 : area / 4 / 2;  // of the window, which is 2 by 2; a body has two sides
}

}  // namespace pipeline
