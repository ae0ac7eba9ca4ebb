#include "tools/fragment_report.h"

#include <cstdio>
#include <optional>
#include <string_view>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/output_file.h"
#include "libpipeline/text/text_writer.h"
#include "libpipeline/visibility/tagged_batch.h"
#include "libpipeline/visibility/depth_format.h"
#include "libpipeline/visibility/fragment_log.h"
#include "tools/render.h"

namespace pipeline {
namespace {

Pixel parsed_place(const std::string& word, const Viewport& screen) {
  const std::size_t comma = word.find(',');
  const std::string_view columns = std::string_view(word).substr(0, comma);
  const std::string_view rows =
      comma == std::string::npos ? std::string_view() : std::string_view(word).substr(comma + 1);
  std::size_t column = 0;
  std::size_t row = 0;
  if (parse_count(columns, column) && parse_count(rows, row) &&
      column < static_cast<std::size_t>(screen.columns) && row < static_cast<std::size_t>(screen.rows))
    return {static_cast<int>(column), static_cast<int>(row)};
  throw UsageError("--probe: " +
                   expected_but_found("COLUMN,ROW, from 0,0 to " + std::to_string(screen.columns - 1) + "," +
                                          std::to_string(screen.rows - 1),
                                      pipeline::quoted(word)));
}

template <typename CoverageRule, typename Depth>
class ReportOf final : public FragmentReport {
 public:
  ReportOf(const RenderOptions& chosen, const Viewport& screen) {
    for (const std::string& word : chosen.fragments.probes)
      probes_.emplace_back(screen, parsed_place(word, screen), chosen.depth_epsilon);
    if (!chosen.fragments.file_path.empty())
      file_.emplace(chosen.fragments.file_path, screen, chosen.depth_epsilon);
  }

  void add(const TriangleBatch& p_ndc, std::size_t index) override {
    const ExactTriangle triangle = exact_triangle(p_ndc, index);
    const std::uint64_t number = p_ndc.numbers[index];
    for (Probe& probe : probes_)
      probe.test.add(triangle, number, [&](const Fragment& fragment) { probe.found.push_back(fragment); });
    if (!file_) return;
    file_->log.add(triangle, number,
                   [&](const Fragment& fragment) { file_->text.append(to_text(fragment) + "\n"); });
  }

  void finish() override {
    for (const Probe& probe : probes_) say(probe);
    if (!file_) return;
    file_->text.flush();
    file_->file.close();
  }

  void commit() override {
    if (file_) file_->file.commit();
  }

 private:
  struct Probe {
    Probe(const Viewport& screen, const Pixel& location, double epsilon)
        : pixel(location), test(screen, location, epsilon) {}

    Pixel pixel;
    PixelProbe<CoverageRule, Depth> test;
    std::vector<Fragment> found;
  };
  struct LogFile {
    LogFile(const std::string& path, const Viewport& screen, double epsilon)
        : file(path), text(file.descriptor(), path), log(screen, epsilon) {}

    OutputFile file;
    TextWriter text;
    FragmentLog<CoverageRule, Depth> log;
  };

  static void say(const Probe& probe) {
    for (const Fragment& fragment : probe.found)
      std::fprintf(stderr, "zbuf: %s\n", to_text(fragment).c_str());
    if (probe.found.empty())
      std::fprintf(stderr, "zbuf: %d,%d: no fragment\n", probe.pixel.column, probe.pixel.row);
  }

  std::vector<Probe> probes_;
  std::optional<LogFile> file_;
};

template <typename Depth>
std::unique_ptr<FragmentReport> report_in(const RenderOptions& chosen, const Viewport& screen) {
  if (chosen.coverage == Coverage::center)
    return std::make_unique<ReportOf<CenterCoverage, Depth>>(chosen, screen);
  return std::make_unique<ReportOf<NearestCoverage, Depth>>(chosen, screen);
}

}  // namespace

void add_fragment_options(CommandLine& options, FragmentOptions& chosen) {
  options.add_repeatable("--probe", "COLUMN,ROW", chosen.probes,
                         "Say on stderr of every triangle at this pixel how deep it is there, and whether it "
                         "was kept or why it was lost; may be given again");
  options.add_word("--fragments", "FILE", chosen.file_path, "Write the same for the whole picture to a file");
}

std::unique_ptr<FragmentReport> fragment_report(const RenderOptions& chosen, const Viewport& screen) {
  if (chosen.fragments.probes.empty() && chosen.fragments.file_path.empty()) return nullptr;
  switch (chosen.depth) {
    case DepthFormat::f64:
      return report_in<DepthF64>(chosen, screen);
    case DepthFormat::f32:
      return report_in<DepthF32>(chosen, screen);
    case DepthFormat::u24:
      break;
  }
  return report_in<DepthU24>(chosen, screen);
}

}  // namespace pipeline
