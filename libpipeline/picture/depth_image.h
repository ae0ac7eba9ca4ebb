#pragma once

#include <memory>
#include <string>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// An InputError unless the file's extension, in upper or lower case, names a format of depth images: .pgm
/// (Netpbm P5) or, where can_write_png(), .png, both with 16 bits of gray. A device's name (/dev/stdout) gets
/// PGM.
void check_depth_image_name(const std::string& path);

/// A writer of depths (NDC z) as brightness: 65535 at the front limit, 0 at the rear limit and where nothing
/// is seen, linear in between, rounded to the nearest integer, halves up. `path` chooses the format.
std::unique_ptr<RowWriter<double>> depth_image_writer(int descriptor, const std::string& path,
                                                      const Viewport& screen);

}  // namespace pipeline
