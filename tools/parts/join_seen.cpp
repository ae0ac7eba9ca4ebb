// join-seen: joins stage texts. The texts of a scene's parts in, the text of the whole scene out.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/text/error.h"
#include "tools/rim/tool.h"

using namespace pipeline;

namespace {

/// Copies the triangles of a text, unchanged; writes the number of one other than `next_number`.
void copy_triangles(StageReader& part, std::uint64_t& next_number, Tool& tool) {
  part.accept_clipped();
  part.accept_spheres();
  part.keep_text();
  for (TriangleBatch batch; part.read(batch); batch.clear()) {
    tool.timing().triangle_count += batch.object_count();
    for (std::size_t i = 0; i < batch.object_count(); ++i) {
      const std::uint64_t number = batch.number_of(i);
      if (number != next_number) tool.output().append("triangle " + std::to_string(number) + "\n");
      tool.output().append(batch.texts[i]);
      next_number = number + 1;
    }
  }
}

/// Writes the header of the first text, which has to be that of the others, and the triangles of all.
void join(const std::vector<std::string>& paths, bool expects_frame, Tool& tool) {
  std::optional<std::string> header;
  bool is_framed = false;
  std::uint64_t next_number = 0;
  for (const std::string& path : paths) {
    InputFile file(path);
    StageReader part(file.text());
    if (expects_frame) part.expect_framed();
    if (!header) {
      header = part.header_text();
      is_framed = part.header().framed;
      tool.output().append(*header);
    } else if (part.header_text() != *header) {
      throw InputError(part.header_end(), "the header of the first text", "another one before here");
    }
    copy_triangles(part, next_number, tool);
  }
  if (is_framed) tool.output().append("end\n");
}

}  // namespace

int join_seen_main(int argc, char** argv) {
  Tool tool({"join-seen",
             "Joins the stage texts of the parts of a scene, or of their visible triangles (zbuf --seen), "
             "into the text of the whole: the header, which is the same in all, and all triangles.",
             "The texts",
             {"join-seen stage1.txt stage1.txt > twice.txt",
              "join-seen --expect-framed seen1.txt seen2.txt | zbuf config.txt > z_buffer.txt"}},
            OutputKind::stage_text);
  std::vector<std::string> parts;
  bool expects_frame = false;
  tool.take_own_operands();
  tool.options().set_usage("Usage: join-seen [OPTIONS] PART...");
  tool.options().add_operands(
      "PART", parts,
      "The texts in the order of their triangles, all after the same stage; - is standard input");
  tool.options().begin_group("Input");
  tool.options().add_flag("--expect-framed", expects_frame,
                          "Refuse a text without the frame that model --framed gives it");

  return tool.run(argc, argv, [&] {
    if (parts.empty()) throw UsageError(expected_but_found("an operand PART or more", "none"));
    std::vector<NamedFile> inputs;
    inputs.reserve(parts.size());
    for (const std::string& path : parts) inputs.push_back(file_or_stream("PART", path, kStandardInput));
    tool.expect_separate({kStandardOutput}, inputs);
    join(parts, expects_frame, tool);
  });
}
