#pragma once

#include "libpipeline/stream/stage_text.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// The header of a text once it is projected by `projection`, which comes from `given`: without a camera,
/// with w among the columns if there are any, and, if there are lights, with the view volume. An InputError
/// at `given.location` if a plane of the volume is beyond a double's range.
StageHeader projected_header(const StageHeader& p_view, const Located<Projection>& given,
                             const ProjectionTransform& projection);

}  // namespace pipeline
