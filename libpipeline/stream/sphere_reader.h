#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "libpipeline/scene/vertex_attributes.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// Reads the spheres of a stage text's body.
class SphereReader {
 public:
  /// `columns` come from the header; numbers of materials have to be less than `material_count`.
  SphereReader(TextReader& text, const AttributeSet& columns, std::size_t material_count);

  /// Adds the sphere whose first line, `sphere`, is `line`; with `keeps_text`, its text, too. An InputError
  /// at the word that is wrong.
  void read(LineScanner& line, std::uint64_t number, bool keeps_text, TriangleBatch& batch);

 private:
  TextReader& text_;
  AttributeSet columns_;
  VertexLineReader point_line_;  // of all columns but the normal
  std::array<std::string, 4> names_;
};

/// The error of a reader that has no use for a sphere.
InputError refused_sphere(const SourceLocation& location);

}  // namespace pipeline
