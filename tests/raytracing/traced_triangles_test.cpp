#include "libpipeline/raytracing/traced_triangles.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// The batch that a reader makes of the text of these triangles.
TriangleBatch read_back(const TriangleBatch& batch) {
  std::string text;
  for (const Triangle& triangle : batch.triangles) {
    for (const Vec3& p : triangle)
      text += shortest_text(p.x) + " " + shortest_text(p.y) + " " + shortest_text(p.z) + "\n";
    text += "\n";
  }
  int ends[2];
  if (pipe(ends) != 0) return {};
  EXPECT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  close(ends[1]);
  TextReader source(ends[0], "text");
  StageReader reader(source, true);
  TriangleBatch result;
  for (TriangleBatch part; reader.read(part);)
    for (std::size_t i = 0; i < part.size(); ++i) {
      result.add(part.triangles[i], result.size(), {});
      result.decimal_marks.resize(result.size());
      result.decimal_marks.back() = part.decimal_marks[i];
    }
  close(ends[0]);
  return result;
}

constexpr unsigned kDecimalXAndY = 0b011'011'011;

TEST(PassThroughText, MarksWhatAReaderMarks) {
  std::mt19937_64 rng(1);
  const auto number = [&]() -> double {
    switch (rng() % 5) {
      case 0:
        return std::round(std::ldexp(static_cast<double>(rng() >> 11), -static_cast<int>(rng() % 60))) / 1e7;
      case 1:
        return static_cast<double>(static_cast<std::int64_t>(rng() % 2001) - 1000) / 1000;
      case 2:
        return std::ldexp(static_cast<double>(rng() >> 11), -53 - static_cast<int>(rng() % 40));
      case 3:
        return static_cast<double>(rng() % 100) * std::pow(10.0, static_cast<double>(rng() % 40) - 12);
      default:
        return -static_cast<double>(rng() % 3) * 0.1;
    }
  };
  for (int round = 0; round < 30; ++round) {
    TriangleBatch batch;
    for (int i = 0; i < 100; ++i) {
      Triangle triangle;
      for (Vec3& p : triangle) p = {number(), number(), number()};
      batch.add(triangle, batch.size(), {});
    }
    const TriangleBatch expected = read_back(batch);
    pass_through_text(batch);
    ASSERT_EQ(batch.triangles, expected.triangles);
    for (std::size_t i = 0; i < batch.size(); ++i)
      ASSERT_EQ(batch.decimal_marks[i], expected.decimal_marks[i] & kDecimalXAndY) << i;
  }
}

TEST(PassThroughText, LeavesNoSignOfZero) {
  TriangleBatch batch;
  batch.add({Vec3{-0.0, -0.0, -0.0}}, 0, {});
  pass_through_text(batch);
  EXPECT_FALSE(std::signbit(batch.triangles[0][0].x) || std::signbit(batch.triangles[0][0].z));
}

}  // namespace
}  // namespace pipeline
