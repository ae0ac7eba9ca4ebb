#include "libpipeline/stream/stage_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/stream/stage_text_io.h"

namespace pipeline {
namespace {

const std::string kTriangle = "0 0 0\n1 0 0\n0 1 0\n\n";

StageHeader header_of(const std::string& text) {
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  return StageReader(reader).header();
}

std::string error_of(const std::string& text) {
  return message_of([&] { triangles_of(text); });
}

// A comment keeps a line from the fast paths.
TEST(StageReader, TrianglesAreTheSameByEveryPath) {
  for (const std::string header : {"", "attributes w color normal\n"}) {
    const std::string columns = header.empty() ? "" : " 2.5 255 0 0.125 0 -1 0.5";
    for (const std::string vertex :
         {"0.1000000 -2.0000000 3.0000000", "0.10000000 -2.00000000 3.00000000", "0.100 -2.000 3.000",
          "1 -2 3", "0.123456789 5 -.5", " \t0.125 5 -.5", "0.30000000000000004 1e2 7",
          "123456789.25 12345678.1234567 0.12345678"}) {
      const auto text = [&](const std::string& comment) {
        const std::string line = vertex + columns + comment + "\n";
        return header + line + line + line + "\n" + line + line + line;
      };
      const auto read = [](const std::string& from) {
        const TextFile file(from);
        TextReader reader(file.descriptor(), "in.txt");
        StageReader stage(reader, true);
        TriangleBatch batch;
        stage.read(batch);
        return batch;
      };
      const TriangleBatch fast = read(text(""));
      const TriangleBatch slow = read(text(" # slow"));
      ASSERT_EQ(fast.size(), 2u);
      EXPECT_EQ(fast.triangles, slow.triangles) << text("");
      EXPECT_EQ(fast.locations, slow.locations) << text("");
      EXPECT_EQ(fast.numbers, slow.numbers) << text("");
      EXPECT_EQ(fast.decimal_marks, slow.decimal_marks) << text("");
      EXPECT_EQ(fast.attributes.w, slow.attributes.w) << text("");
      EXPECT_EQ(fast.attributes.colors, slow.attributes.colors) << text("");
      EXPECT_EQ(fast.attributes.normals, slow.attributes.normals) << text("");
    }
  }
}

// A comment or another count of decimals keeps a line from the fastest path.
TEST(StageReader, ColumnsAreTheSameByEveryPathInOneText) {
  std::string text = "attributes w color normal\n";
  constexpr int kCount = 5000;
  for (int i = 0; i < kCount; ++i) {
    const std::string end = i % 700 == 5 ? "0\n" : i % 900 == 7 ? " #\n" : "\n";
    const std::string line = std::to_string(i / 10) + "." + std::to_string(i % 10) + " -0.5 2.0 1.75 255 0 " +
                             std::to_string(i % 256) + " 0.125 -0.500 1.00" + std::to_string(i % 10) + end;
    text += line + line + line + "\n";
  }
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  StageReader stage(reader, true);
  std::size_t count = 0;
  for (TriangleBatch batch; stage.read(batch);) {
    for (std::size_t i = 0; i < batch.size(); ++i, ++count) {
      const Vec3 position = {static_cast<double>(count) / 10, -0.5, 2};
      const Vec3 color = {255, 0, static_cast<double>(count % 256)};
      const Vec3 normal = {0.125, -0.5, static_cast<double>(1000 + count % 10) / 1000};
      ASSERT_EQ(batch.triangles[i], (Triangle{position, position, position})) << count;
      ASSERT_EQ(batch.attributes.w.at(i), (std::array<double, 3>{1.75, 1.75, 1.75})) << count;
      ASSERT_EQ(batch.attributes.colors.at(i), (Triangle{color, color, color})) << count;
      ASSERT_EQ(batch.attributes.normals.at(i), (Triangle{normal, normal, normal})) << count;
      const std::size_t line = 4 * count + 2;
      ASSERT_EQ(batch.locations[i], (VertexLocations{line, line + 1, line + 2})) << count;
      ASSERT_EQ(batch.numbers[i], count);
      ASSERT_EQ(batch.decimal_marks[i], 0x1ff) << count;
    }
    ASSERT_EQ(batch.attributes.w.size(), batch.size());
    ASSERT_EQ(batch.attributes.colors.size(), batch.size());
    ASSERT_EQ(batch.attributes.normals.size(), batch.size());
  }
  EXPECT_EQ(count, static_cast<std::size_t>(kCount));
}

// Behind so many triangles of the fast path that the wrong one is not the first of its block.
TEST(StageReader, AValueOutOfRangeIsAnErrorAfterFastTriangles) {
  for (const std::string wrong : {"256.0 0.0 0.0", "0.0 -1.0 0.0"}) {
    std::string text = "attributes w color\n";
    const std::string fine = "0.5 0.5 0.5 1.5 1.0 2.0 3.0\n";
    for (int i = 0; i < 100; ++i) text += fine + fine + fine + "\n";
    const std::string channel = wrong[0] == '2' ? "red" : "green";
    const std::string value = wrong[0] == '2' ? "256.0" : "-1.0";
    const std::string column = wrong[0] == '2' ? "17" : "21";
    EXPECT_EQ(
        error_of(text + fine + "0.5 0.5 0.5 1.5 " + wrong + "\n" + fine + "\n" + fine + fine + fine),
        "in.txt:403:" + column + ": expected the " + channel +
            " of vertex 2 of 3 (x y z w r g b, by the line 'attributes w color') from 0 to 255, found '" +
            value + "'");
    EXPECT_EQ(error_of(text + fine + "0.5 0.5 0.5 0.0 1.0 2.0 3.0\n" + fine),
              "in.txt:403:13: expected the w of vertex 2 of 3 (x y z w r g b, by the line 'attributes w "
              "color') above 0, found '0.0'");
  }
}

TEST(StageReader, KeepsTheDigitsADoubleHasNoRoomForOfAnyTriangle) {
  // 2^53 + 0.5 and 2^53 - 1; between triangles whose numbers have fewer digits.
  const std::string plain = "0 0 0\n1 0 0\n0 1 0 # slow\n\n";
  const TextFile file(plain + "0 0 0\n9007199254740992.5 9007199254740991 0\n0 1 0\n\n" + plain);
  TextReader reader(file.descriptor(), "in.txt");
  StageReader stage(reader, true);
  TriangleBatch batch;
  ASSERT_TRUE(stage.read(batch));
  ASSERT_EQ(batch.size(), 3u);
  EXPECT_EQ(batch.triangles[1][1], (Vec3{0x1p53, 0x1p53 - 1, 0}));
  EXPECT_EQ(batch.low_parts, (std::vector<Triangle>{{}, {Vec3{}, Vec3{0.5, 0, 0}, Vec3{}}, {}}));
  EXPECT_EQ(batch.decimal_marks, (std::vector<std::uint16_t>(3, 0x1ff)));
}

TEST(StageReader, NumbersTrianglesFromZeroOrAsTheTextSays) {
  const std::pair<std::string, std::vector<std::uint64_t>> texts[] = {
      {kTriangle + kTriangle + kTriangle, {0, 1, 2}},
      {kTriangle + "triangle 5\n" + kTriangle + kTriangle + "triangle 2\n" + kTriangle, {0, 5, 6, 2}},
      {"triangle 5 # c\n\n" + kTriangle, {5}},
      {"triangle 18446744073709551615\n" + kTriangle, {18446744073709551615u}},
  };
  for (const auto& [text, numbers] : texts) EXPECT_EQ(triangles_of(text).numbers, numbers) << text;
}

TEST(StageReader, ReadsTextThatArrivesByteByByte) {
  const TextInPieces slow(TextInPieces::bytes_of("framed\nup 0 1 0\ntriangle 7\n" + kTriangle + "end\n"));
  const TriangleBatch batch = triangles_from(slow.descriptor());
  EXPECT_EQ(batch.triangles, triangles_of(kTriangle).triangles);
  EXPECT_EQ(batch.numbers, std::vector<std::uint64_t>{7});
}

TEST(StageReader, ReadsMoreTrianglesThanABatchHolds) {
  std::string text;
  for (std::size_t i = 0; i < 2 * kBatchSize + 1; ++i) text += kTriangle;
  const TriangleBatch batch = triangles_of(text);
  ASSERT_EQ(batch.size(), 2 * kBatchSize + 1);
  EXPECT_EQ(batch.numbers.back(), 2 * kBatchSize);
}

TEST(StageReader, GivesOutBatchesOfLimitedSize) {
  std::string text;
  for (std::size_t i = 0; i < 2 * kBatchSize + 1; ++i) text += "0 0 0\n0 0 0\n0 0 0\n";
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  StageReader stage(reader);
  for (TriangleBatch batch; stage.read(batch);) EXPECT_LE(batch.size(), kBatchSize);
}

TEST(StageReader, ReadsOnAtTheEndAsOftenAsAsked) {
  const TextFile file(kTriangle);
  TextReader reader(file.descriptor(), "in.txt");
  StageReader stage(reader);
  TriangleBatch batch;
  EXPECT_TRUE(stage.read(batch));
  EXPECT_FALSE(stage.read(batch));
  EXPECT_TRUE(batch.empty());
  EXPECT_FALSE(stage.read(batch));
}

// The header.

TEST(StageReader, KnowsTheLinesAboutTheCamera) {
  const StageHeader header = header_of(
      "framed\n  up 0 1 0\nlight 0 0 0 1 1 1\northo -1 1 -1 1 0 1\nprojected ortho -1 1 -1 1 0 1\nend\n");
  std::string lines;
  for (const auto& [keyword, location] : header.camera_lines)
    lines += to_string(location) + " " + keyword + "; ";
  EXPECT_EQ(lines, "in.txt:2:3 up; in.txt:4:1 ortho; in.txt:5:1 projected; ");
}

TEST(StageReader, KnowsWhetherThereIsMoreThanAHeader) {
  for (const std::string text : {"", "eye 0 0 5\n", "# c\n"}) {
    const TextFile file(text);
    TextReader reader(file.descriptor(), "in.txt");
    EXPECT_FALSE(StageReader(reader).has_body()) << text;
  }
  for (const std::string text : {"0 0 0\n", "eye 0 0 5\ntriangle 7\n", "framed\nend\n"}) {
    const TextFile file(text);
    TextReader reader(file.descriptor(), "in.txt");
    EXPECT_TRUE(StageReader(reader).has_body()) << text;
  }
}

TEST(StageReader, NamesWhatIsWrong) {
  const Refusal refusals[] = {
      {"eye 0 0 5\n\neye 0 0 5\n", "3:1: expected one eye, found a second one after in.txt:1:5"},
      {"framed\n  framed\n", "2:3: expected one 'framed', found a second one after in.txt:1:1"},
      {"perspective 60 1 1 100\northo -1 1 -1 1 1 9\n",
       "2:1: expected one projection, found a second one after in.txt:1:13"},
      {"eye 0 x 5\n", "1:7: expected the y of the eye, found 'x'"},
      {"look 0 0\n", "1:9: expected the z of the point looked at, found the end of the line"},
      {"up 0 1 0 0\n", "1:10: expected the end of the line after the z of the up direction, found '0'"},
      {"perspective 60 1 nan 100\n", "1:18: expected near, found 'nan'"},
      {"framed 1\n", "1:8: expected the end of the line after 'framed', found '1'"},
      {"look 0 0 5\neye 0 0 5\n", "1:6: expected a point other than the eye to look at, found 0 0 5"},
      {"perspective 60 1 2 1\n", "1:20: expected far beyond near, found '1'"},
      {kTriangle + "eye 0 0 5\n", "5:1: expected header lines before the first triangle, found 'eye'"},
      {"triangle 1\nframed\n", "2:1: expected header lines before the first triangle, found 'framed'"},
      {"eyes 0 0 5\n",
       "1:1: expected a header line, 'triangle N' or a vertex, found 'eyes' (did you mean eye?)"},
      {kTriangle + "quad\n", "5:1: expected 'triangle N' or a vertex, found 'quad'"},
      {"triangle -1\n" + kTriangle,
       "1:10: expected the number of a triangle, a whole number below 2^64, found '-1'"},
      {"triangle\n" + kTriangle,
       "1:9: expected the number of a triangle, a whole number below 2^64, found the end of the line"},
      {"triangle 18446744073709551616\n",
       "1:10: expected the number of a triangle, a whole number below 2^64, found '18446744073709551616'"},
      {"triangle 1 2\n", "1:12: expected the end of the line after the number of a triangle, found '2'"},
      {"0 0 0\ntriangle 1\n1 0 0\n0 1 0\n", "2:1: expected the x of vertex 2 of 3, found 'triangle'"},
      {"0 0 0\n\n1 0 0\n0 1 0\n", "2:1: expected vertex 2 of 3, found a blank line inside a triangle"},
      {"0 0 0\n1 0 0\n \t\r\n0 1 0\n", "3:1: expected vertex 3 of 3, found a blank line inside a triangle"},
      {"0 0 0\n", "2:1: expected vertex 2 of 3, found the end of the input inside a triangle"},
      {kTriangle + "0 0 0\n1 0 0\n# c",
       "8:1: expected vertex 3 of 3, found the end of the input inside a triangle"},
      {"0 0 0\n1 0,5 0\n0 1 0\n",
       "2:3: expected the y of vertex 2 of 3, found '0,5' (decimals have a point, and blanks stand between "
       "numbers)"},
      {"-nan 0 0\n", "1:1: expected the x of vertex 1 of 3, found '-nan'"},
      {"0 0 0\n1 0 0\n0 1\n", "3:4: expected the z of vertex 3 of 3, found the end of the line"},
      {"0 0 0\n1 0 0\n0 1 1e309\n",
       "3:5: expected the z of vertex 3 of 3 within a double's range, found '1e309'"},
      {"0 0 0 1\n", "1:7: expected the end of the line after the z of vertex 1 of 3, found '1'"},
      {"0 0 0\n1 0 0\nend\n", "3:1: expected the x of vertex 3 of 3, found 'end'"},
      {"0 0 0\nnan 0 0\n", "2:1: expected the x of vertex 2 of 3, found 'nan'"},
      {"inf 0 0\n", "1:1: expected a header line, 'triangle N' or a vertex, found 'inf'"},
      {"eye 0 0 5\nerror model: scene.txt:7:1: expected X, found 'Y'\n",
       "2:1: an earlier stage failed: model: scene.txt:7:1: expected X, found 'Y'"},
      {"error model: cannot open a#b.txt: No such file or directory\n",
       "1:1: an earlier stage failed: model: cannot open a#b.txt: No such file or directory"},
      {"error a: b\n", "1:1: an earlier stage failed: a: b"},
      {"framed\nerror a: b\n", "2:1: an earlier stage failed: a: b"},
      {kTriangle + "error a: b\n", "5:1: an earlier stage failed: a: b"},
      {"triangle 2\nerror a: b", "2:1: an earlier stage failed: a: b"},
      {"0 0 0\nerror a: b\n", "2:1: an earlier stage failed: a: b"},
      {"0 0 0\n1 0 0\n# c\nerror a: b\n", "4:1: an earlier stage failed: a: b"},
      {"framed\nend\nerror a: b\n", "3:1: an earlier stage failed: a: b"},
      {"error a: b\nnonsense\n", "1:1: an earlier stage failed: a: b"},
      {"error\n", "1:1: an earlier stage failed, without saying why"},
      {"framed\n" + kTriangle, "6:1: expected 'end', which closes a framed text, found the end of the input"},
      {"framed\n" + kTriangle + "end",
       "6:4: expected the end of the line after 'end', which closes a framed text, found the end of the "
       "input"},
      {"framed\nend\n" + kTriangle, "3:1: expected nothing after 'end', found '0'"},
      {"framed\nend 1\n", "2:5: expected the end of the line after 'end', found '1'"},
      {kTriangle + "end\n",
       "5:1: expected 'triangle N' or a vertex ('end' needs a line 'framed' in the header), found 'end'"},
      {"attributes w color\n0 0 0 1 2 3\n",
       "2:12: expected the blue of vertex 1 of 3 (x y z w r g b, by the line 'attributes w color'), found "
       "the end of the line"},
      {"attributes w\n0 0 0 1 2\n",
       "2:9: expected the end of the line after vertex 1 of 3 (x y z w, by the line 'attributes w'), found "
       "'2'"},
      {"attributes w\n0 0 0 -1\n",
       "2:7: expected the w of vertex 1 of 3 (x y z w, by the line 'attributes w') above 0, found '-1'"},
      {"attributes normal color\n",
       "1:19: expected attributes of [w] [color] [normal] [material], in this order, found 'color'"},
      {kTriangle + "light 0 0 0 1 1 1\n",
       "5:1: expected header lines before the first triangle, found 'light'"},
  };
  for (const auto& [text, error] : refusals) EXPECT_EQ(error_of(text), "in.txt:" + error) << text;
}

TEST(StageReader, KnowsWhereItsHeaderEnds) {
  for (const auto& [text, place] :
       {std::pair("# c\nup 0 1 0\n\n 0 0 0\n1 0 0\n0 1 0\n", "in.txt:4:2"), {"", "in.txt:1:1"}}) {
    const TextFile file(text);
    TextReader reader(file.descriptor(), "in.txt");
    EXPECT_EQ(to_string(StageReader(reader).header_end()), place);
  }
}

// Errors in triangles.

TEST(StageReader, DeliversTheTrianglesBeforeAnError) {
  const TextFile file(kTriangle + kTriangle + "0 0 x\n");
  TextReader reader(file.descriptor(), "in.txt");
  StageReader stage(reader);
  TriangleBatch batch;
  ASSERT_TRUE(stage.read(batch));
  EXPECT_EQ(batch.size(), 2u);
  EXPECT_EQ(message_of([&] { stage.read(batch); }), "in.txt:9:5: expected the z of vertex 1 of 3, found 'x'");
}

// Framed text.

TEST(StageReader, DoesNotWaitForTheFirstTriangleToKnowTheHeader) {
  const TextInPieces slow({"up 0 1 0\n0 0 0\n"}, TextInPieces::Then::silence);
  TextReader text(slow.descriptor(), "in.txt");
  EXPECT_TRUE(StageReader(text).header().camera.up);
}

const std::string kTwoMaterials = "attributes w material\nmaterial 1 1 0 1\nmaterial 1 1 0 2\n";

TEST(StageReader, FindsAWrongMaterialBehindABlockOfTriangles) {
  const std::string good = "0 0 0 1 1\n1 0 0 1 1\n0 1 0 1 1\n\n";
  EXPECT_EQ(error_of(kTwoMaterials + good + good + "0 0 0 1 1\n1 0 0 1 0\n0 1 0 1 1\n\n"),
            "in.txt:13:9: expected the material of the triangle's first vertex, 1, found '0'");
  EXPECT_EQ(error_of(kTwoMaterials + good + "0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n\n"),
            "in.txt:8:9: expected the material of vertex 1 of 3 (x y z w material, by the line 'attributes w "
            "material'), a whole number below 2, found '2'");
}

TEST(StageReader, APieceHasTheMaterialOfTheTriangleItWasCutFrom) {
  const auto pieces = [](const std::string& first, const std::string& second) {
    const auto triangle = [](const std::string& material) {
      return "0 0 0 1 " + material + "\n1 0 0 1 " + material + "\n0 1 0 1 " + material + "\n\n";
    };
    return kTwoMaterials + "clipped\n" + triangle("1") + triangle(first) + "triangle 0\n" + triangle(second) +
           triangle("0");
  };
  const auto error_in = [](const std::string& in) {
    const TextFile file(in);
    TextReader text(file.descriptor(), "in.txt");
    StageReader reader(text);
    reader.accept_clipped();
    return message_of([&] {
      for (TriangleBatch batch; reader.read(batch);) {
      }
    });
  };
  EXPECT_EQ(error_in(pieces("1", "1")), "no error");
  EXPECT_EQ(error_in(pieces("0", "1")),
            "in.txt:9:9: expected the material of the triangle that was clipped, 1, found '0'");
  EXPECT_EQ(error_in(pieces("1", "0")),
            "in.txt:14:9: expected the material of the triangle that was clipped, 1, found '0'");
}

}  // namespace
}  // namespace pipeline
