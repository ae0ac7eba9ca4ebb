#pragma once

#include <optional>
#include <string>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/text/output_file.h"
#include "libpipeline/text/text_writer.h"
#include "tools/zbuf/triangle_store.h"

namespace pipeline {

/// The file of `--seen`: a stage text of the triangles that are seen. `commit` moves it to its name.
class SeenFile {
 public:
  /// `path` is "-" for `standard_output`.
  SeenFile(TextWriter& standard_output, const std::string& path);

  /// Writes the text: the header as it was read, and the triangles of the store that are seen.
  void write(const StageReader& reader, const TriangleStore& store, KeptIds& seen);
  void close();
  void commit();

 private:
  std::optional<OutputFile> file_;
  std::optional<TextWriter> text_of_file_;
  TextWriter& text_;
};

}  // namespace pipeline
