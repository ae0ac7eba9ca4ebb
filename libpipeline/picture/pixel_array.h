#pragma once

#include <memory>
#include <string>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// An InputError unless the file's extension is .npy, in upper or lower case, or the file a device.
void check_array_name(const std::string& path);

/// A writer of doubles or of std::int64_t: an array of NumPy's format 1.0 (its page numpy.lib.format).
template <typename Number>
std::unique_ptr<RowWriter<Number>> array_writer(int descriptor, const std::string& path,
                                                const Viewport& screen);

}  // namespace pipeline
