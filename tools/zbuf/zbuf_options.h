#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/coverage/type_list.h"
#include "libpipeline/picture/depth_image.h"
#include "libpipeline/picture/image_file.h"
#include "libpipeline/picture/pixel_array.h"
#include "libpipeline/picture/shading.h"
#include "libpipeline/picture/supersampling.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/config.h"
#include "libpipeline/visibility/depth_format.h"
#include "tools/rim/command_line.h"
#include "tools/rim/separate_outputs.h"
#include "tools/rim/statistics.h"

namespace pipeline {

/// The name of an image, with /dev/stdout, to which OutputFile writes without replacing anything, in place of
/// a dash.
inline std::string named_standard_output(const std::string& image) {
  return image_file_of(image) == "-" ? image.substr(0, image.size() - 1) + "/dev/stdout" : image;
}

enum class Algorithm { zbuffer, scanline };

/// The options of `zbuf`, as members with their defaults and, in the same order, as words of the command
/// line.
struct ZbufOptions {
  std::string config_path;
  std::string size;           // "WIDTHxHEIGHT"; empty: that of the config
  std::string image_path;     // "-": standard output; empty: as `complete` chooses, and then none
  std::string z_buffer_path;  // "-": standard output; "none": nowhere; empty: as `complete` chooses
  TypeChoice<CoverageRules> coverage;
  Algorithm algorithm = Algorithm::zbuffer;
  TypeChoice<DepthFormats> depth;
  int thread_count = 1;
  std::string depth_image_path;     // empty: none
  std::string depth_array_path;     // empty: none
  std::string triangle_array_path;  // empty: none
  std::string seen_path;            // "-": standard output; empty: no file
  double depth_epsilon = 0;
  std::string rows;                     // "A:B", if the option is given
  int sample_count = 1;                 // along each side of a pixel, for the image alone
  std::optional<ShadingModel> shading;  // none: as the text's header implies
  bool wireframe = false;
  bool has_all_edges = false;       // the wireframe, hidden ones too
  std::string background;           // "RRGGBB[AA]"; empty: that of the text
  std::vector<std::string> probes;  // "COLUMN,ROW" each
  std::string fragments_path;       // empty: no file
  bool framed = false;              // the input has to be
  bool summarizes = false;          // on stderr, as the depths are not shown on the terminal

