#include "libpipeline/stream/triangle_parts.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <new>
#include <string>
#include <vector>

#include "libpipeline/stream/stage_reader.h"
#include "tests/stream/by_parts.h"
#include "tests/text/odd_text.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

/// What is known of triangles when they are read, and why there are no more.
struct ReadTriangles {
  TriangleBatch all;
  std::vector<Triangle> low_parts;
  std::vector<Vec3> unclipped;  // their first corners
  std::string end = "no error";

  void add(TriangleBatch batch) {
    for (std::size_t i = 0; i < batch.size(); ++i)
      all.add(batch.triangles[i], batch.numbers[i], batch.locations[i]);
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.attributes.w, batch.attributes.w);
    append(all.attributes.colors, batch.attributes.colors);
    append(all.attributes.normals, batch.attributes.normals);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const ClipTriangle* const whole = batch.unclipped_of(i);
      low_parts.push_back(batch.low_parts.empty() ? Triangle{} : batch.low_parts[i]);
      unclipped.push_back(whole == nullptr ? Vec3{} : (*whole)[0].position);
    }
    if (batch.decimal_marks.empty()) return;
    all.decimal_marks.resize(all.size() - batch.size());  // add() has made them longer
    all.decimal_marks.insert(all.decimal_marks.end(), batch.decimal_marks.begin(), batch.decimal_marks.end());
  }
};

template <typename Source>
ReadTriangles read_from(Source& source) {
  ReadTriangles result;
  result.end = message_of([&] {
    for (TriangleBatch batch; source.read(batch);) result.add(batch);
  });
  return result;
}

void expect_same(const ReadTriangles& actual, const ReadTriangles& expected) {
  EXPECT_TRUE(actual.all.triangles == expected.all.triangles);
  EXPECT_TRUE(actual.all.numbers == expected.all.numbers);
  EXPECT_TRUE(actual.all.locations == expected.all.locations);
  EXPECT_TRUE(actual.all.attributes.w == expected.all.attributes.w);
  EXPECT_TRUE(actual.all.attributes.colors == expected.all.attributes.colors);
  EXPECT_TRUE(actual.all.attributes.normals == expected.all.attributes.normals);
  EXPECT_TRUE(actual.low_parts == expected.low_parts);
  EXPECT_TRUE(actual.unclipped == expected.unclipped);
  EXPECT_TRUE(actual.all.decimal_marks == expected.all.decimal_marks);
  EXPECT_EQ(actual.end, expected.end);
}

/// Returns how many parts could be read.
int expect_same_by_parts(const std::string& text, std::size_t part_size) {
  const TextFile file(text), same_file(text);
  TextReader in_order(file.descriptor(), "in.txt"), by_parts(same_file.descriptor(), "in.txt");
  StageReader reader(in_order, true), part_reader(by_parts, true);
  reader.accept_clipped();
  part_reader.accept_clipped();
  const ReadTriangles expected = read_from(reader);
  ByParts parts(part_reader, part_size);
  expect_same(read_from(parts), expected);
  return parts.part_count();
}

TEST(TriangleParts, HoldTheTrianglesTheNumbersAndThePlaces) {
  const std::string text = odd_stage_text(5000, 1 << 25, 1);
  for (const std::size_t size : {1000u, 20000u, 65536u})
    EXPECT_GE(expect_same_by_parts(text, size), 3) << size;
  EXPECT_EQ(expect_same_by_parts(text, 1 << 20), 1);
}

TEST(TriangleParts, MayHoldWhateverATriangleLooksLike) {
  for (std::uint64_t seed = 3; seed < 20; ++seed)
    EXPECT_GE(expect_same_by_parts(odd_stage_text(3000, 1000, seed), 20000), 3);
  for (std::uint64_t seed = 20; seed < 30; ++seed)
    EXPECT_GE(expect_same_by_parts(odd_stage_text(5000, 5, seed), 1000), 3);
}

TEST(TriangleParts, LeaveMistakesToTheSource) {
  RandomNumbers random(4);
  const std::string triangle = three_vertices(random) + "\n";
  const std::string before = odd_stage_text(2500, 1 << 25, 5);
  for (const std::string mistake :
       {"1 2 3\n4 5 six\n", "1.0000000 2.0000000 3.0000000\n\n", "error view: no\n", "eye 1 2 3\n", "1 2\n",
        "1.0000000 2.0000000 3.0000000 4.0000000\n", "end\n", "1.0000000 2.0000000 1e999\n"})
    for (const std::string& behind : {std::string(), triangle, before})
      expect_same_by_parts(before + mistake + behind, 20000);
}

TEST(TriangleParts, LeaveTheEndOfATextToTheSource) {
  const std::string text = odd_stage_text(3000, 1 << 25, 6);
  for (const std::string end : {"", "end\n", "end", "end\n1 2 3\n", "\n\n", "1.0000000", "# that is all"})
    for (const std::string header : {"", "framed\n"}) expect_same_by_parts(header + text + end, 20000);
}

const std::string kColumns = " 2.5 255 0 0.125 0 -1 0.5";  // w, color, normal

TEST(TriangleParts, MayHaveOtherCountsOfDecimalsAndColumns) {
  for (const int decimals : {0, 3, 9, 17})
    for (const std::string& columns : {std::string(), kColumns}) {
      const std::string header = columns.empty() ? "" : "attributes w color normal\n";
      const TextForm form = {decimals, columns};
      EXPECT_GE(expect_same_by_parts(header + odd_stage_text(15000, 1 << 25, 7, form), 20000), 3) << decimals;
      expect_same_by_parts(header + odd_stage_text(40000, 10000, 8, form), 20000);
      expect_same_by_parts(header + odd_stage_text(300, 5, 9, form), 1000);
    }
}

