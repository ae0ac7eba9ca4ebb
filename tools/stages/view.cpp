// view: puts the camera at the origin, looking down -z. World space in, view space out.

#include <algorithm>
#include <cmath>

#include "libpipeline/scene/spelling.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/vertex/attribute_transform.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_transform.h"
#include "tools/rim/command_line.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/stages/stage_loop.h"
#include "tools/stages/stage_options.h"

using namespace pipeline;

namespace {

constexpr ToolDescription kDescription = {
    "view",
    "Reads triangles in world space and writes them in view space.",
    "The output of model (or stage1.txt)",
    {"model scene.txt | view --eye 4 3 9 | project | zbuf config.txt > z_buffer.txt",
     "view --bare --scene scene.txt stage1.txt > stage2.txt"},
    "--light-at --precision --perspective --frustum --ortho"};

/// The view transform of a camera, which needs all three parts.
ViewTransform view_of(const CameraParameters& camera, const StageReader& reader) {
  std::vector<std::string_view> missing;
  if (!camera.eye) missing.emplace_back("eye");
  if (!camera.look) missing.emplace_back("look");
  if (!camera.up) missing.emplace_back("up");
  if (!missing.empty())
    throw InputError(reader.header_end(),
                     "a camera (header lines eye, look and up; or --scene; or --eye, --look and --up)",
                     "no " + listed(missing) + (missing.size() == 3 ? reason_without_camera(reader) : ""));
  return view_from_world(camera.eye->value, camera.look->value, camera.up->value);
}

/// At least the sum of the |entries| of any row of the rotation.
double row_sum(const ViewTransform& view) {
  const auto sum = [](const BallVec3& row) {
    return (row.x.magnitude() + row.y.magnitude() + row.z.magnitude()) * ErrorBound::kRoundUp;
  };
  return std::max({sum(view.right), sum(view.up), sum(view.backward)});
}

/// The bounds of a text in world space, after the rotation and the rounding.
Bounds bounds_in_view(const Located<Bounds>& world, const ViewTransform& view, const ErrorBound& rounding) {
  const ErrorBound error = error_in_view(world.value.error, view.eye, row_sum(view), rounding);
  if (!std::isfinite(error.absolute) || !std::isfinite(error.relative))
    throw InputError(world.location, "bounds that stay finite in view space", "larger ones");
  return {error, {}, "view"};
}

/// The text's color and light, with the lights of the command line, in view space.
Appearance in_view_space(Appearance appearance, const LightOption& lights, const ViewTransform& view,
                         UncertainDigits& uncertain_lights) {
  lights.apply_to(appearance);
  for (auto& light : appearance.lights) light = transformed(view, light, uncertain_lights);
  return appearance;
}

}  // namespace

int view_main(int argc, char** argv) {
  Tool tool(kDescription, OutputKind::stage_text);
  NumberOptions numbers(tool.options());
  CameraOptions cameras(tool.options(), CameraOptions::Parts::position_and_projection);
  const LightOption light(tool.options());
  bool bare = false;
  tool.options().begin_group("Output");
  tool.options().add_flag("--bare", bare, "Write the triangles alone (stage2.txt)");
  Statistics statistics(tool.options());

  return tool.run(argc, argv, [&] {
    if (bare && !light.name().empty())
      throw UsageError(expected_but_found("--bare or " + light.name(), "both"));
    tool.expect_separate({kStandardOutput, statistics.output()}, {cameras.scene()});
    expect_kind(tool.input(), TextKind::world);
    StageReader reader(tool.input());
    expect_header(reader, TextKind::world);
    if (!bare && !reader.header().bounds) reader.accept_spheres();
    const CameraParameters camera = cameras.camera(reader.header().camera, tool);
    const ViewTransform view = view_of(camera, reader);
    const VertexTransform to_view(view);
    const NormalTransform normal_to_view(view);
    StageWriter writer(tool.output(), numbers.format(), bare);
    UncertainDigits uncertain_lights;
    StageHeader header = {reader.header().framed,
                          {{}, {}, {}, camera.projection},  // later stages need no position
                          in_view_space(reader.header().appearance, light, view, uncertain_lights)};
    CoordinateRounder rounder = numbers.rounder(tool.input().file());
    if (const auto& world = reader.header().bounds; world && !bare)
      header.bounds = {bounds_in_view(*world, view, numbers.kept_bounds(rounder)), {}};
    writer.write_header(header);
    const auto transform = [&](TriangleBatch& batch) {
      normal_to_view.apply(batch.attributes, 0, batch.size());
      to_view.apply(batch, rounder);
    };
    StageLoop loop(tool, writer, rounder, statistics);
    loop.run(reader, transform, uncertain_lights);
    loop.note_if_no_triangle_came();
    loop.write_statistics(numbers.format());
  });
}
