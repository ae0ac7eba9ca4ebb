#pragma once

#include <string>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/stage_writer.h"
#include "tests/text/text_input.h"

namespace pipeline {

/// All triangles of a text in one batch.
inline TriangleBatch triangles_from(int descriptor) {
  TextReader text(descriptor, "in.txt");
  StageReader reader(text);
  TriangleBatch all;
  for (TriangleBatch batch; reader.read(batch);)
    for (std::size_t i = 0; i < batch.size(); ++i)
      all.add(batch.triangles[i], batch.numbers[i], batch.locations[i]);
  return all;
}

inline TriangleBatch triangles_of(const std::string& text) {
  return triangles_from(TextFile(text).descriptor());
}

/// The text of a batch.
inline std::string written(const TriangleBatch& batch, NumberFormat format = {}, bool bare = false,
                           const StageHeader& header = {}) {
  const TextFile file("");
  TextWriter text(file.descriptor(), "out.txt");
  StageWriter writer(text, format, bare);
  writer.write_header(header);
  writer.write(batch);
  writer.finish();
  return file.whole_text();
}

/// The text written from everything that a reader reads.
inline std::string copy_of(const std::string& text, NumberFormat format = kShortest, bool bare = false) {
  const TextFile in(text), out("");
  TextReader reader(in.descriptor(), "in.txt");
  TextWriter writer(out.descriptor(), "out.txt");
  StageReader stage(reader);
  stage.accept_spheres();
  StageWriter copy(writer, format, bare);
  copy.write_header(stage.header());
  for (TriangleBatch batch; stage.read(batch);) copy.write(batch);
  copy.finish();
  return out.whole_text();
}

}  // namespace pipeline
