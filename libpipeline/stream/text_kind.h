#pragma once

#include <string>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

// A text in the wrong place is refused by its name: a scene given to view, or the output of model given to
// project. Texts without a header, which any stage may have written, are accepted as is.

/// The texts that tools read, in the order of the pipe, and texts that none of them reads.
enum class TextKind {
  scene,
  world,  // the output of model
  view,   // the output of view
  ndc,    // the output of project
  config,
  triangles,      // without a header, so of any stage
  editor_screen,  // what Vim's `view` writes into a pipe
  model_file,     // OBJ, PLY, STL or glTF, which mesh2scene reads
  unknown
};

/// The kind of `text` by its first lines, of which nothing is consumed.
TextKind kind_of(TextReader& text);

/// An InputError if the first lines of `text`, of which nothing is consumed, are plainly of another
/// kind than `expected`. Waits for the first line only.
void expect_kind(TextReader& text, TextKind expected);

/// An InputError if the header of a stage text shows that the stages up to `expected` have not all been run,
/// or that a later one has been.
void expect_header(const StageReader& reader, TextKind expected);

/// The end of the message on a header that lacks the camera or the projection that `view` or `project` needs:
/// why it may be missing.
std::string reason_without_camera(const StageReader& reader);

}  // namespace pipeline
