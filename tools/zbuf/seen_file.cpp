#include "tools/zbuf/seen_file.h"

namespace pipeline {
namespace {

/// Opens the file, if it is one; the writer of it, or else of standard output.
TextWriter& opened(const std::string& path, std::optional<OutputFile>& file,
                   std::optional<TextWriter>& text_of_file, TextWriter& standard_output) {
  if (path == "-") return standard_output;
  file.emplace(path);
  return text_of_file.emplace(file->descriptor(), path);
}

}  // namespace

SeenFile::SeenFile(TextWriter& standard_output, const std::string& path)
    : text_(opened(path, file_, text_of_file_, standard_output)) {}

void SeenFile::write(const StageReader& reader, const TriangleStore& store, KeptIds& seen) {
  text_.append(reader.header_text());
  store.write_texts(text_, seen);
  if (reader.header().framed) text_.append("end\n");
  text_.flush();
}

void SeenFile::close() {
  if (file_) file_->close();
}

void SeenFile::commit() {
  if (file_) file_->commit();
}

}  // namespace pipeline
