#include "tools/zbuf/zbuf_options.h"

#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"
#include "tools/zbuf/surface_shading.h"

namespace pipeline {
void ZbufOptions::complete(bool is_terminal) {
  const bool image_is_output = image_file_of(image_path) == "-", seen_is_output = seen_path == "-";
  if (image_is_output && seen_is_output)
    throw UsageError("--image: " + expected_but_found("a file, as --seen is standard output", "'-'"));
  if ((image_is_output || seen_is_output) && z_buffer_path == "-") {
    const std::string is_output = image_is_output ? "the image" : "--seen";
    throw UsageError("--z-buffer: " +
                     expected_but_found("a file or none, as " + is_output + " is standard output", "'-'"));
  }
  const bool writes_seen = !seen_path.empty();
  if (writes_seen && has_all_edges)
    throw UsageError("--seen: " + expected_but_found("no --wireframe all, which shows hidden triangles, too",
                                                     pipeline::quoted(seen_path)));
  if (image_path.empty() && !writes_seen) image_path = "out.bmp";
  image_path = named_standard_output(image_path);
  if (z_buffer_path.empty()) {
    const bool is_wanted = !image_is_output && !writes_seen;
    summarizes = is_terminal && is_wanted;
    z_buffer_path = is_terminal || !is_wanted ? "none" : "-";
  }
  if (const auto color = parse_color(background);
      color && !color->is_opaque() && has_image() && !can_hold_alpha(image_path))
    throw UsageError("--background: " +
                     expected_but_found(expected_opaque_background(), pipeline::quoted(background)));
  if (sample_count > 1 && !(depth_array_path.empty() && triangle_array_path.empty()))
    throw UsageError(
        (depth_array_path.empty() ? "--triangle-array: " : "--depth-array: ") +
        expected_but_found("--samples 1 with it", pipeline::quoted(std::to_string(sample_count))));
  if (algorithm != Algorithm::scanline) return;
  if (thread_count > 1)
    throw UsageError("--threads: " +
                     expected_but_found("1 with --algorithm scanline, which goes through the rows in turn",
                                        "'" + std::to_string(thread_count) + "'"));
  if (depth_epsilon > 0)
    throw UsageError("--depth-epsilon: " +
                     expected_but_found("0 with --algorithm scanline, which keeps no order of drawing",
                                        "'" + shortest_text(depth_epsilon) + "'"));
}

Viewport ZbufOptions::drawn_part(Viewport screen) const {
  const std::size_t colon = rows.find(':');
  const std::string_view word = rows;
  std::uint64_t first = 0, end = 0;
  const bool has_numbers = colon != std::string::npos && parse_count(word.substr(0, colon), first) &&
                           parse_count(word.substr(colon + 1), end);
  if (!has_numbers || first >= end || end > static_cast<std::size_t>(screen.rows))
    throw UsageError("--rows: " + expected_but_found(
                                      "A:B, the first row and the one after the last, from 0:1 to " +
                                          std::to_string(screen.rows - 1) + ":" + std::to_string(screen.rows),
                                      pipeline::quoted(rows)));
  screen.drawn = {static_cast<int>(first), static_cast<int>(end)};
  return screen;
}

void ZbufOptions::check_limits(const Viewport& screen) const {
  dispatch(*this, [&]<typename Rule, typename Depth>() {
    const std::string_view needed = Depth::needed_limits(screen);
    if (needed.empty()) return;
    throw UsageError("--depth " + std::string(Depth::kName) + ": " +
                     expected_but_found("limits of Z " + std::string(needed),
                                        shortest_text(screen.front) + " and " + shortest_text(screen.rear)));
  });
}

std::vector<NamedFile> outputs_of(const ZbufOptions& chosen, const Statistics& statistics) {
  const std::string depths = chosen.z_buffer_path == "none" ? "" : chosen.z_buffer_path;
  NamedFile seen = file_or_stream("--seen", chosen.seen_path, kStandardOutput);
  seen.is_in_place = true;
  return {{"--image", image_file_of(chosen.image_path)},
          file_or_stream("--z-buffer", depths, kStandardOutput),
          {"--depth-image", chosen.depth_image_path},
          {"--depth-array", chosen.depth_array_path},
          {"--triangle-array", chosen.triangle_array_path},
          {"--fragments", chosen.fragments_path},
          seen,
          statistics.output(),
          chosen.probes.empty() ? NamedFile() : kStandardError};
}

}  // namespace pipeline
