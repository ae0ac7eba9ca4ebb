#pragma once

#include <memory>
#include <string>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// Throws an InputError unless the file's extension, in upper or lower case, names a format of depth images:
/// .pgm (Netpbm P5) or, if can_write_png(), .png, both with 16 bits of gray. A device's name (/dev/stdout)
/// gets PGM.
void check_depth_image_name(const std::string& path);

/// A writer of depths (NDC z) as brightness: 65535 at the front limit, 0 at the rear limit and at pixels
/// without a triangle, linear between, rounded to the nearest integer, halves up. `path` chooses the format.
std::unique_ptr<RowWriter<double>> depth_image_writer(int descriptor, const std::string& path,
                                                      const Viewport& screen);

/// Throws an InputError unless the file is a device or has the extension .npy, in upper or lower case.
void check_array_name(const std::string& path);

/// A writer of doubles or of std::int64_t: an array of NumPy's format 1.0 (its page numpy.lib.format).
template <typename Number>
std::unique_ptr<RowWriter<Number>> array_writer(int descriptor, const std::string& path,
                                                const Viewport& screen);

}  // namespace pipeline
