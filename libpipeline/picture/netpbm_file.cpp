#include <cstddef>

#include "libpipeline/picture/image_formats.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {
namespace {

class NetpbmWriter final : public ByteWriter {
 public:
  NetpbmWriter(int descriptor, const std::string& path, const std::string& header)
      : descriptor_(descriptor), path_(path), buffered_(header) {}

  void write_row(std::span<const unsigned char> bytes) override {
    constexpr std::size_t kBufferSize = std::size_t{1} << 16;
    buffered_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (buffered_.size() >= kBufferSize) finish();
  }
  void finish() override {
    write_all(descriptor_, buffered_, path_);
    buffered_.clear();
  }

 private:
  int descriptor_;
  std::string path_;
  std::string buffered_;
};

}  // namespace

std::unique_ptr<ByteWriter> netpbm_writer(int descriptor, const std::string& path, PixelBytes pixels,
                                          int columns, int rows) {
  const bool is_color = pixels == PixelBytes::rgb8;
  const std::string size = std::to_string(columns) + " " + std::to_string(rows);
  return std::make_unique<NetpbmWriter>(
      descriptor, path, (is_color ? "P6\n" : "P5\n") + size + (is_color ? "\n255\n" : "\n65535\n"));
}

}  // namespace pipeline
