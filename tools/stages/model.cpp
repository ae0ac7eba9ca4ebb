// model: carries out the commands of a scene. Model space in, world space out.

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/vertex/model_stage.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/stages/stage_loop.h"
#include "tools/stages/stage_options.h"

using namespace pipeline;

namespace {

/// The argument of --facets; none if it is not given.
std::optional<std::size_t> belt_count(const std::string& given) {
  if (given.empty()) return std::nullopt;
  std::uint64_t count = 0;
  if (!parse_count(given, count) || count < SphereFacets::kMinBelts || count > SphereFacets::kMaxBelts)
    throw UsageError("--facets: " + expected_but_found("a whole number from 2 to 10000", quoted(given)));
  return static_cast<std::size_t>(count);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"model",
             "Reads a scene and writes its triangles in world space, with the camera in the header.",
             "The scene (scene.txt)",
             {"model scene.txt | view | project | zbuf config.txt > z_buffer.txt",
              "model --bare scene.txt > stage1.txt"}},
            OutputKind::stage_text);
  NumberOptions numbers(tool.options());
  bool bare = false;
  bool framed = false;
  tool.options().begin_group("Output");
  tool.options().add_flag("--bare", bare, "Write the triangles alone (stage1.txt)");
  tool.options().add_flag("--framed", framed,
                          "Write 'framed' and 'end' around the text, so that a truncated text is noticed");
  std::string first;
  tool.options().add_word(
      "--first", "N", first,
      "Number the triangles from N on: of a part of a scene (cut-scene), so that joined texts of "
      "parts are that of the whole (default: 0)");
  std::string belts;
  tool.options().add_word(
      "--facets", "N", belts,
      "Make triangles with normals of every sphere: N belts of 2 N facets; all other triangles "
      "get normals, too");
  Statistics statistics(tool.options());

  return tool.run(argc, argv, [&] {
    tool.expect_separate({kStandardOutput, statistics.output()});
    if (bare && framed) throw UsageError(expected_but_found("--bare or --framed", "both"));
    std::uint64_t first_number = 0;
    if (!first.empty() && !parse_count(first, first_number))
      throw UsageError("--first: " + expected_but_found("a whole number", pipeline::quoted(first)));
    if (bare && first_number > 0)
      throw UsageError("--first: " + expected_but_found("no --bare, which writes no numbers", "both"));
    expect_kind(tool.input(), TextKind::scene);
    SceneReader scene(tool.input());
    ModelStage stage(scene, first_number, {.is_refused = bare && belts.empty(), .belts = belt_count(belts)});
    StageWriter writer(tool.output(), numbers.format(), bare);
    writer.write_header({framed, scene.camera(), stage.appearance()});

    CoordinateRounder rounder = numbers.rounder(tool.input().file());
    const auto transform = [&](TriangleBatch& batch) { stage.transform(batch, rounder); };
    StageLoop loop(tool, writer, rounder, statistics);
    loop.run(stage, transform, stage.uncertain_lights());
    if (const auto note = bright_light_note(stage.appearance())) tool.note(*note);
    const std::uint64_t count = tool.timing().triangle_count;
    if (first.empty())  // a part of a scene has its pops, and what its transforms move, in other parts
      for (const std::string& note : stage.odd_transforms().notes(tool.input().file(), count > 0))
        tool.note(note);
    if (count == 0 || stage.flattening_scale()) tool.note(empty_scene_note(count, stage.flattening_scale()));
    loop.write_statistics(numbers.format());
  });
}
