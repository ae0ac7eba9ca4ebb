#include "libpipeline/stream/read_ahead.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libpipeline/stream/stage_reader.h"
#include "tests/text/odd_text.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

constexpr int kNoOddText = 1 << 25;
// The shortest length of a triangle in fixed form.
constexpr std::size_t kMinLength = 91;

/// The triangles that a source delivers, and the message of the error it ends with.
struct Delivery {
  std::vector<Triangle> triangles;
  std::vector<Triangle> low_parts;
  std::vector<std::uint64_t> numbers;
  std::vector<VertexLocations> locations;
  std::vector<std::uint16_t> decimal_marks;
  std::vector<std::array<Vec3, 3>> colors;
  std::vector<Vec3> unclipped;  // first corners of the unclipped triangles
  std::string end;
  friend bool operator==(const Delivery&, const Delivery&) = default;

  void add(TriangleBatch batch) {
    batch.low_parts.resize(batch.size());
    batch.decimal_marks.resize(batch.size());
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(triangles, batch.triangles);
    append(low_parts, batch.low_parts);
    append(numbers, batch.numbers);
    append(locations, batch.locations);
    append(decimal_marks, batch.decimal_marks);
    append(colors, batch.attributes.colors);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const ClipTriangle* const whole = batch.unclipped_of(i);
      unclipped.push_back(whole == nullptr ? Vec3{} : (*whole)[0].position);
    }
  }
};

struct BatchCounts {
  int batches = 0;
  int small_batches = 0;  // batches no larger than a part of the text
};

template <typename Source>
Delivery read_from(Source& source, BatchCounts& counts, std::size_t part_size) {
  Delivery reading;
  reading.end = message_of([&] {
    for (TriangleBatch batch; source.read(batch);) {
      ++counts.batches;
      if (batch.size() <= part_size / kMinLength) ++counts.small_batches;
      reading.add(batch);
    }
  });
  return reading;
}

Delivery read_in_order(const std::string& text) {
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  StageReader source(reader, true);
  source.accept_clipped();
  BatchCounts counts;
  return read_from(source, counts, 0);
}

Delivery read_ahead(int descriptor, int thread_count, std::size_t part_size, BatchCounts& counts) {
  TextReader text(descriptor, "in.txt");
  StageReader source(text, true);
  source.accept_clipped();
  ThreadPool pool(thread_count);
  ReadAhead ahead(source, pool, part_size);
  return read_from(ahead, counts, part_size);
}

/// Returns the counts of the run with the most threads.
BatchCounts expect_same_by_parts(const std::string& text, std::size_t part_size) {
  const Delivery expected = read_in_order(text);
  BatchCounts counts;
  for (const int thread_count : {1, 2, 3, 8}) {
    const TextFile file(text);
    counts = {};
    EXPECT_TRUE(read_ahead(file.descriptor(), thread_count, part_size, counts) == expected)
        << thread_count << " threads, parts of " << part_size;
  }
  return counts;
}

TEST(ReadAhead, DeliversTheTrianglesOfTheReader) {
  expect_same_by_parts("", ReadAhead::kPartSize);
  expect_same_by_parts(odd_stage_text(1, kNoOddText, 1), ReadAhead::kPartSize);
  expect_same_by_parts(odd_stage_text(20000, kNoOddText, 2), ReadAhead::kPartSize);
}

TEST(ReadAhead, ParsesPartsOfTheText) {
  const std::string text = odd_stage_text(5000, kNoOddText, 1);
  for (const std::size_t size : {100u, 1000u, 20000u}) {
    const BatchCounts counts = expect_same_by_parts(text, size);
    // The reader has already read the first line, so it parses the first block itself.
    EXPECT_EQ(counts.small_batches, counts.batches - 1) << size;
    EXPECT_GE(counts.batches, static_cast<int>((text.size() - (1 << 16)) / size)) << size;
  }
}

TEST(ReadAhead, ParsesTextWithAnyDecimals) {
  for (const int decimals : {0, 5, 8, 14}) {
    const std::string text = odd_stage_text(5000, kNoOddText, 1, {decimals, ""});
    const BatchCounts counts = expect_same_by_parts(text, 1000);
    EXPECT_GE(counts.batches, static_cast<int>((text.size() - (1 << 16)) / 1000)) << decimals;
  }
}

