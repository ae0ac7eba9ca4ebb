// cut-scene: cuts a scene into parts, for model on several machines. A scene in, scenes out.

#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "libpipeline/scene/scene_cutter.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/output_file.h"
#include "tools/rim/tool.h"

using namespace pipeline;

namespace {

constexpr int kMaxParts = 99999;

/// The size of a regular file, which decides where to cut it.
std::size_t size_of(const InputFile& scene) {
  struct stat status = {};
  if (::fstat(scene.descriptor(), &status) != 0 || !S_ISREG(status.st_mode))
    throw UsageError("SCENE", "a file, whose size tells where to cut", "a pipe or a device");
  return static_cast<std::size_t>(status.st_size);
}

void make_empty_folder(const std::string& path) {
  std::error_code error;
  std::vector<std::filesystem::path> missing;
  for (std::filesystem::path folder = path; !folder.empty() && !std::filesystem::exists(folder, error);
       folder = folder.parent_path())
    missing.push_back(folder);
  for (; !missing.empty(); missing.pop_back()) add_unfinished(missing.back());
  std::filesystem::create_directories(path, error);
  const bool is_empty = !error && std::filesystem::is_empty(path, error);
  if (error) throw IoError("open", path, error.value());
  if (!is_empty) throw InputError({path}, "a new folder, or an empty one", "one with files in it");
}

/// The name of a part. All have the same length, so that a shell lists them in order.
std::string name_of_part(std::size_t part, std::size_t part_count) {
  const std::string number = std::to_string(part);
  return std::string(std::to_string(part_count).size() - number.size(), '0') + number + ".txt";
}

std::uint64_t part_count_of(const std::string& word) {
  std::uint64_t part_count = 0;
  if (!parse_count(word, part_count) || part_count < 1 || part_count > kMaxParts)
    throw UsageError("PARTS", "a whole number from 1 to " + std::to_string(kMaxParts),
                     pipeline::quoted(word));
  return part_count;
}

/// Writes a part that ends near `end`, and its line of the list.
void write_part(Tool& tool, SceneCutter& cutter, const std::string& path, std::size_t end) {
  add_unfinished(path);
  OutputFile file(path);
  TextWriter text(file.descriptor(), path);
  const std::uint64_t first = cutter.next_number();
  cutter.begin(text);
  if (cutter.has_triangle()) cutter.copy(text, end);
  text.append("end\n");
  text.flush();
  file.commit();
  tool.output().append(path + " " + std::to_string(first) + "\n");
  tool.timing().triangle_count = cutter.next_number();
}

void cut(Tool& tool, const std::string& scene_path, std::uint64_t part_count, const std::string& folder) {
  InputFile scene(scene_path);
  const double size = static_cast<double>(size_of(scene));
  expect_kind(scene.text(), TextKind::scene);
  SceneCutter cutter(scene.text());
  make_empty_folder(folder);
  for (std::size_t k = 1, part = 1; part == 1 || cutter.has_triangle(); ++k) {
    // A part may have passed the end of the next one.
    const auto end =
        static_cast<std::size_t>(size * static_cast<double>(k) / static_cast<double>(part_count));
    if (k < part_count && cutter.position() >= end && cutter.has_triangle()) continue;
    write_part(tool, cutter, folder + "/" + name_of_part(part, part_count), end);
    ++part;
  }
}

}  // namespace

int cut_scene_main(int argc, char** argv) {
  Tool tool({"cut-scene",
             "Cuts a scene into scenes of about the same size, to be drawn in parallel. Prints the file of "
             "each and the number of its first triangle, for model --first.",
             "The scene",
             {"cut-scene scene.txt 2", "cut-scene scene.txt 8 -o parts > list.txt"}},
            OutputKind::other_text);
  std::string scene_path, part_count_word, folder = "parts";
  tool.take_own_operands();
  tool.options().set_usage("Usage: cut-scene [OPTIONS] SCENE PARTS");
  tool.options().add_operand("SCENE", scene_path, "The scene, a file");
  tool.options().add_operand("PARTS", part_count_word,
                             "The largest number of parts; each has a triangle if the scene has one");
  tool.options().begin_group("Output");
  tool.options().add_word("-o,--output", "FOLDER", folder,
                          "Where the parts go, a new folder or an empty one");

  // A closed pipe is a failure to write like any other: the parts must be removed.
  std::signal(SIGPIPE, SIG_IGN);

  return tool.run(argc, argv, [&] {
    if (!tool.options().is_given("PARTS"))
      throw UsageError(expected_but_found("operands SCENE and PARTS", "fewer"));
    const std::uint64_t part_count = part_count_of(part_count_word);
    tool.expect_separate({kStandardOutput}, {file_or_stream("SCENE", scene_path, kStandardInput)});
    cut(tool, scene_path, part_count, folder);
    tool.close_output();
    keep_unfinished();
  });
}
