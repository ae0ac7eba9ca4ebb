#include "libpipeline/picture/pixel_array.h"

#include <bit>
#include <cstdint>
#include <type_traits>

#include "libpipeline/text/text_writer.h"

namespace pipeline {

static_assert(std::endian::native == std::endian::little);

void check_array_name(const std::string& path) {
  if (extension_of(path) != ".npy" && !is_device_without_extension(path))
    reject_extension(path, "an array file", {".npy"});
}

namespace {

template <typename Number>
class ArrayWriter final : public RowWriter<Number> {
 public:
  ArrayWriter(int descriptor, const std::string& path, const Viewport& screen) : file_(descriptor, path) {
    static_assert(sizeof(Number) == 8);
    const std::string kind = std::is_floating_point_v<Number> ? "<f8" : "<i8";
    std::string description = "{'descr': '" + kind + "', 'fortran_order': False, 'shape': (" +
                              std::to_string(screen.drawn_row_count()) + ", " +
                              std::to_string(screen.columns) + "), }";
    // The numbers begin at a multiple of 64, after a line feed; ten bytes come before the description.
    constexpr std::size_t kStart = 128;
    description.resize(kStart - 11, ' ');
    const char length = static_cast<char>(kStart - 10);
    file_.append(std::string("\x93NUMPY\x01\0", 8) + length + std::string(1, '\0') + description + "\n");
  }

  void write_row(std::span<const Number> numbers) override {
    file_.append({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
  }
  void finish() override { file_.flush(); }

 private:
  TextWriter file_;
};

}  // namespace

template <typename Number>
std::unique_ptr<RowWriter<Number>> array_writer(int descriptor, const std::string& path,
                                                const Viewport& screen) {
  return std::make_unique<ArrayWriter<Number>>(descriptor, path, screen);
}
template std::unique_ptr<RowWriter<double>> array_writer(int, const std::string&, const Viewport&);
template std::unique_ptr<RowWriter<std::int64_t>> array_writer(int, const std::string&, const Viewport&);

}  // namespace pipeline
