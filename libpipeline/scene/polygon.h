#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// Appends the triangles of a polygon of three or more vertices, which may be concave and need not quite be
/// flat: three indices for each, counted from 0. Ears are cut off one after the other (G. Meisters, Polygons
/// have ears, 1975); a non-simple polygon ends as a fan. False if it would take minutes.
[[nodiscard]] bool append_triangles(std::span<const Vec3> polygon, std::vector<std::uint32_t>& indices);

/// The cure for a polygon that would take minutes.
constexpr const char* kPolygon = "a simpler polygon, or one of fewer corners";

/// Appends the triangles of a strip, every other one reversed, or of a fan: three of its items for each.
/// Triangles with two equal corners, which join strips, are left out.
void append_strip(std::span<const std::uint32_t> strip, bool is_fan, std::vector<std::uint32_t>& corners);

}  // namespace pipeline