TEST(ReadAhead, LeavesOtherTextToTheReader) {
  for (std::uint64_t seed = 3; seed < 10; ++seed) {
    EXPECT_GE(expect_same_by_parts(odd_stage_text(3000, 1000, seed), 1000).small_batches, 2);
    expect_same_by_parts(odd_stage_text(3000, 5, seed), 1000);
  }
  expect_same_by_parts(odd_stage_text(20000, 5000, 3), ReadAhead::kPartSize);
  for (const int decimals : {0, 3, 9, 17})
    expect_same_by_parts(odd_stage_text(5000, 1000, 4, {decimals, ""}), 1000);
  expect_same_by_parts("attributes color\n" + odd_stage_text(5000, 1000, 5, {7, " 1 2 3"}), 1000);
}

TEST(ReadAhead, GoesOnAfterOtherText) {
  const std::string text =
      odd_stage_text(2000, kNoOddText, 6) + "# a comment\n" + odd_stage_text(40000, kNoOddText, 7);
  const BatchCounts counts = expect_same_by_parts(text, 20000);
  EXPECT_GE(counts.batches - counts.small_batches, 10);
  EXPECT_GE(counts.small_batches, 50);
}

TEST(ReadAhead, LeavesTextWithoutBlankLinesToTheReader) {
  RandomNumbers random(7);
  std::string text, with_returns;
  for (int i = 0; i < 3000; ++i) {
    text += three_vertices(random);
    with_returns += "1.0000000 2.0000000 3.0000000\r\n2 2 2\r\n3 3 3\r\n\r\n";
  }
  expect_same_by_parts(text, 1000);
  expect_same_by_parts(with_returns, 1000);
}

TEST(ReadAhead, DeliversErrorsAfterTheTrianglesBeforeThem) {
  const std::string before = odd_stage_text(2500, kNoOddText, 6);
  for (const std::string error :
       {"1 2 3\n4 5 six\n", "1.0000000 2.0000000 3.0000000\n\n", "error view: no\n", "eye 1 2 3\n", "1 2\n",
        "1.0000000 2.0000000 3.0000000 4.0000000\n", "end\n", "1.0000000 2.0000000 1e999\n"})
    for (const std::string& behind : {std::string(), before}) {
      expect_same_by_parts(before + error + behind, 20000);
      expect_same_by_parts(before + error + behind, 1000);
    }
}

TEST(ReadAhead, LeavesTheEndOfATextToTheReader) {
  const std::string text = odd_stage_text(3000, kNoOddText, 7);
  for (const std::string end : {"", "end\n", "end", "end\n1 2 3\n", "\n\n", "1.0000000", "# that is all"})
    for (const std::string header : {"", "framed\n"}) expect_same_by_parts(header + text + end, 20000);
}

TEST(ReadAhead, LeavesClippedTrianglesToTheReader) {
  RandomNumbers random(12);
  std::string text;
  for (const int count : {300, 1, 500}) {
    for (int i = 0; i < count; ++i) text += three_vertices(random) + "\n";
    for (int i = 0; i < 2; ++i) {
      text += "clipped\n";
      for (int k = 0; k < 3; ++k) text += "1 2 3 4\n";
      text += three_vertices(random) + "\n";
    }
  }
  expect_same_by_parts(text, 1000);
}

TEST(ReadAhead, DeliversTheSameFromASlowPipe) {
  const std::string text = odd_stage_text(6000, 3000, 8);
  std::vector<std::string> pieces;
  RandomNumbers random(9);
  for (std::size_t begin = 0; begin < text.size();) {
    pieces.push_back(text.substr(begin, static_cast<std::size_t>(random.whole(1, 30000))));
    begin += pieces.back().size();
  }
  for (const std::size_t part_size : {std::size_t{1000}, ReadAhead::kPartSize}) {
    const TextInPieces pipe(pieces);
    BatchCounts counts;
    EXPECT_TRUE(read_ahead(pipe.descriptor(), 3, part_size, counts) == read_in_order(text));
  }
}

TEST(ReadAhead, DoesNotWaitWithTrianglesToDeliver) {
  const std::string text = odd_stage_text(100, kNoOddText, 10);
  const TextInPieces pipe({text + "0.5"}, TextInPieces::Then::silence);
  TextReader reader(pipe.descriptor(), "in.txt");
  StageReader source(reader);
  ThreadPool pool(3);
  ReadAhead ahead(source, pool, 1000);
  std::size_t count = 0;
  for (TriangleBatch batch; count < 100 && ahead.read(batch);) count += batch.size();
  EXPECT_EQ(count, 100u);
}

TEST(ReadAhead, MayBeDestroyedInTheMiddle) {
  const TextFile file(odd_stage_text(30000, kNoOddText, 10));
  TextReader text(file.descriptor(), "in.txt");
  StageReader source(text);
  ThreadPool pool(3);
  TriangleBatch batch;
  ReadAhead ahead(source, pool);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ahead.read(batch));
}

}  // namespace
}  // namespace pipeline