  void add_to(CommandLine& options);
  // Some of them, for other tools that make pictures; `has_seen`: whether the help mentions --seen.
  void add_screen_and_outputs(CommandLine& options, bool has_seen);
  void add_samples(CommandLine& options);
  void add_shading(CommandLine& options);
  void add_background(CommandLine& options);
  void add_framed(CommandLine& options);
  /// Chooses the options that depend on others, and on whether standard output is a terminal. A UsageError if
  /// options exclude each other.
  void complete(bool is_terminal);
  /// The screen with the rows that are to be drawn. A UsageError if it does not have them.
  [[nodiscard]] Viewport drawn_part(Viewport screen) const;
  /// A UsageError if the depth format cannot store the depths between the limits of Z.
  void check_limits(const Viewport& screen) const;
  /// Whether an image is written, once the options are complete.
  [[nodiscard]] bool has_image() const { return !image_path.empty(); }
};

/// The files and pipes of a run that makes a picture.
std::vector<NamedFile> outputs_of(const ZbufOptions& chosen, const Statistics& statistics);

/// Calls visit<Rule, Depth>() for the coverage rule and the depth format chosen.
template <typename Visitor>
decltype(auto) dispatch(const ZbufOptions& chosen, Visitor&& visit) {
  return std::visit(
      [&]<typename Rule, typename Depth>(TypeValue<Rule>, TypeValue<Depth>) -> decltype(auto) {
        return visit.template operator()<Rule, Depth>();
      },
      chosen.coverage, chosen.depth);
}

template <typename Interface, template <typename, typename> typename Of, typename Rule, typename Depth,
          typename... Arguments>
std::unique_ptr<Interface> made(const Arguments&... arguments) {
  return std::make_unique<Of<Rule, Depth>>(arguments...);
}
/// The Of<Rule, Depth> for the coverage rule and the depth format chosen: made in a function of its own, as
/// clang 14 loses members of a class that is first named in a visitor.
template <typename Interface, template <typename, typename> typename Of, typename... Arguments>
std::unique_ptr<Interface> made_for(const ZbufOptions& chosen, const Arguments&... arguments) {
  return dispatch(chosen, [&]<typename Rule, typename Depth>() {
    return made<Interface, Of, Rule, Depth>(arguments...);
  });
}

/// Adds an option that takes the name of one type of a list; its help ends with a line for each.
template <typename... Types>
void add_type_choice(CommandLine& options, const std::string& name, TypeList<Types...>,
                     TypeChoice<TypeList<Types...>>& chosen, std::string help) {
  const auto line = [](std::string_view word, std::string_view meaning) {
    return "\n" + std::string(word) + ": " + std::string(meaning);
  };
  ((help += line(Types::kName, Types::kMeaning)), ...);
  options.add_choice<TypeChoice<TypeList<Types...>>>(
      name, chosen, {{std::string(Types::kName), TypeValue<Types>()}...}, help);
}

// Next to the members, so that each option is defined in one file.
inline void ZbufOptions::add_to(CommandLine& options) {
  options.set_usage(
      "Usage: zbuf [OPTIONS] CONFIG [INPUT]\n"
      "       zbuf [OPTIONS] --size WIDTHxHEIGHT [CONFIG] [INPUT]");
  add_screen_and_outputs(options, true);
  options.add_word(
      "--rows", "A:B", rows,
      "Draw only the rows from A to before B of the picture, counted from 0 at the top, in memory "
      "for these alone: cat joins the depths of such bands, join-images the images",
      [](const std::string& word) {
        return word.empty() ? expected_but_found("A:B, such as 0:100", pipeline::quoted(word))
                            : std::string();
      });
  options.add_word(
      "--seen", "FILE", seen_path,
      "Write the triangles that a pixel or sample shows, as text that zbuf reads and that gives "
      "the same picture; - is standard output, and the input may be replaced. With it, no image and no "
      "depths unless asked for");
  options.begin_group("Pixels");
  add_type_choice(options, "--coverage", CoverageRules(), coverage, "Which pixels a triangle covers.");
  options.add_choice<Algorithm>(
      "--algorithm", algorithm, {{"zbuffer", Algorithm::zbuffer}, {"scanline", Algorithm::scanline}},
      "How the visible triangle is found; both give the same output.\n"
      "zbuffer: every pixel keeps the nearest depth so far\n"
      "scanline: triangles are kept and compared row by row, without memory for the image");
  add_type_choice(options, "--depth", DepthFormats(), depth, "How a pixel stores its depth.");
  options.add_number(
      "--depth-epsilon", "E", depth_epsilon, [](double epsilon) { return epsilon >= 0; },
      "a number of at least 0",
      "Draw a triangle only where it is nearer than the visible one by more than E; the result then depends "
      "on the order of the triangles");
  add_samples(options);
  options.add_whole("--threads", thread_count, 1, 256, "How many threads draw with the z-buffer and shade");
  options.begin_group("Color and light");
  add_shading(options);
  options.add_flag_with_word("--wireframe", "all", wireframe, has_all_edges,
                             "Show only the edges of the visible surfaces: the pixels within half a pixel of "
                             "an edge; with all, hidden edges, too");
  add_background(options);
  options.begin_group("Debugging");
  options.add_repeatable("--probe", "COLUMN,ROW", probes,
                         "Report on stderr, for every triangle at this pixel, its depth there and whether it "
                         "was kept or why it was lost; may be repeated");
  options.add_word("--fragments", "FILE", fragments_path, "Write the same for the whole picture to a file");
  add_framed(options);
}

inline void ZbufOptions::add_screen_and_outputs(CommandLine& options, bool has_seen) {
  options.add_operand(
      "CONFIG", config_path,
      "The screen (config.txt): WIDTH HEIGHT in pixels, alone or before three lines: the left "
      "limit of x, the bottom limit of y, the front and rear limits of z");
  options.begin_group("Output");
  options.add_word("--size", "WIDTHxHEIGHT", size,
                   "The screen's size in place of that in CONFIG, whose limits stay; without CONFIG, x, y "
                   "and z are shown from -1 to 1. With it, a single operand that holds no config is INPUT",
                   [](const std::string& word) {
                     return parse_size(word) ? std::string()
                                             : expected_but_found("WIDTHxHEIGHT in pixels, such as 400x300",
                                                                  pipeline::quoted(word));
                   });
  const std::vector<std::string_view> extensions = image_extensions();
  options.add_word(
      "-o,--image", "FILE", image_path,
      "Where the image goes, a " + listed({extensions.begin(), extensions.end()}) +
          " file, or png:FILE of any name; - is standard output, as PPM, or png:-, both without "
          "the depths (default: out.bmp" +
          (has_seen ? ", but none with --seen)" : ")"),
      [](const std::string& name) { return wrong_with_name(check_image_name)(named_standard_output(name)); });
  options.add_word("--z-buffer", "FILE", z_buffer_path,
                   std::string("Where the depths go; - is standard output, none is nowhere, ./none a file "
                               "of that name (default: -, but none with -o -") +
                       (has_seen ? ", with --seen and at a terminal)" : " and at a terminal)"));
  options.add_word("--depth-image", "FILE", depth_image_path,
                   "Also write the depths as a 16-bit image, a .pgm or .png file: white at the front limit, "
                   "black at the rear limit",
                   wrong_with_name(check_depth_image_name));
  options.add_word("--depth-array", "FILE", depth_array_path,
                   "Also write the depths as an array of doubles, a .npy file for numpy.load: nan where "
                   "nothing is seen",
                   wrong_with_name(check_array_name));
  options.add_word(
      "--triangle-array", "FILE", triangle_array_path,
      "Also write the numbers of the triangles seen as an array of whole numbers, a .npy file: -1 "
      "where nothing is seen",
      wrong_with_name(check_array_name));
}

inline void ZbufOptions::add_samples(CommandLine& options) {
  options.add_whole("--samples", sample_count, 1, kMaxSamples,
                    "Smooth edges: a pixel of the image is the mean of N x N samples, its depth stays that "
                    "of its center; N");
}

inline void ZbufOptions::add_shading(CommandLine& options) {
  options.add_choice<std::optional<ShadingModel>>(
      "--shading", shading,
      {{"none", ShadingModel::none},
       {"flat", ShadingModel::flat},
       {"gouraud", ShadingModel::gouraud},
       {"phong", ShadingModel::phong}},
      "Where surfaces are lit. none: nowhere; flat: once per triangle; gouraud: at its vertices; phong: at "
      "every pixel. Without the option: phong with lights and normals, flat with lights alone, else none");
}

inline void ZbufOptions::add_background(CommandLine& options) {
  options.add_word(
      "--background", "RRGGBB[AA]", background,
      "The color of pixels that show no triangle, six hexadecimal digits, in place of the "
      "scene's; black if neither gives one. Two more digits are its alpha, from 00, invisible, to "
      "ff, opaque; less than ff only for a .png image",
      [](const std::string& word) {
        return parse_color(word)
                   ? std::string()
                   : expected_but_found("RRGGBB or RRGGBBAA, hexadecimal digits", pipeline::quoted(word));
      });
}

inline void ZbufOptions::add_framed(CommandLine& options) {
  options.add_flag("--expect-framed", framed,
                   "Refuse a text without the frame that model --framed gives it: an empty one may come from "
                   "a stage that was killed");
}

}  // namespace pipeline
