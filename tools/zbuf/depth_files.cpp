#include "tools/zbuf/depth_files.h"

#include "libpipeline/picture/depth_text.h"

namespace pipeline {

DepthFiles::DepthFiles(TextWriter& standard_output, const std::string& text_path,
                       const std::string& image_path, const std::string& array_path, const Viewport& screen)
    : rear_(screen.rear) {
  if (text_path == "-") {
    text_ = &standard_output;
  } else if (text_path != "none") {
    text_file_.emplace(text_path);
    text_ = &text_of_file_.emplace(text_file_->descriptor(), text_path);
  }
  if (!image_path.empty()) {
    image_file_.emplace(image_path);
    image_.emplace(image_file_->descriptor(), image_path, screen);
  }
  if (!array_path.empty()) {
    array_file_.emplace(array_path);
    array_.emplace(array_file_->descriptor(), array_path, screen);
  }
}

void DepthFiles::write_row(std::span<const double> depths) {
  if (text_ != nullptr) write_depth_row(*text_, depths, rear_);
  if (image_) image_->write_row(depths);
  if (array_) array_->write_row(depths);
}

void DepthFiles::close() {
  if (text_ != nullptr) text_->flush();
  if (image_) image_->finish();
  if (array_) array_->finish();
  if (text_file_) text_file_->close();
  if (image_file_) image_file_->close();
  if (array_file_) array_file_->close();
}

void DepthFiles::commit() {
  if (text_file_) text_file_->commit();
  if (image_file_) image_file_->commit();
  if (array_file_) array_file_->commit();
}

}  // namespace pipeline
