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

/// Writes the header of the first text and the triangles of all texts, unchanged.
class JoinedText {
 public:
  explicit JoinedText(TextWriter& text) : text_(text) {}

  /// Adds the next text. An InputError if its header differs from the first, or anything in it is wrong.
  void add(StageReader& part, Timing& timing) {
    if (!header_) {
      header_ = part.header_text();
      is_framed_ = part.header().framed;
      text_.append(*header_);
    } else if (part.header_text() != *header_) {
      throw InputError(part.header_end(),
                       expected_but_found("the header of the first text", "another one before here"));
    }
    part.accept_clipped();
    part.accept_spheres();
    part.keep_text();
    for (TriangleBatch batch; part.read(batch); timing.triangle_count += batch.object_count()) {
      for (std::size_t i = 0; i < batch.object_count(); ++i) {
        const std::uint64_t number = batch.number_of(i);
        if (number != next_number_) text_.append("triangle " + std::to_string(number) + "\n");
        text_.append(batch.texts[i]);
        next_number_ = number + 1;
      }
      batch.clear();
    }
  }
  void finish() {
    if (is_framed_) text_.append("end\n");
  }

 private:
  TextWriter& text_;
  std::optional<std::string> header_;
  bool is_framed_ = false;
  std::uint64_t next_number_ = 0;
};

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
    for (const std::string& path : parts) inputs.push_back(file_or_stream("PART", path, kStandardInput));
    tool.expect_separate({kStandardOutput}, inputs);
    JoinedText joined(tool.output());
    for (const std::string& path : parts) {
      InputFile file(path);
      StageReader part(file.text());
      if (expects_frame) part.expect_framed();
      joined.add(part, tool.timing());
    }
    joined.finish();
  });
}
