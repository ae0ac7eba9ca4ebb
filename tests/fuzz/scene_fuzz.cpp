// The scene parser and the model stage: any text gives triangles or a mistake with its place, and the same if
// it is read by parts.

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/vertex/model_stage.h"
#include "libpipeline/vertex/model_transform.h"
#include "tests/fuzz/transcript.h"
#include "tests/stream/by_parts.h"

namespace pipeline {
namespace {

template <typename Source>
void write_all(Source& source, CoordinateRounder& rounder, StageWriter& writer) {
  for (TriangleBatch batch; source.read(batch);) {
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

enum class Reading { in_order, by_parts };

void model(TextReader& text, TextWriter& output, Reading reading) {
  constexpr std::size_t kPartSize = 100;
  constexpr NumberFormat kExact = {.decimals = 7, .shortest = true};
  SceneReader scene(text);
  CoordinateRounder rounder(Precision::extended, kExact, text.file());
  ModelStage stage(scene);
  StageWriter writer(output, kExact, false);
  writer.write_header({false, scene.camera(), stage.appearance()});
  if (reading == Reading::in_order) return write_all(stage, rounder, writer);
  ByParts parts(stage, kPartSize);
  write_all(parts, rounder, writer);
}

void check(std::string_view text) {
  const auto by = [](Reading reading) -> Work {
    return [=](TextReader& reader, TextWriter& writer) { model(reader, writer, reading); };
  };
  const Transcript in_order = transcript(text, by(Reading::in_order));
  require(transcript(text, by(Reading::by_parts)) == in_order, "parts change nothing");
}

}  // namespace
}  // namespace pipeline

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pipeline::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
