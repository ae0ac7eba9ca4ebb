// Each byte of a text is replaced by every other byte: the text is refused, at a location that is not before
// the change, or read as it now stands.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "libpipeline/scene/config.h"
#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/text/error.h"
#include "libpipeline/vertex/model_stage.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

using Numbers = std::vector<double>;

void append(Numbers& numbers, const TriangleBatch& batch) {
  for (const Triangle& triangle : batch.triangles)
    for (const Vec3& vertex : triangle) numbers.insert(numbers.end(), {vertex.x, vertex.y, vertex.z});
}

Numbers coordinates_of_scene(TextReader& text) {
  SceneReader scene(text);
  CoordinateRounder rounder(Precision::extended, {.decimals = 7, .shortest = true}, text.file());
  ModelStage stage(scene);
  Numbers numbers;
  for (TriangleBatch batch; stage.read(batch);) {
    stage.transform(batch, rounder);
    append(numbers, batch);
  }
  return numbers;
}

Numbers coordinates_of_stage_text(TextReader& text) {
  StageReader reader(text);
  Numbers numbers;
  for (TriangleBatch batch; reader.read(batch);) append(numbers, batch);
  return numbers;
}

Numbers numbers_of_config(TextReader& text) {
  const Viewport screen = read_config(text);
  return {double(screen.columns), double(screen.rows), screen.left, screen.bottom, screen.front, screen.rear};
}

enum class Format { scene, stage_text, config };

/// The numbers that a person would read in the text, except in comments, in a scene's camera (four lines),
/// and on header lines.
Numbers numbers_to_see(const std::string& text, Format format) {
  Numbers numbers;
  int camera_lines = format == Format::scene ? 4 : 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word;
    if (!(words >> word) || camera_lines-- > 0) continue;
    const bool begins_with_word = std::isalpha(static_cast<unsigned char>(word.front())) != 0;
    if (begins_with_word && format == Format::stage_text) continue;  // a line of the header
    if (begins_with_word && !(words >> word)) continue;
    do numbers.push_back(std::strtod(word.c_str(), nullptr));
    while (words >> word);
  }
  return numbers;
}

struct Reading {
  std::function<Numbers(TextReader&)> numbers_of;
  Format format;
};

struct Counts {
  int read = 0;
  int refused = 0;
};

void check_one(const Reading& reading, const std::string& text, std::size_t line_of_change, Counts& counts) {
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in");
  try {
    const Numbers numbers = reading.numbers_of(reader);
    EXPECT_EQ(numbers, numbers_to_see(text, reading.format)) << text;
    ++counts.read;
  } catch (const InputError& error) {
    const auto line_count = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    EXPECT_GE(error.location().line, line_of_change) << error.what() << "\n" << text;
    EXPECT_LE(error.location().line, line_count) << error.what() << "\n" << text;
    ++counts.refused;
  }
}

Counts change_every_byte(const Reading& reading, const std::string& text) {
  Counts counts;
  for (std::size_t position = 0; position < text.size(); ++position) {
    const auto line = static_cast<std::size_t>(
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n') + 1);
    for (int change = 1; change < 256; ++change) {
      std::string changed = text;
      changed[position] = static_cast<char>(text[position] ^ change);
      check_one(reading, changed, line, counts);
    }
  }
  EXPECT_EQ(counts.read + counts.refused, 255 * static_cast<int>(text.size()));
  return counts;
}

TEST(CorruptedText, AnyByteOfASceneIsRefusedOrReadAsItReads) {
  const Counts counts = change_every_byte(
      {coordinates_of_scene, Format::scene},
      "0 0 5\n0 0.5 0\n0 1 0\n60 1 1 100\ntriangle\n0 0 -2\n1 0.5 -2e-1 # x\n+0 1 -2.25\nend\n");
  EXPECT_GT(counts.read, 300);
  EXPECT_GT(counts.refused, 1000);
}

TEST(CorruptedText, AnyByteOfAStageTextIsRefusedOrReadAsItReads) {
  const Counts counts = change_every_byte({coordinates_of_stage_text, Format::stage_text},
                                          "eye 0 0 5\nlook 0 0 0\nup 0 1 0\northo -1 1 -1 1 1 9\n0.0000000 "
                                          "0.0000000 -2.0000000\n1 0.5 -2e-1 # x\n0 1 -2\n\n");
  EXPECT_GT(counts.read, 300);
  EXPECT_GT(counts.refused, 1000);
}

TEST(CorruptedText, AnyByteOfAFramedTextIsRefusedOrReadAsItReads) {
  const Counts counts =
      change_every_byte({coordinates_of_stage_text, Format::stage_text},
                        "framed\n0.0000000 0.0000000 0.2500000\n1 0.5 -2e-1\n0 1 1\n\nend\n");
  EXPECT_GT(counts.read, 300);
  EXPECT_GT(counts.refused, 1000);
}

TEST(CorruptedText, AnyByteOfAConfigIsRefusedOrReadAsItReads) {
  const Counts counts =
      change_every_byte({numbers_of_config, Format::config}, "12 8\n-0.5\n-0.25 # bottom\n-1 1\n");
  EXPECT_GT(counts.read, 300);
  EXPECT_GT(counts.refused, 1000);
}

}  // namespace
}  // namespace pipeline
