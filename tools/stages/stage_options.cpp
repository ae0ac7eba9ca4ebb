#include "tools/stages/stage_options.h"

#include <variant>

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// The words as a line, followed by the characters that a LineScanner needs after it.
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text.append(kDecimalNumberSlack, ' ');
}

void add_light(const std::string& option, const std::vector<std::string>& words, Appearance& appearance) {
  const std::string text = joined(words);
  LineScanner line(text, option, 0);
  read_appearance_part("light", {option}, line, AttributeSource::stage_text, appearance);
}

}  // namespace

NumberOptions::NumberOptions(CommandLine& options) {
  const auto is_fine = [](const std::string& text) {
    std::uint64_t count = 0;
    return text == "exact" || (parse_count(text, count) && count <= kMaxDecimals);
  };
  options.begin_group("Numbers");
  options.add_word("--digits", "N|exact", digits_,
                   "Decimals of a coordinate, 0 to 17, or exact: as many as a double needs",
                   expects("a number of decimals from 0 to 17, or exact", is_fine));
  options.add_choice<Precision>(
      "--precision", precision_, {{"double", Precision::in_doubles}, {"extended", Precision::extended}},
      "extended: printed coordinates are correctly rounded, or a note says where not; double: faster");
}

NumberFormat NumberOptions::format() const {
  std::uint64_t decimals = 0;
  if (!parse_count(digits_, decimals)) return {.shortest = true};
  return {.decimals = static_cast<int>(decimals)};
}

CoordinateRounder NumberOptions::rounder(const std::string& file) const {
  return {precision_, format(), file};
}

ErrorBound NumberOptions::kept_bounds(CoordinateRounder& rounder) const {
  if (precision_ == Precision::in_doubles)
    throw UsageError("--precision", "extended, as bounds need it", "'double'");
  rounder.keep_bounds();
  return rounding_error(format());
}

CameraOptions::CameraOptions(CommandLine& options, Parts parts) {
  const auto add = [&](const std::string& name, std::size_t count, const std::string& type,
                       const std::string& help) { options.add_words(name, count, type, words_[name], help); };
  options.begin_group(parts == Parts::projection ? "Projection" : "Camera");
  if (parts == Parts::position_and_projection) {
    add("--eye", 3, "X Y Z", "The position of the camera, in world space");
    add("--look", 3, "X Y Z", "The point it looks at");
    add("--up", 3, "X Y Z", "The direction that is up in the picture");
  }
  const std::string planes = "L R B T N F";
  add("--perspective", 4, "FOVY ASPECT NEAR FAR", "The projection, as in a scene; angles in degrees");
  add("--frustum", 6, planes,
      "A perspective given by its planes left, right, bottom, top, near, far, as for glFrustum");
  add("--ortho", 6, planes, "A parallel projection between such planes, as for glOrtho");
  options.add_word(
      "--scene", "FILE", scene_path_,
      "Take the camera from this scene instead of the header of INPUT; other options override it");
}

CameraParameters CameraOptions::camera(const CameraParameters& header, const Tool& tool) const {
  CameraParameters camera;
  for (const auto& [name, words] : words_) {
    if (words.empty()) continue;
    const std::string text = joined(words);
    LineScanner line(text, name, 0);
    read_camera_part(name.substr(2), {name}, line, camera);
  }
  if (!scene_path_.empty()) {
    // The camera precedes the commands, which are not read.
    InputFile scene = tool.second_input(scene_path_, "--scene");
    expect_kind(scene.text(), TextKind::scene);
    camera = merged(camera, SceneReader(scene.text()).camera());
  }
  camera = merged(camera, header);
  check_camera(camera);
  return camera;
}

LightOption::LightOption(CommandLine& options) {
  options.begin_group("Light");
  options.add_words("--light", 6, "X Y Z R G B", words_,
                    "Add a light at a point in world space; R G B is its intensity, 1 1 1 full and white");
  options.add_words("--light-at", 4, "N X Y Z", at_,
                    "Move light N of the scene, counted from 0, to a point in world space");
}

void LightOption::apply_to(Appearance& appearance) const {
  if (!at_.empty()) {
    const std::size_t count = appearance.lights.size();
    std::uint64_t number = 0;
    if (!parse_count(at_[0], number) || number >= count)
      throw UsageError("--light-at",
                       count == 0   ? "a scene with a light"
                       : count == 1 ? "0, the scene's one light"
                                    : "a light from 0 to " + std::to_string(count - 1),
                       pipeline::quoted(at_[0]));
    Appearance moved;
    add_light("--light-at", {at_[1], at_[2], at_[3], "0", "0", "0"}, moved);
    appearance.lights[number].value.position = moved.lights[0].value.position;
  }
  if (!words_.empty()) add_light("--light", words_, appearance);
}

ProjectionOptions::ProjectionOptions(CommandLine& options)
    : camera_(options, CameraOptions::Parts::projection) {
  options.add_choice<std::optional<AspectRule>>(
      "--aspect", aspect_, {{"angle", AspectRule::angle}, {"ratio", AspectRule::ratio}},
      "The meaning of a perspective's aspect.\n"
      "angle: fovX = fovY * aspect\n"
      "ratio: width / height, as in gluPerspective\n"
      "(default: the word at the end of the perspective, else angle)");
}

Located<Projection> ProjectionOptions::projection(const StageReader& reader, const Tool& tool) const {
  const CameraParameters camera = camera_.camera(reader.header().camera, tool);
  if (!camera.projection)
    throw InputError(reader.header_end(),
                     "a projection (a header line perspective, frustum or ortho; or --scene; or "
                     "--perspective, --frustum or --ortho)",
                     "none" + reason_without_camera(reader));
  Located<Projection> projection = *camera.projection;
  if (auto* perspective = std::get_if<Perspective>(&projection.value); perspective != nullptr && aspect_)
    perspective->aspect_rule = *aspect_;
  return projection;
}

}  // namespace pipeline
