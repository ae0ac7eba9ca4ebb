#include "tools/zbuf/picture_options.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <thread>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/picture/pixel_files.h"
#include "libpipeline/scene/config.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/error.h"
#include "tools/zbuf/surface_shading.h"

namespace pipeline {
namespace {

/// The name of an image, with a dash replaced by /dev/stdout, to which OutputFile writes directly.
std::string named_standard_output(const std::string& image) {
  return image_file_of(image) == "-" ? image.substr(0, image.size() - 1) + "/dev/stdout" : image;
}

}  // namespace

PictureOptions::PictureOptions(CommandLine& options, const std::string& tool, bool has_seen) {
  options.set_usage("Usage: " + tool + " [OPTIONS] CONFIG [INPUT]\n       " + tool +
                    " [OPTIONS] --size WIDTHxHEIGHT [CONFIG] [INPUT]");
  options.add_operand("CONFIG", config_path,
                      "The screen (config.txt): WIDTH HEIGHT in pixels; optionally three more lines: the "
                      "left limit of x, the bottom limit of y, the front and rear limits of z");
  options.begin_group("Output");
  options.add_word(
      "--size", "WIDTHxHEIGHT", size,
      "The screen's size, overriding CONFIG; without CONFIG, limits are -1 and 1, and a single operand is "
      "INPUT",
      expects("WIDTHxHEIGHT in pixels, such as 400x300", parse_size));
  add_outputs(options, has_seen);
}

void PictureOptions::add_outputs(CommandLine& options, bool has_seen) {
  options.add_word(
      "-o,--image", "FILE", image_path,
      "The image, a " + listed(image_extensions()) +
          " file, or png:FILE for any name; - (PPM) and png:- go to standard output, without depths "
          "(default: out.bmp" +
          (has_seen ? "; none with --seen)" : ")"),
      [](const std::string& name) { return wrong_with_name(check_image_name)(named_standard_output(name)); });
  options.add_word(
      "--z-buffer", "FILE", z_buffer_path,
      std::string("The depths; none discards them (./none is a file) (default: -, standard output; none "
                  "with -o -") +
          (has_seen ? ", with --seen and on a terminal)" : " and on a terminal)"));
  options.add_word(
      "--depth-image", "FILE", depth_image_path,
      "Also write the depths as a 16-bit image, .pgm or .png, white at the front limit, black at the "
      "rear one",
      wrong_with_name(check_depth_image_name));
  options.add_word("--depth-array", "FILE", depth_array_path,
                   "Also write the depths as doubles, a .npy file for numpy.load; nan where no triangle is",
                   wrong_with_name(check_array_name));
  options.add_word("--triangle-array", "FILE", triangle_array_path,
                   "Also write the number of each pixel's triangle, a .npy file; -1 where no triangle is",
                   wrong_with_name(check_array_name));
}

void PictureOptions::add_shading(CommandLine& options) {
  options.add_choice<std::optional<ShadingModel>>(
      "--shading", shading,
      {{"none", ShadingModel::none},
       {"flat", ShadingModel::flat},
       {"gouraud", ShadingModel::gouraud},
       {"phong", ShadingModel::phong}},
      "Where surfaces are lit: nowhere, once per triangle, at its vertices, or at every pixel (default: "
      "phong with lights and normals, flat with lights alone, else none)");
}

void PictureOptions::add_background(CommandLine& options) {
  options.add_word("--background", "RRGGBB[AA]", background,
                   "The color of pixels without a triangle, in hexadecimal digits, in place of the scene's "
                   "(default: black). AA is its alpha, 00 (invisible) to ff (opaque), below ff for PNG only",
                   expects("RRGGBB or RRGGBBAA, hexadecimal digits", parse_color));
}

void PictureOptions::add_framed(CommandLine& options) {
  options.add_flag("--expect-framed", framed,
                   "Refuse a text without the frame of model --framed: a stage may have been killed");
}

void PictureOptions::complete(bool is_terminal, bool writes_seen) {
  const bool image_is_output = image_file_of(image_path) == "-";
  if (image_is_output && z_buffer_path == "-")
    throw UsageError("--z-buffer", "a file or none, as the image is standard output", "'-'");
  if (image_path.empty() && !writes_seen) image_path = "out.bmp";
  image_path = named_standard_output(image_path);
  if (z_buffer_path.empty()) {
    const bool is_wanted = !image_is_output && !writes_seen;
    summarizes = is_terminal && is_wanted;
    z_buffer_path = is_terminal || !is_wanted ? "none" : "-";
  }
  if (const auto color = parse_color(background);
      color && !color->is_opaque() && has_image() && !can_hold_alpha(image_path))
    throw UsageError("--background: " + refused_background(*color));
  if (sample_count > 1 && !(depth_array_path.empty() && triangle_array_path.empty()))
    throw UsageError(depth_array_path.empty() ? "--triangle-array" : "--depth-array", "--samples 1 with it",
                     pipeline::quoted(std::to_string(sample_count)));
}

int PictureOptions::threads_for(std::size_t samples) const {
  const std::size_t worth = samples >> 21;
  if (thread_count > 0 || worth < 2) return std::max(thread_count, 1);
  const unsigned cores = std::clamp(std::thread::hardware_concurrency(), 1U, unsigned{kMaxThreads});
  return static_cast<int>(std::min<std::size_t>(worth, cores));
}

void note_depths_in_image(const Tool& tool, const PictureOptions& chosen) {
  constexpr std::array kEndings = {".png", ".bmp", ".ppm", ".jpg", ".jpeg", ".gif"};
  struct stat status = {};
  if (chosen.z_buffer_path != "-" || ::fstat(STDOUT_FILENO, &status) != 0 || !S_ISREG(status.st_mode)) return;
  std::error_code no_name;
  const auto file = std::filesystem::read_symlink("/proc/self/fd/1", no_name).filename();  // Linux
  if (std::ranges::find(kEndings, file.extension()) != kEndings.end())
    tool.note("depths go to standard output, here " + file.string() + "; the picture: -o out.png");
}

std::vector<NamedFile> outputs_of(const PictureOptions& chosen, const std::vector<NamedFile>& others,
                                  const Statistics& statistics) {
  const std::string depths = chosen.z_buffer_path == "none" ? "" : chosen.z_buffer_path;
  std::vector<NamedFile> outputs = {{"--image", image_file_of(chosen.image_path)},
                                    file_or_stream("--z-buffer", depths, kStandardOutput),
                                    {"--depth-image", chosen.depth_image_path},
                                    {"--depth-array", chosen.depth_array_path},
                                    {"--triangle-array", chosen.triangle_array_path}};
  outputs.insert(outputs.end(), others.begin(), others.end());
  outputs.push_back(statistics.output());
  if (!chosen.probes.empty()) outputs.push_back(kStandardError);
  return outputs;
}

}  // namespace pipeline
