#pragma once

#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/transform.h"
#include "tools/rim/empty_picture_note.h"

namespace pipeline {

/// Adds the places of a batch's spheres in view space, for a note if no ray meets one.
void add_places(const TriangleBatch& p_view, const ProjectionTransform& projection, const Viewport& screen,
                UnseenSpheres& spheres);

}  // namespace pipeline
