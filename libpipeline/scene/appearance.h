#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/header_line.h"
#include "libpipeline/scene/vertex_attributes.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// A point that shines in all directions; an intensity of 1 a channel is full light.
struct Light {
  Vec3 position;
  Vec3 intensity;
};

/// How much of the light a surface gives back: factors of the ambient, diffuse and specular parts, and the
/// whole exponent of the specular one.
struct Material {
  double ambient = 1;
  double diffuse = 1;
  double specular = 0;
  std::size_t shininess = 1;
};

/// A light at distance d counts 1 / (constant + linear d + quadratic d^2).
struct Attenuation {
  double constant = 1;
  double linear = 0;
  double quadratic = 0;
};

/// What a scene or a stage text's header says of color and light, as far as it says it. A plain one says
/// nothing.
struct Appearance {
  std::optional<Located<AttributeSet>> attributes;
  std::optional<Located<Vec3>> background;  // red, green, blue from 0 to 255
  std::optional<Located<Vec3>> ambient;     // intensities
  std::optional<Located<Material>> material;
  std::optional<Located<Attenuation>> attenuation;
  std::vector<Located<Light>> lights;

  /// The columns of the vertex lines.
  [[nodiscard]] AttributeSet columns() const { return attributes ? attributes->value : AttributeSet{}; }
};

/// Who writes `attributes`: a scene may not ask for w, which is made by a projection.
enum class AttributeSource { scene, stage_text };

/// True for `attributes`, `background`, `ambient`, `material`, `attenuation` and `light`.
bool is_appearance_keyword(std::string_view keyword);

/// Reads what follows such a keyword, to the end of the line, and adds it to `appearance`. An InputError if
/// it is out of range, or there already (reported at `keyword_location`); only lights may be many.
void read_appearance_part(std::string_view keyword, const SourceLocation& keyword_location, LineScanner& line,
                          AttributeSource source, Appearance& appearance);

/// An InputError if the text has a column w, which only a projected text may have.
void expect_no_w(const Appearance& appearance);

}  // namespace pipeline
