#include "libpipeline/stream/read_ahead.h"

#include <gtest/gtest.h>

#include <string>

#include "libpipeline/stream/stage_reader.h"
#include "tests/text/odd_text.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

struct Reading {
  TriangleBatch all;
  std::string end;
};

template <typename Source>
Reading read_from(Source& source) {
  Reading reading;
  reading.end = message_of([&] {
    for (TriangleBatch batch; source.read(batch);)
      for (std::size_t i = 0; i < batch.size(); ++i)
        reading.all.add(batch.triangles[i], batch.numbers[i], batch.locations[i]);
  });
  return reading;
}

void expect_same_for_all_threads(const std::string& text) {
  const TextFile file(text);
  TextReader in_order(file.descriptor(), "in.txt");
  StageReader source(in_order);
  const Reading expected = read_from(source);
  for (const int thread_count : {1, 2, 3, 8}) {
    const TextFile same_file(text);
    TextReader same_text(same_file.descriptor(), "in.txt");
    StageReader same_source(same_text);
    ThreadPool pool(thread_count);
    ReadAhead ahead(same_source, pool);
    const Reading actual = read_from(ahead);
    EXPECT_TRUE(actual.all.triangles == expected.all.triangles) << thread_count << " threads";
    EXPECT_TRUE(actual.all.numbers == expected.all.numbers) << thread_count << " threads";
    EXPECT_TRUE(actual.all.locations == expected.all.locations) << thread_count << " threads";
    EXPECT_EQ(actual.end, expected.end);
  }
}

TEST(ReadAhead, GivesWhatTheSourceGives) {
  expect_same_for_all_threads("");
  expect_same_for_all_threads(odd_stage_text(1, 1 << 25, 1));
  expect_same_for_all_threads(odd_stage_text(30000, 1 << 25, 2));
}

TEST(ReadAhead, GivesWhatTheSourceGivesOfTextInOtherForms) {
  expect_same_for_all_threads(odd_stage_text(50000, 5000, 3));
  expect_same_for_all_threads(odd_stage_text(5000, 10, 4));
  expect_same_for_all_threads("attributes color\n" + odd_stage_text(20000, 5000, 5, {7, " 1 2 3"}));
}

TEST(ReadAhead, GivesMistakesBehindTheTrianglesBeforeThem) {
  expect_same_for_all_threads(odd_stage_text(20000, 1 << 25, 6) + "0.5 0.5 six\n" +
                              odd_stage_text(20000, 1 << 25, 7));
}

TEST(ReadAhead, GivesTheSameOfAPipeThatIsFilledSlowly) {
  const std::string text = odd_stage_text(6000, 3000, 8);
  const TextFile file(text);
  TextReader in_order(file.descriptor(), "in.txt");
  StageReader source(in_order);
  const Reading expected = read_from(source);
  std::vector<std::string> pieces;
  RandomNumbers random(9);
  for (std::size_t begin = 0; begin < text.size();) {
    pieces.push_back(text.substr(begin, static_cast<std::size_t>(random.whole(1, 30000))));
    begin += pieces.back().size();
  }
  const TextInPieces pipe(pieces);
  TextReader same_text(pipe.descriptor(), "in.txt");
  StageReader same_source(same_text);
  ThreadPool pool(3);
  ReadAhead ahead(same_source, pool);
  const Reading actual = read_from(ahead);
  EXPECT_TRUE(actual.all.triangles == expected.all.triangles);
  EXPECT_TRUE(actual.all.locations == expected.all.locations);
  EXPECT_EQ(actual.end, expected.end);
}

TEST(ReadAhead, MayBeGivenUpInTheMiddle) {
  const TextFile file(odd_stage_text(30000, 1 << 25, 10));
  TextReader text(file.descriptor(), "in.txt");
  StageReader source(text);
  ThreadPool pool(3);
  TriangleBatch batch;
  ReadAhead ahead(source, pool);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ahead.read(batch));
}

}  // namespace
}  // namespace pipeline
