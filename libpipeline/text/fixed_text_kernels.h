#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "libpipeline/text/fixed_text.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define PIPELINE_HAS_X86_KERNELS
#endif

namespace pipeline {

// The kernels of fixed_text.h, each in a file of its own.

/// The line that belongs to a triangle besides its three vertex lines.
enum class TriangleFrame {
  stage_text,  // a blank line after them
  scene        // the line `triangle` before them
};

/// The beginning of the vertex lines; null if the line before them is missing.
template <TriangleFrame frame>
const char* vertex_lines(const char* p) {
  if constexpr (frame == TriangleFrame::stage_text) return p;
  constexpr std::string_view kLine = "triangle\n";
  return std::string_view(p, kLine.size()) == kLine ? p + kLine.size() : nullptr;
}

/// Numbers are read and printed as whole numbers of units of 10^-7.
constexpr double kUnitsPerOne = 1e7;

extern const FixedTextKernel kPortableKernel;

#ifdef PIPELINE_HAS_X86_KERNELS
/// Sixteen bytes starting at byte n form a shuffle mask that moves a register's bytes to the front by n and
/// fills the end with zeros.
struct ByteShifts {
  alignas(16) std::array<std::uint8_t, 32> bytes{};
  constexpr ByteShifts() {
    for (unsigned i = 0; i < 32; ++i) bytes[i] = static_cast<std::uint8_t>(i < 16 ? i : 0x80);
  }
};

inline constexpr ByteShifts kByteShifts;

extern const FixedTextKernel kSse4Kernel;
bool processor_has_sse4();
// Reading gains nothing from wider registers: where a number begins depends on the one before it.
extern const WriteFixedText kWriteFixedTextAvx2;
bool processor_has_avx2();
#endif

}  // namespace pipeline
