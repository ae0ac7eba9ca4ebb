#include "libpipeline/stream/stage_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/stream/stage_text_io.h"

namespace pipeline {
namespace {

constexpr Triangle kWritten = {Vec3{0, -1, 2.5}, Vec3{-0.0, 1e-9, -1e-9}, Vec3{123456789, 0.12345675, -3}};

TriangleBatch numbered(std::initializer_list<std::uint64_t> numbers) {
  TriangleBatch batch;
  for (const std::uint64_t number : numbers) batch.add({}, number, {});
  return batch;
}

/// The text, with each triangle shortened to a dot.
std::string written_numbers(std::initializer_list<std::uint64_t> numbers, bool bare = false) {
  std::string text = written(numbered(numbers), {.shortest = true}, bare);
  for (std::size_t at = 0; (at = text.find("0 0 0\n0 0 0\n0 0 0\n\n")) != std::string::npos;)
    text.replace(at, 19, ".");
  return text;
}

TEST(StageWriter, NothingIsAnEmptyText) {
  EXPECT_EQ(written({}), "");
}

TEST(StageWriter, WritesTheDecimalsAskedForAndZeroWithoutASign) {
  TriangleBatch batch;
  batch.add(kWritten, 0, {});
  EXPECT_EQ(written(batch),
            "0.0000000 -1.0000000 2.5000000\n0.0000000 0.0000000 0.0000000\n123456789.0000000 0.1234568 "
            "-3.0000000\n\n");
  EXPECT_EQ(written(batch, {.decimals = 0}), "0 -1 2\n0 0 0\n123456789 0 -3\n\n");
  EXPECT_EQ(written(batch, {.shortest = true}), "0 -1 2.5\n0 1e-09 -1e-09\n123456789 0.12345675 -3\n\n");
}

TEST(StageWriter, WritesTheHeaderInTheShortestFormWhateverTheDecimals) {
  StageHeader header;
  header.framed = true;
  header.camera.eye = {Vec3{0.1, -0.0, 1e300}, {}};
  header.camera.look = {Vec3{1.0 / 3, 0, 5e-324}, {}};
  header.camera.up = {Vec3{0, 1, 0}, {}};
  header.camera.projection = {Perspective{60, 1.5, 0.5, 100}, {}};
  EXPECT_EQ(written({}, {.decimals = 2}, false, header),
            "framed\neye 0.1 0 1e+300\nlook 0.3333333333333333 0 5e-324\nup 0 1 0\nperspective 60 1.5 0.5 "
            "100\nend\n");
}

TEST(StageWriter, NamesNoAspectRuleButRatio) {
  StageHeader header;
  header.camera.projection = {Perspective{60, 1.5, 0.5, 100, AspectRule::angle}, {}};
  EXPECT_EQ(written({}, {}, false, header), "perspective 60 1.5 0.5 100\n");
  header.camera.projection = {Perspective{60, 1.5, 0.5, 100, AspectRule::ratio}, {}};
  EXPECT_EQ(written({}, {}, false, header), "perspective 60 1.5 0.5 100 ratio\n");
}

TEST(StageWriter, WritesAWindowProjectedOrNot) {
  const Projection projections[] = {Frustum{-1, 2, -3, 4, 5, 6}, Orthographic{-1, 2, -3, 4, -5, 6}};
  const std::string expected[] = {"frustum -1 2 -3 4 5 6\n", "ortho -1 2 -3 4 -5 6\n"};
  for (std::size_t i = 0; i < 2; ++i) {
    StageHeader before, after;
    before.camera.projection = {projections[i], {}};
    EXPECT_EQ(written({}, {}, false, before), expected[i]);
    after.projected = {projections[i], {}};
    EXPECT_EQ(written({}, {}, false, after), "projected " + expected[i]);
  }
}

TEST(StageWriter, BareTextIsTrianglesAlone) {
  StageHeader header;
  header.projected = {Frustum{-1, 2, -3, 4, 5, 6}, {}};
  header.framed = true;
  header.camera.up = {Vec3{0, 1, 0}, {}};
  EXPECT_EQ(written(numbered({4}), {.shortest = true}, true, header), "0 0 0\n0 0 0\n0 0 0\n\n");
}

TEST(StageWriter, WritesNumbersWhereCountingGoesWrong) {
  EXPECT_EQ(written_numbers({0, 1, 2}), "...");
  EXPECT_EQ(written_numbers({0, 2, 3}), ".triangle 2\n..");
  EXPECT_EQ(written_numbers({1, 2}), "triangle 1\n..");
  EXPECT_EQ(written_numbers({0, 0, 0, 1}), ".triangle 0\n.triangle 0\n..");
  EXPECT_EQ(written_numbers({0, 0, 5}, true), "...");
}

TEST(StageWriter, CountsOnAcrossBatches) {
  const TextFile file("");
  TextWriter text(file.descriptor(), "out.txt");
  StageWriter writer(text, {.shortest = true}, false);
  writer.write(numbered({0, 1}));
  writer.write(numbered({2}));
  writer.write(numbered({3, 5}));
  writer.finish();
  const std::string written = file.whole_text();
  EXPECT_EQ(std::count(written.begin(), written.end(), 't'), 1) << written;
}

TEST(StageWriter, WritesTheLongestNumbers) {
  TriangleBatch batch;
  const Vec3 longest = {-0x1.fffffffffffffp1023, -0x1.fffffffffffffp1023, -0x1.fffffffffffffp1023};
  for (std::uint64_t i = 0; i < 100; ++i) batch.add({longest, longest, longest}, 18446744073709551615u, {});
  const std::string text = written(batch, {.decimals = kMaxDecimals});
  EXPECT_EQ(text.size(), 100 * (30 + 9 * (1 + 309 + 1 + 17 + 1) + 1));
}

}  // namespace
}  // namespace pipeline
