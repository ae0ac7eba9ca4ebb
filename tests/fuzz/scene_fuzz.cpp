// The scene parser and the model stage: any text gives triangles or a mistake with its place.

#include "libpipeline/model_stage.h"
#include "libpipeline/model_transform.h"
#include "libpipeline/scene.h"
#include "libpipeline/stage_writer.h"
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
      apply_pending_transforms(batch, rounder);
    } catch (const InputError&) {  // an overflow; what comes before it is written, as by the tools
      writer.write(batch);
      throw;
    }
    writer.write(batch);
  }
  writer.finish();
}

}  // namespace
}  // namespace pipeline

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pipeline::transcript({reinterpret_cast<const char*>(data), size}, pipeline::model);
  return 0;
}
