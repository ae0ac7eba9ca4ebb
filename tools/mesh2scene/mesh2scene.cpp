// mesh2scene: a model file (OBJ, STL, PLY, glTF, ...) in, a scene with camera and lights out.

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <optional>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/config.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"
#include "tools/mesh2scene/readers.h"
#include "tools/mesh2scene/scene_setting.h"
#include "tools/rim/tool.h"

using namespace pipeline;

namespace {

constexpr Vec3 kY = {0, 1, 0}, kZ = {0, 0, 1};
const std::vector<std::pair<std::string, std::optional<Vec3>>> kAxes = {
    {"x", {{1, 0, 0}}},   {"y", kY},           {"z", kZ}, {"-x", {{-1, 0, 0}}},
    {"-y", {{0, -1, 0}}}, {"-z", {{0, 0, -1}}}};

struct Options {
  std::string size = "800x600";
  std::vector<std::string> eye_from, at;
  std::string color;
  double crease_degrees = 40;
  bool as_nodes = false;
  int most_megabytes = 1000;
  std::vector<std::string> written;
  std::optional<Vec3> up;
  ViewChoice view;
};

void add_options(CommandLine& options, Options& chosen) {
  options.add_whole("--max-input", chosen.most_megabytes, 1, 1'000'000,
                    "Read at most this many megabytes, in the model and the files that it names");
  options.add_repeatable("--writes", "FILE", chosen.written, "Refuse a model that refers to FILE");
  options.begin_group("Camera");
  options.add_word("--size", "WIDTHxHEIGHT", chosen.size, "The size of the picture, for its aspect",
                   expects("WIDTHxHEIGHT in pixels, such as 800x600", parse_size));
  options.add_words(
      "--eye-from", 2, "AZIMUTH ELEVATION", chosen.eye_from,
      "Look at the model from this many degrees to the right of its front, and above it (default: 30 15)");
  options.add_number(
      "--fov", "DEGREES", chosen.view.fov_y_degrees, [](double value) { return value >= 1 && value <= 120; },
      "1 to 120", "The angle of view from the picture's bottom to its top");
  options.add_choice("--up-axis", chosen.up, kAxes,
                     "The axis that is up in the picture (default: z for STL, else y)");
  options.add_words("--at", 3, "X Y Z", chosen.at,
                    "Look at this point, in the model's coordinates, in place of its middle");
  options.add_number(
      "--zoom", "F", chosen.view.zoom, [](double value) { return value >= 0.01 && value <= 1000; },
      "0.01 to 1000", "Bring the eye nearer by this factor");
  options.begin_group("Triangles");
  options.add_word("--color", "RRGGBB", chosen.color,
                   "The color of everything, six hexadecimal digits, in place of the model's colors",
                   expects("RRGGBB, hexadecimal digits", [](const std::string& word) {
                     return parse_color(word).value_or(Color().with_alpha(0)).is_opaque();
                   }));
  options.add_number(
      "--crease", "DEGREES", chosen.crease_degrees, [](double value) { return value >= 0 && value <= 175; },
      "0 to 175", "Where the file has no normals: an edge stays sharp if its sides turn by more than this");
  options.add_flag("--nodes", chosen.as_nodes,
                   "Write the transforms of the model's nodes as push, translate, rotate, scale and pop");
}

/// One of the numbers of an option that takes several.
double number_from(const std::string& option, const std::string& word, double least, double most) {
  const std::string range = "a number from " + shortest_text(least) + " to " + shortest_text(most);
  const ParsedNumber number = parse_number(word);
  if (number.error != NumberError::none || !(number.value >= least && number.value <= most))
    throw UsageError(option, range, pipeline::quoted(word));
  return number.value;
}

/// "it reaches from X Y Z to X Y Z (--at looks elsewhere, --zoom closer)", with four digits.
std::string extent_of(const Model& model) {
  BoundingBox box;
  model.for_each_corner([&](const Vec3& p) { box.add(Triangle{p, p, p}); });
  const auto& [low, high] = box;
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "it reaches from %.4g %.4g %.4g to %.4g %.4g %.4g", low.x, low.y,
                low.z, high.x, high.y, high.z);
  return std::string(text.data()) + " (--at looks elsewhere, --zoom closer)";
}

