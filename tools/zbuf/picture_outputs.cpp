#include "tools/zbuf/picture_outputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libpipeline/picture/depth_text.h"
#include "libpipeline/picture/pixel_files.h"

namespace pipeline {
namespace {

/// "out.bmp: 400 x 300, 61 % covered". Only an empty picture has 0 %, only a full one 100 %.
std::string summary(const std::string& image_path, const Viewport& screen, std::uint64_t covered_count) {
  const std::uint64_t pixel_count = std::uint64_t(screen.columns) * std::uint64_t(screen.drawn_row_count());
  std::uint64_t percent = (200 * covered_count / pixel_count + 1) / 2;  // rounded half up
  if (covered_count > 0 && covered_count < pixel_count) percent = std::clamp<std::uint64_t>(percent, 1, 99);
  return image_path + ": " + std::to_string(screen.columns) + " x " +
         std::to_string(screen.drawn_row_count()) + ", " + std::to_string(percent) + " % covered";
}

}  // namespace

PictureOutputs::PictureOutputs(Tool& tool, const PictureOptions& chosen, Statistics& statistics)
    : tool_(tool), chosen_(chosen), statistics_(statistics) {
  statistics_.open();
}

void PictureOutputs::close_reports() {
  for (TextWriter* text : texts_) text->flush();
  for (OutputFile& file : files_) file.close();
  statistics_.finish();
}

void PictureOutputs::open(const Viewport& screen, int sample_count, Color background) {
  screen_ = screen;
  if (chosen_.has_image()) {
    image_ = image_writer(opened(image_file_of(chosen_.image_path)), chosen_.image_path, screen.columns,
                          screen.drawn_row_count(), !background.is_opaque());
    if (sample_count > 1) means_.emplace(screen.columns, sample_count, background);
  }
  if (chosen_.z_buffer_path != "none") depths_ = open_text(chosen_.z_buffer_path);
  const auto open_pixels = [&](const std::string& path, auto& writer, const auto& writer_of) {
    if (!path.empty()) writer = writer_of(opened(path), path, screen);
  };
  open_pixels(chosen_.depth_image_path, depth_image_, depth_image_writer);
  open_pixels(chosen_.depth_array_path, depth_array_, array_writer<double>);
  open_pixels(chosen_.triangle_array_path, triangles_, array_writer<std::int64_t>);
}

TextWriter* PictureOutputs::open_text(const std::string& path, bool may_be_stdout) {
  if (path.empty()) return nullptr;
  const bool is_stdout = may_be_stdout && path == "-";
  return texts_.emplace_back(is_stdout ? &tool_.output() : &text_files_.emplace_back(opened(path), path));
}

void PictureOutputs::write_colors(std::span<const Color> colors) {
  if (!means_) return image_->write_row(colors);
  if (const auto complete = means_->add(colors)) image_->write_row(*complete);
}

void PictureOutputs::write_depths(std::span<const double> depths, std::span<const Ball> exact) {
  if (depths_ != nullptr) write_depth_row(*depths_, depths, screen_.rear, exact);
  if (depth_image_) depth_image_->write_row(depths);
  if (!depth_array_) return;
  array_row_.assign(depths.begin(), depths.end());
  std::ranges::replace_if(
      array_row_, [this](double depth) { return !(depth < screen_.rear); },
      std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < exact.size(); ++i)
    if (const double depth = exact[i].nearest_double();
        array_row_[i] == array_row_[i] && std::isfinite(depth))
      array_row_[i] = depth;
  depth_array_->write_row(array_row_);
}

void PictureOutputs::finish(std::uint64_t covered_count) {
  for (TextWriter* text : texts_) text->flush();
  if (depth_image_) depth_image_->finish();
  if (depth_array_) depth_array_->finish();
  if (triangles_) triangles_->finish();
  if (image_) image_->finish();
  for (OutputFile& file : files_) file.close();
  tool_.close_output();
  for (OutputFile& file : files_) file.commit();
  if (chosen_.summarizes) Tool::report(summary(chosen_.image_path, screen_, covered_count));
  statistics_.commit();
  tool_.timing().lap(&Timing::write_seconds);
}

}  // namespace pipeline
