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
  const std::span<const PixelDepths> pixels = pixels_.row(row_);
  PixelTag tag = tags[0];
  std::int64_t number = store.shown_number(tag);
  for (std::size_t column = 0; column < tags.size(); ++column) {
    if (tags[column] != tag) number = store.shown_number(tag = tags[column]);
    if (pixels[column].certainly_shows(number)) continue;
    if (++uncertain_count_ <= kMaxLines) uncertain_.emplace_back(row_, static_cast<int>(column));
  }
  pixel_count_ += tags.size();
  ++row_;
}

void CertaintyReport::write(TextWriter& text) const {
  text.append("certain " + std::to_string(pixel_count_ - uncertain_count_) + "\nuncertain " +
              std::to_string(uncertain_count_) + "\n");
  for (const auto& [row, column] : uncertain_)
    text.append(std::to_string(row) + " " + std::to_string(column) + "\n");
}

}  // namespace pipeline
