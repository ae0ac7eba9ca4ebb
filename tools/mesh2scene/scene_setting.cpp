#include "tools/mesh2scene/scene_setting.h"

#include <cmath>
#include <stdexcept>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

/// How much of the picture's width or height a framed model fills.
constexpr double kShare = 0.9;

/// Up to here above or below the model, the world's axis serves as the camera's `up`: a reader knows it at
/// sight, and it gives the same view. Nearer to the axis, what rounding does to the eye would turn the
/// picture.
constexpr double kSteepestWithWorldUp = 85;

/// A light that shines from afar stands so many times as far away as the eye.
constexpr double kFar = 1000;

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
  return setting;
}

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

}  // namespace pipeline
