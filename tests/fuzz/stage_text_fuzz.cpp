// The reader and the writer of stage text: any text gives triangles or an error at its location, and the
// written text reads back as the same.

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/stage_writer.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/transcript.h"

namespace pipeline {
namespace {

void copy(TextReader& text, TextWriter& output, NumberFormat format) {
  StageReader reader(text, true);
  reader.accept_spheres();
  StageWriter writer(output, format, false);
  writer.write_header(reader.header());
  for (TriangleBatch batch; reader.read(batch);) writer.write(batch);
  writer.finish();
}

void check_copies(std::string_view text, NumberFormat format) {
  const Work work = [=](TextReader& reader, TextWriter& writer) { copy(reader, writer, format); };
  const Transcript once = transcript(text, work);
  if (!once.mistake.empty()) return;
  const Transcript twice = transcript(once.written, work);
  require(twice.mistake.empty(), "what is written can be read");
  require(twice.written == once.written, "a copy of a copy is the copy");
}

}  // namespace

void check(FuzzBytes bytes) {
  check_copies(bytes.rest(), {.decimals = 7, .shortest = false});
  check_copies(bytes.rest(), {.decimals = 7, .shortest = true});
}

}  // namespace pipeline
