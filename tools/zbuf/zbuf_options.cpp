#include "tools/zbuf/zbuf_options.h"

#include "libpipeline/picture/image_file.h"
#include "libpipeline/picture/supersampling.h"
#include "libpipeline/scene/config.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_printer.h"
#include "tools/rim/command_line.h"

namespace pipeline {
namespace {

/// Adds an option that takes the name of a type from a list; its help ends with one line per type.
template <typename... Types>
void add_type_choice(CommandLine& options, const std::string& name, TypeList<Types...>,
                     typename TypeList<Types...>::Choice& chosen, std::string help) {
  const auto line = [](std::string_view word, std::string_view meaning) {
    return "\n" + std::string(word) + ": " + std::string(meaning);
  };
  ((help += line(Types::kName, Types::kMeaning)), ...);
  options.add_choice<typename TypeList<Types...>::Choice>(
      name, chosen, {{std::string(Types::kName), TypeValue<Types>()}...}, help);
}

}  // namespace

ZbufOptions::ZbufOptions(CommandLine& options) : PictureOptions(options, "zbuf", true) {
  options.add_word(
      "--rows", "A:B", rows,
      "Draw only rows A to B - 1, counted from 0 at the top; cat joins the depths of such bands, "
      "join-images the images",
      expects("A:B, such as 0:100", [](const std::string& word) { return !word.empty(); }));
  options.add_word("--seen", "FILE", seen_path,
                   "Write the visible triangles, as text from which zbuf draws the same picture; - is "
                   "standard output. Image and depths are then written only if asked for");
  options.add_word(
      "--certify", "FILE", certainty_path,
      "Write how many pixels certainly show what exact arithmetic shows, and the row and column "
      "of the others (needs model --bounds and --coverage center); - is standard output, without "
      "depths");
  add_pixels(options);
  options.begin_group("Color and light");
  add_shading(options);
  options.add_flag_with_word(
      "--wireframe", "all", wireframe, has_all_edges,
      "Show only the edges of the triangles, one pixel in each column or row, where no "
      "surface hides them; with all, hidden edges, too");
  add_background(options);
  options.begin_group("Debugging");
  options.add_repeatable(
      "--probe", "COLUMN,ROW", probes,
      "List every triangle at this pixel on stderr: its depth, and why it was kept or lost; "
      "repeatable");
  options.add_word("--fragments", "FILE", fragments_path, "Write the same for all pixels");
  add_framed(options);
}

void ZbufOptions::add_pixels(CommandLine& options) {
  options.begin_group("Pixels");
  add_type_choice(options, "--coverage", CoverageRules(), rules.coverage, "Which pixels a triangle covers.");
  options.add_whole("--samples", sample_count, 1, kMaxSamples,
                    "Smooth edges: a pixel is the mean of N x N samples");
  options.add_choice<Algorithm>("--algorithm", algorithm,
                                {{"zbuffer", Algorithm::zbuffer}, {"scanline", Algorithm::scanline}},
                                "How the visible triangle is found; the output is the same.\n"
                                "zbuffer: every pixel keeps the nearest depth so far\n"
                                "scanline: row by row, without memory for the image");
  add_type_choice(options, "--depth", DepthFormats(), rules.depth, "How a pixel stores its depth.");
  options.add_number(
      "--depth-epsilon", "E", rules.depth_epsilon, [](double epsilon) { return epsilon >= 0; },
      "a number of at least 0",
      "Draw a triangle only where it is nearer than the visible one by more than E; the order of triangles "
      "then matters");
  options.add_whole("--threads", thread_count, 0, kMaxThreads,
                    "How many threads draw and shade (0: all that help)");
}

void ZbufOptions::complete(bool is_terminal) {
  const bool writes_seen = !seen_path.empty(), certifies = !certainty_path.empty();
  if (seen_path == "-" || certainty_path == "-") {
    const std::string taken =
        seen_path == "-" ? ", as --seen is standard output" : ", as --certify is standard output";
    if (seen_path == certainty_path) throw UsageError("--certify", "a file" + taken, "'-'");
    if (image_file_of(image_path) == "-") throw UsageError("--image", "a file" + taken, "'-'");
    if (z_buffer_path == "-") throw UsageError("--z-buffer", "a file or none" + taken, "'-'");
    if (certainty_path == "-" && z_buffer_path.empty()) z_buffer_path = "none";
  }
  if (certifies && !std::holds_alternative<TypeValue<CenterCoverage>>(rules.coverage))
    throw UsageError("--certify", "--coverage center with it", "'nearest'");
  if (certifies && sample_count > 1)
    throw UsageError("--certify", "--samples 1 with it", pipeline::quoted(std::to_string(sample_count)));
  if (writes_seen && has_all_edges)
    throw UsageError("--seen", "no --wireframe all, which shows hidden triangles, too",
                     pipeline::quoted(seen_path));
  PictureOptions::complete(is_terminal, writes_seen);
  if (algorithm != Algorithm::scanline) return;
  if (thread_count > 1)
    throw UsageError("--threads", "1 with --algorithm scanline, which goes through the rows in turn",
                     "'" + std::to_string(thread_count) + "'");
  if (rules.depth_epsilon > 0)
    throw UsageError("--depth-epsilon", "0 with --algorithm scanline, which keeps no order of drawing",
                     "'" + shortest_text(rules.depth_epsilon) + "'");
}

Viewport ZbufOptions::drawn_part(Viewport screen) const {
  const auto [first, end] = parse_pair(rows, ':').value_or(std::pair<std::uint64_t, std::uint64_t>());
  if (first >= end || end > static_cast<std::size_t>(screen.rows))
    throw UsageError("--rows",
                     "A:B, the first row and the one after the last, from 0:1 to " +
                         std::to_string(screen.rows - 1) + ":" + std::to_string(screen.rows),
                     pipeline::quoted(rows));
  screen.drawn = {static_cast<int>(first), static_cast<int>(end)};
  return screen;
}

void ZbufOptions::check_limits(const Viewport& screen) const {
  const auto check = [&]<typename Depth>(TypeValue<Depth>) {
    const std::string_view needed = Depth::needed_limits(screen);
    if (needed.empty()) return;
    throw UsageError("--depth " + std::string(Depth::kName), "limits of Z " + std::string(needed),
                     shortest_text(screen.front) + " and " + shortest_text(screen.rear));
  };
  std::visit(check, rules.depth);
}

std::vector<NamedFile> ZbufOptions::outputs(const Statistics& statistics) const {
  NamedFile seen = file_or_stream("--seen", seen_path, kStandardOutput);
  seen.is_in_place = true;
  const NamedFile certainty = file_or_stream("--certify", certainty_path, kStandardOutput);
  return outputs_of(*this, {{"--fragments", fragments_path}, seen, certainty}, statistics);
}

}  // namespace pipeline
