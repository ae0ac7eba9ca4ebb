#include "libpipeline/vertex/projected_header.h"

namespace pipeline {

StageHeader projected_header(const StageHeader& p_view, const Located<Projection>& given,
                             const ProjectionTransform& projection) {
  StageHeader header = {.framed = p_view.framed, .camera = {}, .appearance = p_view.appearance};
  if (header.appearance.attributes) header.appearance.attributes->value.w = true;
  if (!header.appearance.lights.empty()) header.projected = {volume_of(given, projection), given.location};
  return header;
}

}  // namespace pipeline
