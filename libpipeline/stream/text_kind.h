#pragma once

#include <string>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

// A text in the wrong place is refused by its name: a scene given to view, or the output of model given to
// project. Texts without a header, which any stage may have written, are taken as they read.

/// The texts that tools read, in the order of the pipe, and those that none of them reads.
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

/// An InputError if the first lines of `text`, of which nothing is consumed, are plainly those of another
/// kind than `expected`. Waits for the first line of the text alone.
void expect_kind(TextReader& text, TextKind expected);

/// An InputError if the header of a stage text shows that the stages up to `expected` have not all been run,
/// or that a later one has been.
void expect_header(const StageReader& reader, TextKind expected);

/// What a header without the camera that `view` needs, or the projection that `project` needs, says of its
/// text: the end of the message that complains.
std::string reason_without_camera(const StageReader& reader);

}  // namespace pipeline
