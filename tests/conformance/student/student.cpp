// A pipeline as a student of the course writes it: stages 1 to 4 in plain doubles, right unless it is told to
// make a mistake. It is what the conformance pack and the judge are tried on.

#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/conformance/student/stages.h"
#include "tests/conformance/student/switches.h"

namespace {

constexpr const char* kUsage =
    R"(usage: student model|view|project [--bare] [--scene SCENE] [SWITCH...] < text > text
       student zbuf CONFIG [--folder DIR] [SWITCH...] < stage3.txt
       student all SCENE CONFIG --folder DIR [SWITCH...]
       student switches

model, view and project read what the stage before wrote, and write a header with as much of the camera as
later stages need; with --bare, nothing but triangles. With --scene, the camera is that of a scene, as in the
assignment.
zbuf writes the depths to standard output and out.bmp into the current folder; with --folder, z_buffer.txt and
out.bmp into that folder. `all` does what the assignment asks for: stage1.txt, stage2.txt, stage3.txt,
z_buffer.txt and out.bmp.
`switches` lists all names for SWITCH, which is

  --mistake STAGE/NAME   a mistake of tests/conformance/mistakes.txt to make
  --habit STAGE/NAME     something of tests/conformance/habits.txt that is no mistake
)";

struct UsageError {};

struct Arguments {
  std::vector<std::string> operands;
  std::string scene, folder;
  bool is_bare = false;
};

Arguments arguments_of(const std::vector<std::string>& words) {
  Arguments result;
  for (std::size_t i = 0; i < words.size(); i++) {
    const bool has_value = i + 1 < words.size();
    if (words[i] == "--bare") {
      result.is_bare = true;
    } else if (words[i] == "--scene" && has_value) {
      result.scene = words[++i];
    } else if (words[i] == "--folder" && has_value) {
      result.folder = words[++i];
    } else if ((words[i] == "--mistake" || words[i] == "--habit") && has_value) {
      if (!switch_on(words[++i])) throw UsageError();
    } else if (words[i].substr(0, 1) == "-") {
      throw UsageError();
    } else {
      result.operands.push_back(words[i]);
    }
  }
  return result;
}

std::ifstream opened(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  return file;
}

Scene read_scene(std::istream& text) {
  Scene scene;
  scene.camera = read_camera(text);
  scene.triangles = model(text);
  return scene;
}

/// Stages 2 and 3: the triangles of the stage before, with the camera from their header or from --scene.
Scene read_stage(const Arguments& arguments) {
  Scene scene;
  if (!arguments.scene.empty()) {
    std::ifstream file = opened(arguments.scene);
    scene.camera = read_camera(file);
  }
  read_stage(std::cin, scene);
  return scene;
}

void write_picture(const std::string& folder, const Picture& picture) {
  const bool has_other_names = habit("zbuf/other-file-names");
  std::ofstream depths(folder + (has_other_names ? "/z-buffer.txt" : "/z_buffer.txt"));
  write_depths(depths, picture);
  if (!depths.flush()) throw std::runtime_error("cannot write the depths");
  write_bitmap(folder + (has_other_names ? "/output.bmp" : "/out.bmp"), picture);
}

/// What a program that reads the written stage has: its numbers, as they were printed.
void hand_on(const std::string& folder, const std::string& name, Scene& scene) {
  {
    std::ofstream file(folder + "/" + name);
    write_stage(file, scene, Header::kNone);
    if (!file.flush()) throw std::runtime_error("cannot write " + name);
  }
  if (habit("all/exact-in-memory")) return;
  std::ifstream file = opened(folder + "/" + name);
  scene.triangles.clear();
  read_stage(file, scene);
}

void run_all(const Arguments& arguments) {
  if (arguments.operands.size() != 3 || arguments.folder.empty()) throw UsageError();
  std::ifstream file = opened(arguments.operands[1]);
  const Config config = read_config(arguments.operands[2]);
  Scene scene = read_scene(file);
  hand_on(arguments.folder, "stage1.txt", scene);
  scene.triangles = view(scene.triangles, scene.camera);
  hand_on(arguments.folder, "stage2.txt", scene);
  scene.triangles = project(scene.triangles, scene.camera);
  hand_on(arguments.folder, "stage3.txt", scene);
  write_picture(arguments.folder, draw(scene.triangles, config));
}

void run(const Arguments& arguments) {
  const std::string stage = arguments.operands.empty() ? "" : arguments.operands[0];
  const std::size_t operand_count = arguments.operands.size();
  const auto header = [&](Header full) { return arguments.is_bare ? Header::kNone : full; };
  if (stage == "all") return run_all(arguments);
  if (stage == "switches" && operand_count == 1) return print_switches();
  if (stage == "zbuf" && operand_count == 2) {
    Scene scene;
    read_stage(std::cin, scene);
    const Picture picture = draw(scene.triangles, read_config(arguments.operands[1]));
    if (!arguments.folder.empty()) return write_picture(arguments.folder, picture);
    write_depths(std::cout, picture);
    return write_bitmap("out.bmp", picture);
  }
  if (operand_count != 1) throw UsageError();
  if (stage == "model") return write_stage(std::cout, read_scene(std::cin), header(Header::kCamera));
  if (stage != "view" && stage != "project") throw UsageError();
  Scene scene = read_stage(arguments);
  const bool is_view = stage == "view";
  const Camera& camera = scene.camera;
  if (is_view ? camera.eye.empty() || camera.look.empty() || camera.up.empty() : camera.numbers.empty())
    throw std::runtime_error("no camera");
  scene.triangles = is_view ? view(scene.triangles, scene.camera) : project(scene.triangles, scene.camera);
  write_stage(std::cout, scene, header(is_view ? Header::kProjection : Header::kNone));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(arguments_of({argv + 1, argv + argc}));
  } catch (const UsageError&) {
    std::cerr << kUsage;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "student: " << error.what() << '\n';
    return 1;
  }
  return std::cout.flush() ? 0 : 1;
}
