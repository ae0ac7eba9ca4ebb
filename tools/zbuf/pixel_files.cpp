#include "tools/zbuf/pixel_files.h"

#include <algorithm>
#include <limits>

#include "libpipeline/picture/depth_text.h"

namespace pipeline {

PixelFiles::PixelFiles(TextWriter& standard_output, const ZbufOptions& chosen, const Viewport& screen)
    : rear_(screen.rear) {
  const auto open = [&](const std::string& path, auto& file, auto& writer) {
    if (path.empty()) return;
    file.emplace(path);
    writer.emplace(file->descriptor(), path, screen);
  };
  if (chosen.z_buffer_path == "-") {
    text_ = &standard_output;
  } else if (chosen.z_buffer_path != "none") {
    text_file_.emplace(chosen.z_buffer_path);
    text_ = &text_of_file_.emplace(text_file_->descriptor(), chosen.z_buffer_path);
  }
  open(chosen.depth_image_path, image_file_, image_);
  open(chosen.depth_array_path, array_file_, array_);
  open(chosen.triangle_array_path, triangles_file_, triangles_);
}

void PixelFiles::write_depths(std::span<const double> depths) {
  if (text_ != nullptr) write_depth_row(*text_, depths, rear_);
  if (image_) image_->write_row(depths);
  if (!array_) return;
  array_row_.assign(depths.begin(), depths.end());
  std::ranges::replace_if(
      array_row_, [this](double depth) { return !(depth < rear_); },
      std::numeric_limits<double>::quiet_NaN());
  array_->write_row(array_row_);
}

void PixelFiles::close() {
  if (text_ != nullptr) text_->flush();
  if (image_) image_->finish();
  if (array_) array_->finish();
  if (triangles_) triangles_->finish();
  for (auto* file : {&text_file_, &image_file_, &array_file_, &triangles_file_})
    if (*file) (*file)->close();
}

void PixelFiles::commit() {
  for (auto* file : {&text_file_, &image_file_, &array_file_, &triangles_file_})
    if (*file) (*file)->commit();
}

}  // namespace pipeline
