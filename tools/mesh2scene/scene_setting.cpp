#include "tools/mesh2scene/scene_setting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "libpipeline/numbers/angle.h"
#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

/// How much of the picture's width or height a framed model fills.
constexpr double kShare = 0.9;

/// Up to here above or below the model, the world's axis serves as the camera's `up`: a reader knows it at
/// sight, and it gives the same view. Nearer to the axis, what rounding does to the eye would turn the
/// picture.
constexpr double kSteepestWithWorldUp = 85;

/// The distance of a light that shines from afar, in distances of the eye.
constexpr double kFar = 1000;

/// Orthogonal unit vectors of a camera, in the model's space; `back` points from the model to the eye.
struct ViewAxes {
  Vec3 right, up, back;
};

/// A point given in the axes of a camera, from the middle of the model, in distances of the eye.
Vec3 beside(const FramingCamera& camera, const ViewAxes& axes, const Vec3& offset) {
  return sum(camera.look, scaled(sum(sum(scaled(axes.right, offset.x), scaled(axes.up, offset.y)),
                                     scaled(axes.back, offset.z)),
                                 camera.distance));
}

ViewAxes axes_of(const FramingCamera& camera) {
  const Vec3 back = unit_vector(difference(camera.eye, camera.look));
  const Vec3 right = unit_vector(cross(camera.up, back));
  return {right, cross(back, right), back};
}

/// A key light from the upper left, a weaker fill from the right, and a little from everywhere.
void set_studio_lights(SceneSetting& setting) {
  const ViewAxes axes = axes_of(setting.camera);
  setting.ambient = {0.22, 0.22, 0.22};
  setting.lights = {{beside(setting.camera, axes, {-0.7, 1, 1.4}), {0.74, 0.74, 0.72}},
                    {beside(setting.camera, axes, {1.5, 0.3, 0.8}), {0.24, 0.24, 0.26}}};
}

void set_lights(const ImportedModel& model, SceneSetting& setting) {
  if (model.lights().empty()) {
    set_studio_lights(setting);
    return;
  }
  setting.ambient = model.ambient();
  setting.lights = model.lights();
  for (ModelLight& light : setting.lights)
    if (light.is_far)
      light.position =
          sum(setting.camera.look, scaled(unit_vector(light.position), -kFar * setting.camera.distance));
}

SceneSetting setting_with(const FramingCamera& camera, double fov_y_degrees, double aspect,
                          const ImportedModel& model) {
  SceneSetting setting;
  setting.camera = camera;
  setting.fov_y_degrees = fov_y_degrees;
  setting.aspect = aspect;
  setting.background = {232, 235, 240};
  setting.color = {228, 222, 210};
  set_lights(model, setting);
  constexpr double kSmall = 0.03, kLarge = 1e12;
  if (camera.distance < kSmall || camera.distance > kLarge)
    setting.scale = std::pow(10, -std::floor(std::log10(camera.distance)));
  return setting;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Direction {
  double cosine, sine;
};

/// Without libm, whose last bits differ between systems.
Direction direction_of(double degrees) {
  const SineCosine angle = sine_cosine_of_degrees({degrees, 0});
  return {angle.cosine.nearest_double(), angle.sine.nearest_double()};
}

double tangent(double degrees) {
  const Direction direction = direction_of(degrees);
  return direction.sine / direction.cosine;
}

/// Depths behind and before the model that belong to the view, as fractions of its distance: room for objects
/// that are added to the scene.
constexpr double kDepthMargin = 0.5;
/// The largest far / near at which a depth buffer is still fine enough.
constexpr double kMostDepth = 10000;

Vec3 unit_vector_of(UpAxis axis) {
  constexpr std::array<Vec3, 6> kAxes = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
  return kAxes[static_cast<std::size_t>(axis)];
}

/// Seen from the front, from the model's z (with z up: -y, with -y or -z up: the other side), turned by
/// `azimuth` degrees about the up axis to the right and by `elevation` degrees, -90 to 90, upwards.
ViewAxes view_axes(UpAxis up_axis, double azimuth_degrees, double elevation_degrees) {
  const Vec3 up = unit_vector_of(up_axis);
  const Vec3 front = up.z != 0 ? Vec3{0, -up.z, 0} : Vec3{0, 0, up.y < 0 ? -1.0 : 1.0};
  const Vec3 side = cross(up, front);
  const auto [cos_a, sin_a] = direction_of(azimuth_degrees);
  const auto [cos_e, sin_e] = direction_of(elevation_degrees);
  const Vec3 toward = sum(scaled(front, cos_a), scaled(side, sin_a));
  const Vec3 back = sum(scaled(toward, cos_e), scaled(up, sin_e));
  const Vec3 right = difference(scaled(side, cos_a), scaled(front, sin_a));
  return {right, cross(back, right), back};
}

/// The largest values that decide a framing, over all points added: how far each side of a view volume of the
/// slopes given has to be moved out to hold them all.
class Framing {
 public:
  /// The picture shows angles of `fov_y_degrees` upwards; `aspect` is width / height. The points fill `share`
  /// of its width or of its height, and at most so much of the other.
  Framing(const ViewAxes& axes, double fov_y_degrees, double aspect, double share)
      : axes_(axes),
        slope_x_(share * aspect * tangent(fov_y_degrees / 2)),
        slope_y_(share * tangent(fov_y_degrees / 2)) {}

  void add(const Vec3& p) {
    const double a = dot(p, axes_.right), b = dot(p, axes_.up), c = dot(p, axes_.back);
    right_ = std::max(right_, a + slope_x_ * c);
    left_ = std::max(left_, -a + slope_x_ * c);
    top_ = std::max(top_, b + slope_y_ * c);
    bottom_ = std::max(bottom_, -b + slope_y_ * c);
    nearest_ = std::max(nearest_, c);
    farthest_ = std::min(farthest_, c);
  }
  /// For points that do not all coincide. With `at`, it looks there instead; `zoom` divides its distance.
  [[nodiscard]] FramingCamera camera(const std::optional<Vec3>& at, double zoom) const {
    // An eye at (x, y, z) sees a point (a, b, c) within the share if |a - x| <= slope_x (z - c) and |b - y|
    // <= slope_y (z - c): a + slope_x c <= x + slope_x z and -a + slope_x c <= -x + slope_x z. Added up, they
    // give the least z.
    const double x = (right_ - left_) / 2, y = (top_ - bottom_) / 2;
    const double z = std::max((right_ + left_) / (2 * slope_x_), (top_ + bottom_) / (2 * slope_y_));
    const double middle = nearest_ + (farthest_ - nearest_) / 2;
    const auto on_axis = [&](double depth) {
      return sum(sum(scaled(axes_.right, x), scaled(axes_.up, y)), scaled(axes_.back, depth));
    };
    FramingCamera camera;
    camera.eye = on_axis(z);
    camera.look = on_axis(middle);
    camera.up = axes_.up;
    camera.distance = z - middle;
    double eye_depth = z;
    if (at || zoom != 1) {
      if (at) camera.look = *at;
      camera.distance /= zoom;
      camera.eye = sum(camera.look, scaled(axes_.back, camera.distance));
      eye_depth = dot(camera.eye, axes_.back);
    }
    camera.far = (eye_depth - farthest_) + kDepthMargin * camera.distance;
    camera.near = std::max((eye_depth - nearest_) * kDepthMargin, camera.far / kMostDepth);
    return camera;
  }

 private:
  ViewAxes axes_;
  double slope_x_, slope_y_;
  // The largest a + slope c and -a + slope c of points (a, b, c), the same for b.
  double right_ = -kInfinity, left_ = -kInfinity, top_ = -kInfinity, bottom_ = -kInfinity;
  double nearest_ = -kInfinity, farthest_ = kInfinity;  // the largest and the smallest c
};

}  // namespace

