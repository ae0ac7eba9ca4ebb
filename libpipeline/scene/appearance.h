#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/header_line.h"
#include "libpipeline/scene/vertex_attributes.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// A point light. Each stage transforms its position: model space in a scene, world space after `model`, view
/// space after `view`.
struct Light {
  Vec3 position;
  Vec3 intensity;  // red, green, blue, each at least 0; 1 is full intensity
};

/// The reflection of light by a surface: the coefficients of ambient, diffuse and specular reflection, each
/// at least 0, and the exponent of the specular highlight. Only ray tracing uses the other values.
struct Material {
  double ambient = 1;
  double diffuse = 1;
  double specular = 0;
  std::uint64_t shininess = 1;
  double reflectance = 0;          // the mirrored part of the light, from 0 to 1
  double index = 1;                // of refraction, from 0.01 to 100
  double alpha = 1;                // the opaque part, from 0 (clear) to 1
  Vec3 absorption = {};            // inside, per unit length of view space: r, g, b, each at least 0
  std::optional<Vec3> paint = {};  // the color of triangles without their own: r, g, b from 0 to 255

  /// True if rays go on from the surface.
  [[nodiscard]] bool sends_rays() const { return reflectance != 0 || alpha != 1; }
};

/// Scales a light at distance d, in view space, by 1 / (constant + linear d + quadratic d^2). All three are
/// at least 0, and at least one is above 0.
struct Attenuation {
  double constant = 1;
  double linear = 0;
  double quadratic = 0;

  /// The part of the light that is left after this way.
  [[nodiscard]] double part_left(const Vec3& way) const {
    const double squared = way.x * way.x + way.y * way.y + way.z * way.z;
    return 1 / (constant + linear * std::sqrt(squared) + quadratic * squared);
  }
  [[nodiscard]] bool weakens() const { return constant > 1 || linear != 0 || quadratic != 0; }
};

/// The color of a pixel without a triangle.
struct Background {
  Vec3 color;          // red, green, blue from 0 to 255
  double alpha = 255;  // from 0, invisible, to 255, opaque
};

/// The color and light of a scene or of a stage text's header: each part that is given, with the location of
/// its arguments; nullopt for a part that is not. A plain scene sets none.
struct Appearance {
  std::optional<Located<AttributeSet>> attributes;
  std::optional<Located<Background>> background;
  std::optional<Located<Vec3>> ambient;                       // intensities, each at least 0
  std::vector<Located<Material>> materials;                   // numbered from 0
  std::optional<SourceLocation> last_absorption, last_paint;  // the last material's, if given
  std::optional<Located<Attenuation>> attenuation;
  std::vector<Located<Light>> lights;

  /// The columns of the vertex lines besides x y z.
  [[nodiscard]] AttributeSet columns() const { return attributes ? attributes->value : AttributeSet{}; }
  /// True if triangles have the colors of their materials: a material has a paint, and no column has colors.
  [[nodiscard]] bool is_painted() const {
    return !columns().color && std::ranges::any_of(materials, [](const auto& material) {
      return material.value.paint.has_value();
    });
  }
};

/// Where a line `attributes` stands. In a scene it may not name w, which `project` adds, nor material.
enum class AttributeSource { scene, stage_text };

/// Reads the arguments of a setting (scene_commands.h), to the end of the line, and adds them to
/// `appearance`. An InputError if a number is missing or out of range, and, at `keyword_location`, if the
/// part was given before; only lights and materials may repeat, and each material may have one absorption and
/// one paint.
void read_appearance_part(std::string_view keyword, const SourceLocation& keyword_location, LineScanner& line,
                          AttributeSource source, Appearance& appearance);

/// Throws an InputError, at the line `attributes`, if the text has the column w: it is projected already.
void expect_no_w(const Appearance& appearance);

}  // namespace pipeline
