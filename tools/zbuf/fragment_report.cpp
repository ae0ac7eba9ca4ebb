#include "tools/zbuf/fragment_report.h"

#include <cstdio>
#include <string_view>

#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/visibility/raster.h"

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
  throw UsageError("--probe",
                   "COLUMN,ROW, from 0," + std::to_string(first_row) + " to " +
                       std::to_string(screen.columns - 1) + "," + std::to_string(last_row),
                   pipeline::quoted(word));
}

}  // namespace

std::vector<Pixel> probed_pixels(const PictureOptions& chosen, const Viewport& screen) {
  std::vector<Pixel> pixels;
  for (const std::string& word : chosen.probes) pixels.push_back(parsed_pixel(word, screen));
  return pixels;
}

FragmentReport::FragmentReport(const ZbufOptions& chosen, const Viewport& screen, TextWriter* log)
    : log_(log) {
  for (const Pixel& pixel : probed_pixels(chosen, screen))
    probes_.push_back({pixel, FragmentLog(chosen.rules, screen, pixel), {}});
  if (log != nullptr) all_.emplace(chosen.rules, screen);
}

void FragmentReport::add(const TriangleBatch& p_ndc) {
  if (probes_.empty() && !all_) return;
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    const ExactTriangle triangle = exact_triangle(p_ndc, i);
    const std::uint64_t number = p_ndc.numbers[i];
    for (Probe& probe : probes_)
      probe.test.add(triangle, number, [&](const Fragment& fragment) { probe.found.push_back(fragment); });
    if (all_)
      all_->add(triangle, number, [&](const Fragment& fragment) { log_->append(to_text(fragment) + "\n"); });
  }
}

void FragmentReport::finish() const {
  for (const auto& [pixel, test, found] : probes_) {
    for (const Fragment& fragment : found) std::fprintf(stderr, "zbuf: %s\n", to_text(fragment).c_str());
    if (found.empty()) std::fprintf(stderr, "zbuf: %d,%d: no fragment\n", pixel.column, pixel.row);
  }
}

}  // namespace pipeline
