// project: clips triangles behind the eye and divides by w. View space in, normalized device coordinates out.

#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/vertex/lost_digits.h"
#include "libpipeline/vertex/projection.h"
#include "tools/rim/command_line.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/stages/stage_loop.h"
#include "tools/stages/stage_options.h"
#include "tools/stages/view_report.h"

using namespace pipeline;

namespace {

struct ProjectOptions {
  explicit ProjectOptions(CommandLine& options) : numbers(options), projections(options) {
    add_clipping(options);
  }
  void add_clipping(CommandLine& options);

  NumberOptions numbers;
  ProjectionOptions projections;
  ClipMode clip = ClipMode::automatic;
  CullMode cull = CullMode::nothing;
  double clip_inset = 0;
};

void ProjectOptions::add_clipping(CommandLine& options) {
  options.begin_group("Clipping");
  options.add_choice<ClipMode>("--clip", clip,
                               {{"auto", ClipMode::automatic},
                                {"near", ClipMode::near},
                                {"frustum", ClipMode::frustum},
                                {"reject", ClipMode::reject},
                                {"none", ClipMode::none}},
                               "auto: cut only triangles that come near the eye, at the near plane\n"
                               "near: cut all triangles at the near plane\n"
                               "frustum: cut all triangles at all six planes\n"
                               "reject: drop triangles wholly outside one plane, cut nothing\n"
                               "none: a vertex that is not in front of the eye is an error");
  options.add_number(
      "--clip-inset", "F", clip_inset, [](double inset) { return inset >= 0 && inset < 1; },
      "a number from 0 to less than 1",
      "Pull in the planes of --clip near, frustum or reject, to show the cuts: 0.1 keeps what is between "
      "-0.9 and 0.9 in NDC");
  options.add_choice<CullMode>("--cull", cull, {{"back", CullMode::back}, {"front", CullMode::front}},
                               "Drop triangles that show this side to the eye; counterclockwise is front");
}

void check_inset(const ProjectOptions& chosen) {
  const bool has_planes = chosen.clip != ClipMode::automatic && chosen.clip != ClipMode::none;
  if (chosen.clip_inset > 0 && !has_planes)
    throw UsageError("--clip-inset", "--clip near, frustum or reject with it", "none of these");
}

/// Turns the bounds of view space into those of NDC; a UsageError if an option excludes them.
void add_rounding(Bounds& bounds, const ProjectOptions& chosen, CoordinateRounder& rounder) {
  const auto refuse = [](const std::string& option, const std::string& expected = "none") {
    throw UsageError(option, expected + " with bounds in the text", "another");
  };
  if (chosen.cull != CullMode::nothing) refuse("--cull");
  if (chosen.clip != ClipMode::automatic && chosen.clip != ClipMode::near) refuse("--clip", "auto or near");
  if (chosen.clip_inset > 0) refuse("--clip-inset");
  bounds.rounded = chosen.numbers.kept_bounds(rounder);
  bounds.space = "ndc";
}

std::string lost_digits_note(const LostDigits::Found& found) {
  std::array<char, 32> percent = {};
  std::snprintf(percent.data(), percent.size(), found.share < 0.1 ? "%.2g" : "%.0f", 100 * found.share);
  const std::string digits = std::to_string(found.decimals) + " digits ";
  const std::string enough = found.enough ? std::to_string(*found.enough) : "exact";
  return std::string("in ") + percent.data() + " % of what is drawn, " + digits +
         (found.is_of_edges ? "are too few to tell where the edges are"
                            : "cannot tell which of two surfaces is nearer") +
         "; try --digits " + enough + " for every stage" + (found.near_helps ? ", or a larger near" : "") +
         (found.may_be_one_plane ? "; if they lie in one plane, no digits can: move them apart" : "");
}

std::string to_text(const ProjectionCounts& counts) {
  return std::to_string(counts.culled) + " culled, " + std::to_string(counts.outside) + " outside, " +
         std::to_string(counts.clipped) + " cut into " + std::to_string(counts.pieces);
}

void project(Tool& tool, const ProjectOptions& chosen, Statistics& statistics) {
  tool.expect_separate({kStandardOutput, statistics.output()}, {chosen.projections.scene()});
  check_inset(chosen);
  expect_kind(tool.input(), TextKind::view);
  StageReader reader(tool.input());
  expect_header(reader, TextKind::view);
  const Located<Projection> given = chosen.projections.projection(reader, tool);
  const ProjectionTransform projection = clip_from_view(given);
  StageWriter writer(tool.output(), chosen.numbers.format(), false);
  StageHeader header = projected_header(reader.header(), given, projection);
  CoordinateRounder rounder = chosen.numbers.rounder(tool.input().file());
  if (header.bounds) add_rounding(header.bounds->value, chosen, rounder);
  writer.write_header(header);

  ProjectionStage stage(projection, chosen.clip, chosen.cull, rounder, chosen.clip_inset);
  if (header.projected) stage.keep_unclipped_triangles();
  if (header.bounds) stage.keep_bounds(header.bounds->value.error);
  ViewReport report(stage, given, ViewVolume(projection, chosen.clip_inset), statistics.is_wanted());
  const NumberFormat format = chosen.numbers.format();
  LostDigits lost_digits(projection, format.shortest ? std::nullopt : std::optional(format.decimals),
                         reader.first_decimals());
  TriangleBatch p_view;
  const auto transform = [&](TriangleBatch& batch) {
    std::swap(batch, p_view);
    stage.project(p_view, batch);
    report.add(p_view, batch);
    lost_digits.add(p_view, batch);
  };
  StageLoop loop(tool, writer, rounder, statistics);
  loop.run(reader, transform);
  tool.timing().details = to_text(stage.counts());
  loop.note_if_no_triangle_came();
  if (const auto note = report.note()) tool.note(*note);
  if (const auto found = lost_digits.found()) tool.note(lost_digits_note(*found));
  report.add_to(statistics);
  loop.write_statistics(format);
}

}  // namespace

int project_main(int argc, char** argv) {
  Tool tool({"project",
             "Reads triangles in view space and writes them in normalized device coordinates (stage3.txt).",
             "The output of view (or stage2.txt)",
             {"project --scene scene.txt stage2.txt > stage3.txt",
              "model scene.txt | view | project --clip frustum | zbuf config.txt > depths.txt"},
             "--precision --frustum --clip-inset"},
            OutputKind::stage_text);
  ProjectOptions chosen(tool.options());
  tool.options().begin_group("Output");
  Statistics statistics(tool.options());

  return tool.run(argc, argv, [&] { project(tool, chosen, statistics); });
}