TEST(TriangleParts, MayMixPlainForms) {
  RandomNumbers random(10);
  std::string text;
  for (int i = 0; i < 5000; ++i) text += three_vertices(random, {random.whole(0, 1) == 0 ? 7 : 5, ""}) + "\n";
  EXPECT_GE(expect_same_by_parts(text, 20000), 3);
}

TEST(TriangleParts, LeaveClippedTrianglesToTheSource) {
  RandomNumbers random(12);
  const TextForm form = {7, kColumns};
  std::string text = "attributes w color normal\n";
  for (const int count : {5000, 30000, 20000, 1, 3000}) {
    for (int i = 0; i < count; ++i) text += three_vertices(random, form) + "\n";
    for (int i = 0; i < 2; ++i)
      text += "clipped\n" + three_vertices(random, form) + "\n" + three_vertices(random, form);
  }
  EXPECT_GE(expect_same_by_parts(text, 20000), 10);
}

TEST(TriangleParts, BehindOneThatCannotBeReadAreNotReadEither) {
  const std::string triangles = odd_stage_text(3000, 1 << 25, 13);
  const TextFile file(triangles + "mistake\n" + triangles);
  TextReader text(file.descriptor(), "in.txt");
  StageReader source(text);
  TriangleParts parts(source, 20000);
  TriangleBatch batch;
  source.read(batch);
  TrianglePart part;
  int read_count = 0, left_count = 0;
  while (parts.take(part, batch)) {
    const bool is_read = parts.read(part, batch);
    EXPECT_TRUE(!is_read || left_count == 0);
    ++(is_read ? read_count : left_count);
  }
  EXPECT_GE(read_count, 2);
  EXPECT_GE(left_count, 3);
}

/// Has parts without end, of which the first cannot be read.
class SourceWithoutMemory final : public TriangleSource {
 public:
  bool read(TriangleBatch&) override { return false; }
  bool take_part(std::size_t, TextPart& part, TriangleBatch&) override {
    part.buffer.resize(TextReader::kSlack);
    return true;
  }
  [[nodiscard]] PartContents read_part(TextReader&, TriangleBatch&) const override {
    if (is_first_.exchange(false)) throw std::bad_alloc();
    return {.is_whole = true};
  }
  void put_back(const TextPart&) override {}
  [[nodiscard]] StreamPosition location() const override { return {}; }
  void pass(const StreamPosition&) override {}

 private:
  mutable std::atomic<bool> is_first_ = true;
};

TEST(TriangleParts, AFailureIsThrownAndLetsTheOthersGoOn) {
  SourceWithoutMemory source;
  TriangleParts parts(source, 20000);
  std::array<TrianglePart, 3> taken;
  TriangleBatch batch;
  for (TrianglePart& part : taken) ASSERT_TRUE(parts.take(part, batch));
  EXPECT_THROW(parts.read(taken[0], batch), std::bad_alloc);
  EXPECT_FALSE(parts.read(taken[1], batch));
  EXPECT_FALSE(parts.read(taken[2], batch));
}

TEST(TriangleParts, DoNotWaitForTheInput) {
  RandomNumbers random(8);
  const std::string triangle = three_vertices(random) + "\n";
  const TextInPieces input({triangle + triangle + "0.5", ".25 1 2\n"}, TextInPieces::Then::silence);
  TextReader text(input.descriptor(), "in.txt");
  StageReader source(text);
  TriangleParts parts(source, 20000);
  TriangleBatch batch;
  source.read(batch);  // the first, whose line was looked at behind the header, and the second
  TrianglePart part;
  EXPECT_FALSE(parts.take(part, batch));
  // Parts are not looked for again at once: the source is asked.
  do EXPECT_FALSE(source.take_part(20000, part.text, batch));
  while (!text.buffered().ends_with("0.5.25 1 2\n"));
  EXPECT_FALSE(source.take_part(20000, part.text, batch));
}

/// Lines that are read in order, and a part only from one of them on.
class LinesBeforeAPart final : public TriangleSource {
 public:
  explicit LinesBeforeAPart(std::uint64_t count) : count_(count) {}

  bool read(TriangleBatch&) override { return ++line_ < count_; }
  bool take_part(std::size_t, TextPart&, TriangleBatch&) override {
    ++asked_count_;
    return line_ >= count_;
  }
  [[nodiscard]] PartContents read_part(TextReader&, TriangleBatch&) const override { return {}; }
  void put_back(const TextPart&) override {}
  [[nodiscard]] StreamPosition location() const override { return {.line_count = line_}; }
  void pass(const StreamPosition&) override {}

  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] int asked_count() const { return asked_count_; }

 private:
  std::uint64_t count_;
  std::uint64_t line_ = 0;
  int asked_count_ = 0;
};

TEST(TriangleParts, AreLookedForLessOftenWhereThereAreNone) {
  constexpr std::uint64_t kLongestPause = 1 << 16;
  LinesBeforeAPart source(32 * kLongestPause);
  TriangleParts parts(source, 20000);
  TrianglePart part;
  TriangleBatch batch;
  while (!parts.take(part, batch) && source.line() < 64 * kLongestPause) source.read(batch);
  EXPECT_LE(source.line(), 33 * kLongestPause);
  EXPECT_GE(source.asked_count(), 32);
  EXPECT_LE(source.asked_count(), 40);  // the first pauses are shorter
}

}  // namespace
}  // namespace pipeline
