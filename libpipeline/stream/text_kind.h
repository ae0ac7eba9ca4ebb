#pragma once

#include <string>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

// An error names a text in the wrong place: a scene given to view, or the output of model given to project.
// Where a stage's text is expected, one without a header is accepted: any stage may have written it.

/// The texts that tools read, in the order of the pipe, and some that they do not.
enum class TextKind {
  scene,
  world,  // the output of model
  view,   // the output of view
  ndc,    // the output of project
  config,
  triangles,      // without a header, so from any stage
  editor_screen,  // the output of Vim's `view` into a pipe
  model_file,     // OBJ, PLY, STL or glTF, which mesh2scene reads
  unknown
};

/// The kind of `text` by its first lines, which are not consumed.
TextKind kind_of(TextReader& text);

/// Throws an InputError if the first lines of `text` plainly belong to another kind than `expected`. Consumes
/// nothing, and waits for the first line only.
void expect_kind(TextReader& text, TextKind expected);

/// Throws an InputError if the header of a stage text shows that a stage up to `expected` has not been run,
/// or that a later one has.
void expect_header(const StageReader& reader, TextKind expected);

/// The end of the message about a header without the camera or projection that `view` or `project` needs: why
/// it may be missing.
std::string reason_without_camera(const StageReader& reader);

}  // namespace pipeline
