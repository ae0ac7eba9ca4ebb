#include "tools/zbuf/image_rows.h"

#include <algorithm>

namespace pipeline {

ImageRows::ImageRows(const std::string& path, const Viewport& screen, int sample_count, Color background) {
  if (path.empty()) return;
  file_.emplace(image_file_of(path));
  pixels_ = image_writer(file_->descriptor(), path, screen.columns, screen.drawn_row_count(),
                         !background.is_opaque());
  if (sample_count > 1) means_.emplace(screen.columns, sample_count, background);
}

void ImageRows::write_row(std::span<const Color> colors) {
  if (!means_) return pixels_->write_row(colors);
  if (const auto complete = means_->add(colors)) pixels_->write_row(*complete);
}

void ImageRows::close() {
  if (!pixels_) return;
  pixels_->finish();
  file_->close();
}

void ImageRows::commit() {
  if (file_) file_->commit();
}

std::string summary(const std::string& image_path, const Viewport& screen, std::uint64_t covered_count) {
  const std::uint64_t pixel_count = std::uint64_t(screen.columns) * std::uint64_t(screen.drawn_row_count());
  std::uint64_t percent = (200 * covered_count / pixel_count + 1) / 2;  // rounded half up
  if (covered_count > 0 && covered_count < pixel_count) percent = std::clamp<std::uint64_t>(percent, 1, 99);
  return image_path + ": " + std::to_string(screen.columns) + " x " +
         std::to_string(screen.drawn_row_count()) + ", " + std::to_string(percent) + " % covered";
}

}  // namespace pipeline
