// The scene parser and the model stage: any text gives triangles or an error at its location.

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/vertex/model_stage.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/transcript.h"

namespace pipeline {
namespace {

void model(TextReader& text, TextWriter& output) {
  constexpr NumberFormat kExact = {.decimals = 7, .shortest = true};
  SceneReader scene(text);
  CoordinateRounder rounder(Precision::extended, kExact, text.file());
  ModelStage stage(scene);
  StageWriter writer(output, kExact, false);
  writer.write_header({false, scene.camera(), stage.appearance()});
  for (TriangleBatch batch; stage.read(batch);) {
    try {
      stage.transform(batch, rounder);
    } catch (const InputError&) {  // an overflow; the triangles before it are written, as in the tools
      writer.write(batch);
      throw;
    }
    writer.write(batch);
  }
  writer.finish();
}

}  // namespace

void check(FuzzBytes bytes) {
  transcript(bytes.rest(), model);
}

}  // namespace pipeline
