#include "tools/zbuf/fragment_report.h"

#include <cstdio>
#include <optional>
#include <string_view>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/output_file.h"
#include "libpipeline/text/text_writer.h"
#include "libpipeline/visibility/depth_format.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/tagged_batch.h"

namespace pipeline {
namespace {

Pixel parsed_pixel(const std::string& word, const Viewport& screen) {
  const std::size_t comma = word.find(',');
  const std::string_view columns = std::string_view(word).substr(0, comma);
  const std::string_view rows =
      comma == std::string::npos ? std::string_view() : std::string_view(word).substr(comma + 1);
  const auto first_row = static_cast<std::size_t>(screen.drawn_rows().first);
  const auto last_row = static_cast<std::size_t>(screen.drawn_rows().end - 1);
  std::uint64_t column = 0;
  std::uint64_t row = 0;
  if (parse_count(columns, column) && parse_count(rows, row) &&
      column < static_cast<std::size_t>(screen.columns) && row >= first_row && row <= last_row)
    return {static_cast<int>(column), static_cast<int>(row)};
  throw UsageError("--probe: " +
                   expected_but_found("COLUMN,ROW, from 0," + std::to_string(first_row) + " to " +
                                          std::to_string(screen.columns - 1) + "," + std::to_string(last_row),
                                      pipeline::quoted(word)));
}

template <typename CoverageRule, typename Depth>
class FragmentReportOf final : public FragmentReport {
 public:
  FragmentReportOf(const ZbufOptions& chosen, const Viewport& screen) {
    for (const Pixel& pixel : probed_pixels(chosen, screen))
      probes_.emplace_back(screen, pixel, chosen.depth_epsilon);
    if (!chosen.fragments_path.empty()) file_.emplace(chosen.fragments_path, screen, chosen.depth_epsilon);
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
    FragmentLog<CoverageRule, Depth> test;
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

}  // namespace

std::vector<Pixel> probed_pixels(const ZbufOptions& chosen, const Viewport& screen) {
  std::vector<Pixel> pixels;
  for (const std::string& word : chosen.probes) pixels.push_back(parsed_pixel(word, screen));
  return pixels;
}

std::unique_ptr<FragmentReport> fragment_report(const ZbufOptions& chosen, const Viewport& screen) {
  if (chosen.probes.empty() && chosen.fragments_path.empty()) return nullptr;
  return made_for<FragmentReport, FragmentReportOf>(chosen, chosen, screen);
}

}  // namespace pipeline
