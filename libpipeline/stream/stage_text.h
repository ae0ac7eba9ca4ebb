#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libpipeline/scene/appearance.h"
#include "libpipeline/scene/camera.h"
#include "libpipeline/scene/header_line.h"
#include "libpipeline/stream/bounds.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

// Stage text flows in the pipes between the tools:
//
//   header lines   before the first triangle: a keyword and its numbers, each at most once except material,
//                  absorption, paint and light:
//                    framed | eye X Y Z | look X Y Z | up X Y Z |
//                    perspective FOVY ASPECT NEAR FAR | frustum L R B T N F | ortho L R B T N F |
//                    projected frustum L R B T N F | projected ortho L R B T N F |
//                    bounds world|view A R | bounds ndc A R B S (bounds.h) |
//                    attributes [w] [color] [normal] [material] | background R G B [A] | ambient R G B |
//                    material AMBIENT DIFFUSE SPECULAR SHININESS [REFLECTANCE INDEX ALPHA] (any number,
//                    numbered from 0) | absorption R G B | paint R G B (of the material above, at most
//                    once each) |
//                    attenuation CONSTANT LINEAR QUADRATIC | light X Y Z R G B (any number)
//   triangle N     optional: the next triangle is triangle N of the scene; counting goes on from there
//   clipped        optional, in projected texts with lights: three vertex lines in clip space (X Y Z W and
//                  the other columns) follow; the next triangles of its number are pieces of this one
//   sphere         optional: a sphere, which counts as a triangle, follows: four vertex lines without normals
//                  (the center and the ends of three half axes), then a blank line
//   X Y Z          three vertex lines, then a blank line; after the position, the columns that `attributes`
//                  names, in this order: W, R G B (0 to 255), NX NY NZ, the number of the material, which is
//                  equal on the three lines
//   error ...      the message of an earlier stage that failed, as it printed it on stderr; nothing follows
//   end            the last line of a framed text
//
// Comments (from # to the end of the line) and blank lines may stand anywhere, but no blank line inside a
// triangle.

/// The header of a stage text: the settings that later stages still need.
struct StageHeader {
  bool framed = false;
  CameraParameters camera;  // for stages that have not been run yet
  Appearance appearance = {};
  std::optional<Located<Projection>> projected = {};  // by `project`: a Frustum or an Orthographic
  std::optional<Located<Bounds>> bounds = {};
  std::vector<Located<std::string>> camera_lines = {};  // the keywords that set `camera` and `projected`
};

/// The last line of a failed stage's output: "error tool: message".
inline std::string error_line(const std::string& reason) {
  return "error " + on_one_line(reason) + "\n";
}

/// The text ends with a line `error`. `reason()` is its content: "tool: message" of the failed stage.
class EarlierFailure : public InputError {
 public:
  EarlierFailure(const SourceLocation& location, const std::string& reason)
      : InputError(location, told(reason)), reason_(reason) {}
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// "tool failed"; the whole reason if it does not name a tool.
  [[nodiscard]] std::string in_short() const {
    const std::string tool = reason_.substr(0, reason_.find(':'));
    const bool is_named =
        !tool.empty() && tool.size() < reason_.size() && tool.find(' ') == std::string::npos;
    return is_named ? tool + " failed" : told(reason_);
  }

 private:
  static std::string told(const std::string& reason) {
    return "an earlier stage failed" + (reason.empty() ? ", without saying why" : ": " + reason);
  }

  std::string reason_;
};

/// The failure that an `error` line reports; `line` stands at the word `error`.
inline EarlierFailure earlier_failure(LineScanner line) {
  const SourceLocation location = line.location();
  line.word();
  return {location, std::string(line.rest_with_comment())};
}

}  // namespace pipeline