SceneSetting framed_setting(const ImportedModel& model, const ViewChoice& view) {
  Framing framing(view_axes(view.up, view.azimuth_degrees, view.elevation_degrees), view.fov_y_degrees,
                  view.aspect, kShare);
  model.for_each_corner([&](const Vec3& p) { framing.add(p); });
  FramingCamera camera = framing.camera(view.at, view.zoom);
  if (std::fabs(view.elevation_degrees) <= kSteepestWithWorldUp) camera.up = unit_vector_of(view.up);
  if ((view.at || view.zoom != 1) && std::isfinite(camera.far) && !(camera.far > 0))
    throw std::runtime_error(model.name() + ": expected a point --at that has the model before the eye");
  if (!(camera.distance > 0) || !std::isfinite(camera.far) || !(camera.near > 0))
    throw std::runtime_error(model.name() +
                             ": expected a model with an extent, found all vertices in one point, or farther "
                             "apart than numbers go");
  return setting_with(camera, view.fov_y_degrees, view.aspect, model);
}

SceneSetting setting_of_file(const ImportedModel& model, double aspect) {
  const ModelCamera& of_file = *model.camera();
  FramingCamera camera;
  camera.eye = of_file.eye;
  camera.up = unit_vector(of_file.up);
  camera.near = of_file.near;
  camera.far = of_file.far;
  // A file says in which direction it looks, not how far; the middle of the model is what a light is to fall
  // on.
  Vec3 total;
  double count = 0;
  model.for_each_corner([&](const Vec3& p) {
    total = sum(total, p);
    ++count;
  });
  const Vec3 direction = unit_vector(difference(of_file.look, of_file.eye));
  const double ahead = dot(difference(scaled(total, 1 / count), of_file.eye), direction);
  camera.distance = ahead > of_file.near ? ahead : of_file.near;
  camera.look = sum(camera.eye, scaled(direction, camera.distance));
  return setting_with(camera, of_file.fov_y_degrees, aspect, model);
}

double shown_share(const ImportedModel& model, const SceneSetting& setting) {
  const FramingCamera& camera = setting.camera;
  const ViewAxes axes = axes_of(camera);
  const double slope_y = tangent(setting.fov_y_degrees / 2), slope_x = setting.aspect * slope_y;
  std::array<Vec3, 3> corners;
  std::size_t count = 0;
  double area = 0;
  model.for_each_corner([&](const Vec3& p) {
    const Vec3 offset = difference(p, camera.eye);
    const double depth = -dot(offset, axes.back);
    // In NDC; a corner that is not in the view's depth spoils its triangle.
    const bool is_seen = depth >= camera.near && depth <= camera.far;
    corners[count++] = is_seen ? Vec3{dot(offset, axes.right) / (slope_x * depth),
                                      dot(offset, axes.up) / (slope_y * depth), 0}
                               : Vec3{NAN, NAN, NAN};
    if (count < 3) return;
    count = 0;
    const auto& [a, b, c] = corners;
    const double width = std::min(std::max({a.x, b.x, c.x}), 1.0) - std::max(std::min({a.x, b.x, c.x}), -1.0);
    const double height =
        std::min(std::max({a.y, b.y, c.y}), 1.0) - std::max(std::min({a.y, b.y, c.y}), -1.0);
    if (width > 0 && height > 0)
      area += std::min(std::fabs(cross(difference(b, a), difference(c, a)).z) / 2, width * height);
  });
  return area / 4 / 2;  // of the window, which is 2 by 2; a body has two sides
}

}  // namespace pipeline
