#include "libpipeline/scene/appearance.h"

#include <cassert>

#include "libpipeline/scene/spelling.h"

namespace pipeline {
namespace {

double number_from_zero(LineScanner& line, std::string_view name, std::string_view of = {}) {
  return number_where(
      line, name, "of at least 0", [](double value) { return value >= 0; }, of);
}

Vec3 read_intensity(LineScanner& line, std::string_view of) {
  Vec3 intensity;
  intensity.x = number_from_zero(line, "the red of ", of);
  intensity.y = number_from_zero(line, "the green of ", of);
  intensity.z = number_from_zero(line, "the blue of ", of);
  line.expect_end("the blue of ", of);
  return intensity;
}

Background read_background(LineScanner& line) {
  Background background;
  background.color = read_color(line, "the background");
  if (!line.at_end())
    background.alpha = number_where(line, "the alpha of the background", "from 0 to 255",
                                    [](double value) { return value >= 0 && value <= 255; });
  line.expect_end("the alpha of the background");
  return background;
}

/// Takes the names of attributes to the end of the line: at least one, in the order of their columns.
AttributeSet read_attributes(LineScanner& line, AttributeSource source) {
  AttributeSet set;
  std::vector<std::string_view> names;
  std::string expected = "attributes of";
  const auto take = [&](std::string_view name, bool& is_there) {
    if (source == AttributeSource::scene && (name == kW.name || name == "material")) return;
    names.push_back(name);
    expected.append(" [").append(name).append("]");
    is_there = line.peek() == name;
    if (is_there) line.word();
  };
  for_each_attribute([&](const auto& attribute) { take(attribute.name, set.*attribute.is_there); });
  take("material", set.material);
  if (!set.any() || !line.at_end())
    line.fail(expected + ", in this order", spelling_hint(line.peek(), names));
  return set;
}

Material read_material(LineScanner& line) {
  Material material;
  material.ambient = number_from_zero(line, "the ambient factor");
  material.diffuse = number_from_zero(line, "the diffuse factor");
  material.specular = number_from_zero(line, "the specular factor");
  material.shininess = line.whole("the shininess, a whole number below 2^64");
  if (line.at_end()) return material;
  const auto is_part = [](double value) { return value >= 0 && value <= 1; };
  const auto is_index = [](double value) { return value >= 0.01 && value <= 100; };
  material.reflectance = number_where(line, "the reflectance", "from 0 to 1", is_part);
  material.index = number_where(line, "the refractive index", "from 0.01 to 100", is_index);
  material.alpha = number_where(line, "the alpha", "from 0 to 1", is_part);
  line.expect_end("the alpha");
  return material;
}

Attenuation read_attenuation(LineScanner& line) {
  const LineScanner at_first = line;
  Attenuation attenuation;
  attenuation.constant = number_from_zero(line, "the constant attenuation");
  attenuation.linear = number_from_zero(line, "the linear attenuation");
  attenuation.quadratic = number_from_zero(line, "the quadratic attenuation");
  line.expect_end("the quadratic attenuation");
  if (attenuation.constant == 0 && attenuation.linear == 0 && attenuation.quadratic == 0)
    throw InputError(at_first.location(), "an attenuation other than 0 0 0", "0 0 0");
  return attenuation;
}

Light read_light(LineScanner& line) {
  Light light;
  light.position = line.point("the light");
  light.intensity = read_intensity(line, "the light");
  return light;
}

}  // namespace

void read_appearance_part(std::string_view keyword, const SourceLocation& keyword_location, LineScanner& line,
                          AttributeSource source, Appearance& appearance) {
  const SourceLocation location = line.location();
  const auto set = [&](auto& part, auto&& read) {
    if (part) throw given_twice(quoted(keyword), part->location, keyword_location);
    part = {read(), location};
  };
  if (keyword == "attributes") {
    set(appearance.attributes, [&] { return read_attributes(line, source); });
  } else if (keyword == "background") {
    set(appearance.background, [&] { return read_background(line); });
  } else if (keyword == "ambient") {
    set(appearance.ambient, [&] { return read_intensity(line, "the ambient light"); });
  } else if (keyword == "material") {
    appearance.materials.push_back({read_material(line), location});
    appearance.last_absorption = appearance.last_paint = std::nullopt;
  } else if (keyword == "absorption" || keyword == "paint") {
    if (appearance.materials.empty())
      throw InputError(keyword_location, "'material' before " + quoted(keyword), "none");
    auto& last = keyword == "paint" ? appearance.last_paint : appearance.last_absorption;
    if (last) throw given_twice(quoted(keyword), *last, keyword_location);
    last = location;
    Material& material = appearance.materials.back().value;
    if (keyword == "absorption") {
      material.absorption = read_intensity(line, "the absorption");
    } else {
      material.paint = read_color(line, "the paint");
      line.expect_end("the blue of the paint");
    }
  } else if (keyword == "attenuation") {
    set(appearance.attenuation, [&] { return read_attenuation(line); });
  } else {
    assert(keyword == "light");
    appearance.lights.push_back({read_light(line), location});
  }
}

void expect_no_w(const Appearance& appearance) {
  if (appearance.columns().w)
    throw InputError(appearance.attributes->location, "a text that is not projected yet",
                     "one with the column 'w', which project adds");
}

}  // namespace pipeline
