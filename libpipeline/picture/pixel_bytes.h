#pragma once

namespace pipeline {

/// How the pixels of a row become bytes: red, green and blue; these and an alpha (PNG only); or 16 bits of
/// gray, the high byte first.
enum class PixelBytes { rgb8, rgba8, gray16 };

}  // namespace pipeline
