// The reader and the writer of stage text: any text gives triangles or an error at its location, and the
// written text reads back as the same. Both also hold if threads parse the text ahead.

#include "libpipeline/stream/read_ahead.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/stage_writer.h"
#include "tests/fuzz/transcript.h"

namespace pipeline {
namespace {

template <typename Source>
void write_all(Source& source, StageWriter& writer) {
  for (TriangleBatch batch; source.read(batch);) writer.write(batch);
  writer.finish();
}

enum class Reading { in_order, ahead };

void copy(TextReader& text, TextWriter& output, NumberFormat format, Reading reading) {
  constexpr std::size_t kPartSize = 200;  // two triangles
  static ThreadPool pool(2);
  StageReader reader(text, true);
  reader.accept_spheres();
  StageWriter writer(output, format, false);
  writer.write_header(reader.header());
  if (reading == Reading::in_order) return write_all(reader, writer);
  ReadAhead ahead(reader, pool, kPartSize);
  write_all(ahead, writer);
}

void check(std::string_view text, NumberFormat format) {
  const auto by = [&](Reading reading) -> Work {
    return [=](TextReader& reader, TextWriter& writer) { copy(reader, writer, format, reading); };
  };
  const Work work = by(Reading::in_order);
  const Transcript once = transcript(text, work);
  require(transcript(text, by(Reading::ahead)) == once, "threads change nothing");
  if (!once.mistake.empty()) return;
  const Transcript twice = transcript(once.written, work);
  require(twice.mistake.empty(), "what is written can be read");
  require(twice.written == once.written, "a copy of a copy is the copy");
}

}  // namespace
}  // namespace pipeline

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  pipeline::check(text, {.decimals = 7, .shortest = false});
  pipeline::check(text, {.decimals = 7, .shortest = true});
  return 0;
}
