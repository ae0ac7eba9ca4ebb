#include "tools/zbuf/fragment_report.h"

#include <cstdio>
#include <optional>
#include <string_view>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
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
  FragmentReportOf(const std::vector<Pixel>& probed, const Viewport& screen, double epsilon, TextWriter* log)
      : log_(log) {
    for (const Pixel& pixel : probed) probes_.emplace_back(screen, pixel, epsilon);
    if (log != nullptr) all_.emplace(screen, epsilon);
  }

  void add(const TriangleBatch& p_ndc, std::size_t index) override {
    const ExactTriangle triangle = exact_triangle(p_ndc, index);
    const std::uint64_t number = p_ndc.numbers[index];
    for (Probe& probe : probes_)
      probe.test.add(triangle, number, [&](const Fragment& fragment) { probe.found.push_back(fragment); });
    if (all_)
      all_->add(triangle, number, [&](const Fragment& fragment) { log_->append(to_text(fragment) + "\n"); });
  }

  void finish() const override {
    for (const Probe& probe : probes_) say(probe);
  }

 private:
  struct Probe {
    Probe(const Viewport& screen, const Pixel& location, double epsilon)
        : pixel(location), test(screen, location, epsilon) {}

    Pixel pixel;
    FragmentLog<CoverageRule, Depth> test;
    std::vector<Fragment> found;
  };

  static void say(const Probe& probe) {
    for (const Fragment& fragment : probe.found)
      std::fprintf(stderr, "zbuf: %s\n", to_text(fragment).c_str());
    if (probe.found.empty())
      std::fprintf(stderr, "zbuf: %d,%d: no fragment\n", probe.pixel.column, probe.pixel.row);
  }

  std::vector<Probe> probes_;
  std::optional<FragmentLog<CoverageRule, Depth>> all_;
  TextWriter* log_;  // null without `all_`
};

}  // namespace

std::vector<Pixel> probed_pixels(const PictureOptions& chosen, const Viewport& screen) {
  std::vector<Pixel> pixels;
  for (const std::string& word : chosen.probes) pixels.push_back(parsed_pixel(word, screen));
  return pixels;
}

std::unique_ptr<FragmentReport> fragment_report(const ZbufOptions& chosen, const Viewport& screen,
                                                TextWriter* log) {
  if (chosen.probes.empty() && log == nullptr) return nullptr;
  return made_for<FragmentReport, FragmentReportOf>(chosen.rules, probed_pixels(chosen, screen), screen,
                                                    chosen.rules.depth_epsilon, log);
}

}  // namespace pipeline
