#include "libpipeline/picture/image_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <thread>
#include <vector>

#include "libpipeline/picture/image_formats.h"
#include "libpipeline/visibility/raster.h"
#include "tests/text/temporary_folder.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

using namespace std::string_literals;

/// An image file in the format of the extension `format`.
void write_image(int descriptor, const std::string& format, const Raster<Color>& image) {
  const auto writer = image_writer(descriptor, "image" + format, image.columns(), image.row_range().end);
  for (int row = 0; row < image.row_range().end; ++row) writer->write_row(image.row(row));
  writer->finish();
}

std::string bytes_in_file(const std::string& format, const Raster<Color>& image, int more_flags = 0) {
  const TemporaryFolder folder;
  const int descriptor = ::open(folder.path("image").c_str(), O_WRONLY | O_CREAT | more_flags, 0600);
  write_image(descriptor, format, image);
  ::close(descriptor);
  return folder.read("image");
}

std::string bytes_in_pipe(const std::string& format, const Raster<Color>& image) {
  int ends[2];
  if (::pipe(ends) != 0) return "no pipe";
  std::string bytes;
  std::thread reader([&] {
    char block[4096];
    for (ssize_t count; (count = ::read(ends[0], block, sizeof block)) > 0;)
      bytes.append(block, static_cast<std::size_t>(count));
  });
  write_image(ends[1], format, image);
  ::close(ends[1]);
  reader.join();
  ::close(ends[0]);
  return bytes;
}

/// Larger than the blocks of 64 KiB in which a BMP file is written.
Raster<Color> large_image() {
  Raster<Color> image({0, 1501}, 999, Color());
  for (int row = 0; row < image.row_range().end; ++row)
    for (int column = 0; column < image.columns(); ++column)
      image.row(row)[static_cast<std::size_t>(column)] =
          Color::from_rgb(static_cast<std::uint32_t>(row * 4099 + column));
  return image;
}

TEST(ImageFile, EveryPixelOfALargeBmpIsInItsPlace) {
  const Raster<Color> image = large_image();
  const std::string bytes = bytes_in_file(".bmp", image);
  ASSERT_EQ(bytes.size(), 54u + 1501 * 3000);
  for (int row = 0; row < 1501; ++row)
    for (int column = 0; column < 999; ++column) {
      const std::size_t at =
          54 + static_cast<std::size_t>(1500 - row) * 3000 + 3 * static_cast<std::size_t>(column);
      const std::uint32_t rgb = static_cast<std::uint32_t>(row * 4099 + column);
      ASSERT_EQ(bytes[at], static_cast<char>(rgb));
      ASSERT_EQ(bytes[at + 1], static_cast<char>(rgb >> 8));
      ASSERT_EQ(bytes[at + 2], static_cast<char>(rgb >> 16));
    }
}

TEST(ImageFile, WhereThereIsNoSeekingTheBytesAreTheSame) {
  const Raster<Color> image = large_image();
  const std::string bmp = bytes_in_file(".bmp", image);
  EXPECT_TRUE(bytes_in_pipe(".bmp", image) == bmp);
  EXPECT_TRUE(bytes_in_pipe(".ppm", image) == bytes_in_file(".ppm", image));
  EXPECT_TRUE(bytes_in_file(".bmp", image, O_APPEND) == bmp);
}

/// The error of writing an image to a file of that name.
std::string first_two_bytes(const std::string& name) {
  const TemporaryFolder folder;
  const int descriptor = ::open(folder.path("image").c_str(), O_WRONLY | O_CREAT, 0600);
  const auto writer = image_writer(descriptor, name, 1, 1);
  writer->write_row(std::vector<Color>(1));
  writer->finish();
  ::close(descriptor);
  return folder.read("image").substr(0, 2);
}

TEST(ImageFile, TheExtensionChoosesTheFormat) {
  EXPECT_EQ(first_two_bytes("out.bmp"), "BM");
  EXPECT_EQ(first_two_bytes("some.folder/OUT.BMP"), "BM");
  EXPECT_EQ(first_two_bytes("out.bmp.Ppm"), "P6");
}

TEST(ImageFile, PngIsAFormatWhereItCanBeWritten) {
  const std::string expected = can_write_png()
                                   ? "no error"
                                   : "out.Png: expected an image file that ends in .bmp or .ppm (this build "
                                     "is without libpng, which .png needs), found '.Png'";
  EXPECT_EQ(message_of([] { check_image_name("out.Png"); }), expected);
}

TEST(ImageFile, ADeviceGetsPpm) {
  EXPECT_EQ(first_two_bytes("/dev/null"), "P6");
  EXPECT_EQ(first_two_bytes("/dev/stdout"), "P6");
}

TEST(ImageFile, AnyOtherExtensionIsAnErrorThatNamesTheKnownOnes) {
  const std::string known = can_write_png() ? ".bmp, .ppm or .png" : ".bmp or .ppm";
  EXPECT_EQ(message_of([] { check_image_name("out.gif"); }),
            "out.gif: expected an image file that ends in " + known + ", found '.gif'");
  EXPECT_EQ(message_of([] { check_image_name("a.bmp/out"); }),
            "a.bmp/out: expected an image file that ends in " + known + ", found a name without extension");
  EXPECT_EQ(message_of([] { check_image_name(".bmp"); }),
            ".bmp: expected an image file that ends in " + known + ", found a name without extension");
}

TEST(ImageFile, BmpEndsAtFourGiB) {
  // A row of 65535 pixels has 196608 bytes; 54 + 196608 * 21845 = 4294901814 < 2^32.
  EXPECT_EQ(message_of([] { check_image_size("out.bmp", 65535, 21845); }), "no error");
  EXPECT_EQ(message_of([] { check_image_size("out.bmp", 65535, 21846); }),
            "out.bmp: expected an image that fits into the 4 GiB of a .bmp file (--image FILE.ppm has no "
            "such limit), "
            "found 65535 x 21846 pixels, 4295098422 bytes");
  EXPECT_EQ(message_of([] { image_writer(STDOUT_FILENO, "out.bmp", 65535, 65535); }),
            "out.bmp: expected an image that fits into the 4 GiB of a .bmp file (--image FILE.ppm has no "
            "such limit), "
            "found 65535 x 65535 pixels, 12884705334 bytes");
  EXPECT_EQ(message_of([] { check_image_size("out.ppm", 65535, 65535); }), "no error");
}

}  // namespace
}  // namespace pipeline
