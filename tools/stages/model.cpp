// model: carries out the commands of a scene. Model space in, world space out.

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/vertex/model_stage.h"
#include "tools/rim/command_line.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/stages/stage_loop.h"
#include "tools/stages/stage_options.h"

using namespace pipeline;

namespace {

constexpr ToolDescription kModelDescription = {
    "model",
    "Reads a scene and writes its triangles in world space, with the camera in the header.",
    "The scene (scene.txt)",
    {"model scene.txt | view | project | zbuf config.txt > z_buffer.txt",
     "model --bare scene.txt > stage1.txt"},
    "--precision --bounds --first --facets"};

struct ModelOptions {
  bool bare = false;
  bool framed = false;
  std::string first;  // the number of the first triangle; empty: 0
  bool bounds = false;
  std::string belts;  // of a sphere's facets; empty: spheres stay spheres
};

void add_options(CommandLine& options, ModelOptions& chosen) {
  options.begin_group("Output");
  options.add_flag("--bare", chosen.bare, "Write the triangles alone (stage1.txt)");
  options.add_flag("--framed", chosen.framed,
                   "Write 'framed' and 'end' around the text, so that later stages notice a truncated one");
  options.add_flag("--bounds", chosen.bounds,
                   "Write a bound on the error of the coordinates to the header, for zbuf --certify");
  options.add_word("--first", "N", chosen.first,
                   "Number triangles from N on, for a part of a scene (cut-scene) to be joined with "
                   "others (default: 0)");
  options.add_word("--facets", "N", chosen.belts,
                   "Turn every sphere into 4 N (N - 1) triangles, in N belts; all triangles get normals");
}

std::uint64_t first_number(const ModelOptions& chosen) {
  if (chosen.bare && chosen.framed) throw UsageError(expected_but_found("--bare or --framed", "both"));
  std::uint64_t number = 0;
  if (!chosen.first.empty() && !parse_count(chosen.first, number))
    throw UsageError("--first", "a whole number", quoted(chosen.first));
  if (chosen.bare && number > 0) throw UsageError("--first", "no --bare, which writes no numbers", "both");
  return number;
}

/// The argument of --facets; none if it is not given.
std::optional<std::size_t> belt_count(const std::string& given) {
  if (given.empty()) return std::nullopt;
  std::uint64_t count = 0;
  if (!parse_count(given, count) || count < SphereFacets::kMinBelts || count > SphereFacets::kMaxBelts)
    throw UsageError("--facets", "a whole number from 2 to 10000", quoted(given));
  return static_cast<std::size_t>(count);
}

/// Notes a scene that is correct, but perhaps not as intended.
void note_odd_scene(const Tool& tool, const ModelStage& stage, const ModelOptions& chosen,
                    const std::string& file, std::uint64_t triangle_count) {
  if (const auto note = bright_light_note(stage.appearance())) tool.note(*note);
  if (chosen.first.empty())  // a part may have its pops and its transforms' objects in other parts
    for (const std::string& note : stage.odd_transforms().notes(file, triangle_count > 0)) tool.note(note);
  if (triangle_count == 0 || stage.flattening_scale())
    tool.note(empty_scene_note(triangle_count, stage.flattening_scale()));
}

}  // namespace

int model_main(int argc, char** argv) {
  Tool tool(kModelDescription, OutputKind::stage_text);
  NumberOptions numbers(tool.options());
  ModelOptions chosen;
  add_options(tool.options(), chosen);
  Statistics statistics(tool.options());

  return tool.run(argc, argv, [&] {
    tool.expect_separate({kStandardOutput, statistics.output()});
    const std::uint64_t first = first_number(chosen);
    if (chosen.bounds && (chosen.bare || !chosen.belts.empty()))
      throw UsageError("--bounds", "neither --bare nor --facets with it",
                       chosen.bare ? "--bare" : "--facets");
    expect_kind(tool.input(), TextKind::scene);
    SceneReader scene(tool.input());
    ModelStage stage(scene, first,
                     {.is_refused = (chosen.bare && chosen.belts.empty()) || chosen.bounds,
                      .belts = belt_count(chosen.belts)});
    StageWriter writer(tool.output(), numbers.format(), chosen.bare);
    StageHeader header = {chosen.framed, scene.camera(), stage.appearance()};
    CoordinateRounder rounder = numbers.rounder(tool.input().file());
    if (chosen.bounds) header.bounds = {{numbers.kept_bounds(rounder), {}}, {}};
    writer.write_header(header);

    const auto transform = [&](TriangleBatch& batch) { stage.transform(batch, rounder); };
    StageLoop loop(tool, writer, rounder, statistics);
    loop.run(stage, transform, stage.uncertain_lights());
    note_odd_scene(tool, stage, chosen, tool.input().file(), tool.timing().triangle_count);
    loop.write_statistics(numbers.format());
  });
}
