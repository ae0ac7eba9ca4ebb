// Parts of a text, as a TextReader hands them out and takes them back.

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "libpipeline/text/text_reader.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

/// Takes parts up to blank lines, of this size, until there is none.
std::vector<std::string> parts_of(TextReader& reader, std::size_t size) {
  std::vector<std::string> parts;
  TextPart part;
  while (reader.take_part("\n\n", 2, size, part)) {
    parts.emplace_back(part.text());
    const std::string slack(part.text().data() + part.text().size(), TextReader::kSlack);  // may be looked at
  }
  return parts;
}

TEST(TextPart, EndsAtABoundary) {
  const TextFile file("a\nb\n\nc\n\nd\n");
  TextReader reader(file.descriptor(), "in.txt");
  EXPECT_EQ(parts_of(reader, 1), std::vector<std::string>{"a\nb\n\nc\n\n"});
  EXPECT_EQ(reader.buffered(), "d\n");
}

TEST(TextPart, WhatIsBehindTheLengthOfABoundaryStays) {
  const TextFile file("a\nb\na\nb\n");
  TextReader reader(file.descriptor(), "in.txt");
  TextPart part;
  ASSERT_TRUE(reader.take_part("\nb", 1, 1, part));
  EXPECT_EQ(part.text(), "a\nb\na\n");
  EXPECT_EQ(reader.buffered(), "b\n");
}

TEST(TextPart, IsNotTakenWithoutABoundary) {
  const TextFile file("a\nb\n");
  TextReader reader(file.descriptor(), "in.txt");
  EXPECT_EQ(parts_of(reader, 100), std::vector<std::string>{});
  LineScanner line;
  EXPECT_TRUE(reader.next_line(line));
  EXPECT_EQ(line.peek(), "a");
}

TEST(TextPart, IsAsLargeAsIsAskedFor) {
  const std::string paragraph = std::string(95, 'a').append("\n\n");
  std::string text;
  for (int i = 0; i < 20000; ++i) text += paragraph;
  constexpr std::size_t kBlock = 1 << 16;
  for (const std::size_t size : {std::size_t{1000}, kBlock, 5 * kBlock}) {
    const TextFile file(text);
    TextReader reader(file.descriptor(), "in.txt");
    std::vector<std::string> parts = parts_of(reader, size);
    std::string joined;
    for (const std::string& part : parts) joined += part;
    EXPECT_TRUE(joined == text);
    parts.pop_back();
    for (const std::string& part : parts) {
      EXPECT_GE(part.size() + paragraph.size(), size);
      EXPECT_LE(part.size(), size + kBlock);
    }
  }
}

TEST(TextPart, MayBePutBack) {
  std::string text;
  for (int i = 0; i < 30000; ++i) text += std::to_string(i) + "\n\n";
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  std::array<TextPart, 3> parts;
  for (TextPart& part : parts) ASSERT_TRUE(reader.take_part("\n\n", 2, 20000, part));
  for (const std::size_t i : {2u, 1u}) reader.put_back(parts[i]);
  const auto line_count = std::ranges::count(parts[0].text(), '\n');
  reader.skip(0, static_cast<std::size_t>(line_count));
  LineScanner line;
  for (auto i = static_cast<std::size_t>(line_count) / 2; i < 30000; ++i) {
    ASSERT_TRUE(reader.next_filled_line(line));
    EXPECT_EQ(line.peek(), std::to_string(i));
    EXPECT_EQ(line.line_number(), 2 * i + 1);
  }
  EXPECT_FALSE(reader.next_filled_line(line));
}

TEST(TextPart, MayBePutBackBehindManyOthers) {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += std::to_string(i) + "\n\n";
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  std::vector<TextPart> parts(1);
  while (reader.take_part("\n\n", 2, 20000, parts.back())) parts.emplace_back();
  parts.pop_back();
  EXPECT_GE(parts.size(), 15u);
  for (std::size_t i = parts.size(); i-- > 0;) reader.put_back(parts[i]);
  EXPECT_TRUE(reader.buffered() == text);
  // That is no part again: it would be one of the whole.
  TextPart part;
  EXPECT_FALSE(reader.take_part("\n\n", 2, 20000, part));
  while (reader.buffered().size() > 20000) reader.skip(reader.buffered().find("\n\n") + 2, 2);
  ASSERT_TRUE(reader.take_part("\n\n", 2, 20000, part));
  EXPECT_TRUE(text.ends_with(part.text()));
  EXPECT_LT(part.buffer.size() + TextReader::kSlack, text.size());
}

TEST(TextPart, AByteOrderMarkInItIsAPartOfAWord) {
  const TextFile file(
      "a\n\n\xEF\xBB\xBF"
      "b\n\n");
  TextReader whole(file.descriptor(), "in.txt");
  LineScanner line;
  ASSERT_TRUE(whole.next_line(line) && whole.next_line(line));
  TextPart part;
  ASSERT_TRUE(whole.take_part("\n\n", 2, 100, part));
  TextReader reader(part);
  ASSERT_TRUE(reader.next_line(line));
  EXPECT_EQ(line.rest(),
            "\xEF\xBB\xBF"
            "b");
}

// No line of the part is given out before: the failure comes behind it.
TEST(TextPart, AFailureToReadDoesNotLoseWhatWasReadBefore) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
  ASSERT_EQ(::send(ends[1], "a\n\nb\n", 6, 0), 6);
  ASSERT_EQ(::send(ends[0], "never read", 10, 0), 10);
  ::close(ends[1]);  // with something unread: a reset connection
  TextReader reader(ends[0], "in.txt");
  TextPart part;
  const bool is_taken = reader.take_part("\n\n", 2, 100, part);
  LineScanner line;
  const std::string message = message_of([&] {
    while (reader.next_line(line)) {
    }
  });
  ::close(ends[0]);
  EXPECT_EQ(message, "cannot read in.txt: Connection reset by peer");
  EXPECT_TRUE(is_taken);
}

}  // namespace
}  // namespace pipeline