/// The options' view of a model. Most programs that write STL are for objects to be printed or built, where z
/// is up.
ViewChoice view_of(const Options& chosen, const Model& model) {
  ViewChoice view = chosen.view;
  view.up = chosen.up.value_or(model.format == "STL" ? kZ : kY);
  if (!chosen.eye_from.empty()) {
    view.azimuth_degrees = number_from("--eye-from AZIMUTH", chosen.eye_from[0], -360, 360);
    view.elevation_degrees = number_from("--eye-from ELEVATION", chosen.eye_from[1], -90, 90);
  }
  if (!chosen.at.empty()) {
    constexpr double kMost = std::numeric_limits<float>::max();  // of a scene's coordinates
    const auto number = [&](std::size_t i) { return number_from("--at", chosen.at[i], -kMost, kMost); };
    view.at = {number(0), number(1), number(2)};
  }
  const Viewport screen = *parse_size(chosen.size);
  view.aspect = double(screen.columns) / double(screen.rows);
  return view;
}

/// Notes a picture that will show next to nothing.
void note_what_hides(const Model& model, const SceneSetting& setting, bool is_files_camera,
                     const Options& chosen, const Tool& tool) {
  constexpr double kLittle = 0.01;
  const double share = shown_share(model, setting);
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.2g %% of the picture", 100 * share);
  const std::string covered = text.data();
  if (share < kLittle && is_files_camera)
    tool.note(model.name + ": its own camera " +
              (share == 0 ? "does not show it" : "shows it on " + covered) + ": --eye-from 30 15 frames it");
  else if (share > 0 && share < kLittle && chosen.at.empty() && chosen.view.zoom == 1)
    tool.note(model.name + ": it covers " + covered +
              ": parts of it lie far from each other, or it is thin; --at and --zoom look closer");
  if (chosen.color.empty() && model.is_black())
    tool.note(model.name + ": all of it is black: --color gives it another color");
}

}  // namespace

int mesh2scene_main(int argc, char** argv) {
  Tool tool({"mesh2scene",
             "Turns a model file into a scene: camera, lights, and triangles with normals. Reads OBJ, STL, "
             "PLY and glTF.",
             "The model file, which may name regular files in or below its folder",
             {"mesh2scene bunny.obj > scene.txt",
              "mesh2scene --up-axis z part.obj | model | view | project | zbuf --size 800x600"},
             "--crease --nodes --max-input --writes"},
            OutputKind::other_text);
  Options chosen;
  add_options(tool.options(), chosen);

  return tool.run(argc, argv, [&] {
    tool.expect_separate({kStandardOutput});
    const std::string& path = tool.input_path();
    // Never destroyed: freeing it would keep the next stage waiting for the end of the scene.
    static ModelFiles& files = *new ModelFiles(path, chosen.most_megabytes, chosen.written);
    static Model& model = *new Model(read_model(path, files, chosen.crease_degrees));
    tool.timing().lap(&Timing::read_seconds);
    tool.timing().triangle_count = model.triangle_count();
    const ViewChoice view = view_of(chosen, model);
    const bool has_own_view =
        model.camera && std::ranges::none_of(std::array{"--eye-from", "--fov", "--up-axis", "--at", "--zoom"},
                                             [&](auto option) { return tool.options().is_given(option); });
    SceneSetting setting = has_own_view ? setting_of_file(model, view.aspect) : framed_setting(model, view);
    if (!has_own_view && !chosen.up && model.format != "glTF")
      tool.note(std::string(view.up == kY ? "y" : "z") + " is taken for up, as in most " + model.format +
                " files (--up-axis chooses); " + extent_of(model));
    for (const std::string& note : model.notes) tool.note(note);
    if (const auto& parts = model.unheld; !parts.empty())
      tool.note(model.name + ": no scene can hold its " + listed({parts.begin(), parts.end()}));
    note_what_hides(model, setting, has_own_view, chosen, tool);
    if (!chosen.color.empty()) setting.color = to_vec3(*parse_color(chosen.color));
    setting.comment = model.name + ", " + counted(model.triangle_count(), "triangle") +
                      ", by mesh2scene; zbuf --size " + chosen.size;
    if (!write_scene(model, setting, chosen.as_nodes, tool.output()))
      tool.note(model.name + ": it has more than " + counted(kMostMaterials, "material") +
                "; meshes with further ones get the first");
  });
}
