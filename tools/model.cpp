// model: carries out the commands of a scene. Model space in, world space out.

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/vertex/model_stage.h"
#include "tools/stage_loop.h"
#include "tools/stage_options.h"
#include "tools/tool.h"

using namespace pipeline;

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

  return tool.run(argc, argv, [&] {
    if (bare && framed) throw UsageError(expected_but_found("--bare or --framed", "both"));
    expect_kind(tool.input(), TextKind::scene);
    SceneReader scene(tool.input());
    ModelStage stage(scene);
    StageWriter writer(tool.output(), numbers.format(), bare);
    writer.write_header({framed, scene.camera(), stage.appearance()});

    CoordinateRounder rounder = numbers.rounder(tool.input().file());
    const auto transform = [&](TriangleBatch& batch) { stage.transform(batch, rounder); };
    StageLoop(tool, writer, rounder).run(stage, transform, stage.uncertain_lights());
  });
}
