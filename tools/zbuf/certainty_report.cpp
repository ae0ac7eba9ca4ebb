#include "tools/zbuf/certainty_report.h"

#include <string>

#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

CertainPixels certain_pixels(const StageReader& reader, const Viewport& screen) {
  const StageHeader& header = reader.header();
  if (!header.bounds || !header.bounds->value.rounded || !header.projected || !header.appearance.columns().w)
    throw InputError(reader.header_end(),
                     expected_but_found("a text with 'bounds', 'projected' and the column 'w' for --certify "
                                        "(model --bounds, and stages that keep them)",
                                        "none"));
  return {screen, header.bounds->value, header.projected->value};
}

}  // namespace

CertaintyReport::CertaintyReport(const StageReader& reader, const Viewport& screen)
    : pixels_(certain_pixels(reader, screen)), row_(screen.drawn_rows().first) {}

void CertaintyReport::add_row(std::span<const PixelTag> tags, const TriangleStore& store) {
  std::uint64_t uncertain_count = 0;
  const auto number_of = [&](PixelTag tag) { return store.shown_number(tag); };
  pixels_.for_each_uncertain(row_, tags, number_of, [&](int column) {
    ++uncertain_count;
    if (uncertain_.size() < kMaxLines) uncertain_.emplace_back(row_, column);
  });
  uncertain_count_ += uncertain_count;
  certain_count_ += tags.size() - uncertain_count;
  ++row_;
}

void CertaintyReport::write(TextWriter& text) const {
  text.append("certain " + std::to_string(certain_count_) + "\nuncertain " +
              std::to_string(uncertain_count_) + "\n");
  for (const auto& [row, column] : uncertain_)
    text.append(std::to_string(row) + " " + std::to_string(column) + "\n");
}

}  // namespace pipeline
