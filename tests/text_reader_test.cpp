#include "libpipeline/text_reader.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tests/text_input.h"

namespace pipeline {
namespace {

using Lines = std::vector<std::string>;

/// The lines as the reader gives them out, without the blanks around them.
Lines lines_from(int descriptor) {
  TextReader reader(descriptor, "in.txt");
  LineScanner line;
  Lines lines;
  while (reader.next_line(line)) lines.emplace_back(line.rest());
  return lines;
}

Lines lines_of(const std::string& text) {
  return lines_from(TextFile(text).descriptor());
}

std::string error_of_reading(const std::string& text) {
  return message_of([&] { lines_of(text); });
}

/// What `use` says about the first line of a text.
template <typename Use>
std::string error_in(const std::string& text, Use&& use) {
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  return message_of([&] { use(line); });
}

std::string error_of_number(const std::string& text) {
  return error_in(text, [](LineScanner& line) { line.number("the x of ", "the eye"); });
}

double number_in(const std::string& text) {
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  return line.number("a number");
}

TEST(TextReader, AnEmptyTextHasNoLines) {
  EXPECT_EQ(lines_of(""), Lines{});
}

TEST(TextReader, ANewlineAloneIsOneBlankLine) {
  EXPECT_EQ(lines_of("\n"), Lines{""});
}

TEST(TextReader, EndsLinesAtNewlines) {
  EXPECT_EQ(lines_of("a b\n\nc\n"), (Lines{"a b", "", "c"}));
}

TEST(TextReader, TheLastLineNeedsNoNewline) {
  EXPECT_EQ(lines_of("a\nb"), (Lines{"a", "b"}));
}

TEST(TextReader, EndsLinesAtCarriageReturnAndNewline) {
  EXPECT_EQ(lines_of("a\r\n\r\nb\r\n"), (Lines{"a", "", "b"}));
}

TEST(TextReader, TheLastLineMayEndWithACarriageReturn) {
  EXPECT_EQ(lines_of("a\r\nb\r"), (Lines{"a", "b"}));
}

TEST(TextReader, ACarriageReturnInsideALineIsAPartOfAWord) {
  EXPECT_EQ(error_of_number("1\r2"), "in.txt:1:1: expected the x of the eye, found '1\\x0d2'");
}

TEST(TextReader, DropsBlanksAroundALine) {
  EXPECT_EQ(lines_of(" \ta \t b\t \n \t \n"), (Lines{"a \t b", ""}));
}

TEST(TextReader, LeavesOutComments) {
  EXPECT_EQ(lines_of("a # b\n# c\n#\nd#e # f"), (Lines{"a", "", "", "d"}));
}

TEST(TextReader, ACommentDoesNotHideTheNextLine) {
  EXPECT_EQ(lines_of("# a\r\nb"), (Lines{"", "b"}));
}

TEST(TextReader, KnowsACommentFromABlankLine) {
  const TextFile file("# only this\n\n a # and more\n");
  TextReader reader(file.descriptor(), "in.txt");
  std::vector<bool> comments;
  for (LineScanner line; reader.next_line(line);) comments.push_back(line.is_comment());
  EXPECT_EQ(comments, (std::vector<bool>{true, false, false}));
}

TEST(TextReader, SkipsAByteOrderMarkAtTheStart) {
  EXPECT_EQ(lines_of("\xEF\xBB\xBF 1\n"), Lines{"1"});
}

TEST(TextReader, CountsColumnsAfterAByteOrderMark) {
  EXPECT_EQ(error_of_number("\xEF\xBB\xBFx"), "in.txt:1:1: expected the x of the eye, found 'x'");
}

TEST(TextReader, AByteOrderMarkAloneIsABlankLine) {
  EXPECT_EQ(lines_of("\xEF\xBB\xBF"), Lines{""});
}

TEST(TextReader, AByteOrderMarkElsewhereIsAPartOfAWord) {
  EXPECT_EQ(lines_of("a\n\xEF\xBB\xBF"
                     "b"),
            (Lines{"a",
                   "\xEF\xBB\xBF"
                   "b"}));
}

TEST(TextReader, HalfAByteOrderMarkIsAPartOfAWord) {
  EXPECT_EQ(error_of_number("\xEF\xBB"
                            "1"),
            "in.txt:1:1: expected the x of the eye, found '\\xef\\xbb1'");
}

TEST(TextReader, ANulByteIsAPartOfAWord) {
  EXPECT_EQ(error_of_number(std::string("1\0 2", 4)),
            "in.txt:1:1: expected the x of the eye, found '1\\x00'");
}

TEST(TextReader, ANulByteAloneIsNotABlankLine) {
  EXPECT_EQ(lines_of(std::string("\0\n", 2)), Lines{std::string(1, '\0')});
}

TEST(TextReader, ReadsLinesAcrossBlocks) {
  // A block is 65536 bytes: the line ends, a carriage return or a word lie on its border in turn.
  for (std::size_t length = 65530; length < 65542; ++length) {
    const std::string filler(length, 'x');
    EXPECT_EQ(lines_of(filler + " 12\r\n34\r\n56"), (Lines{filler + " 12", "34", "56"})) << length;
  }
}

TEST(TextReader, ReadsManyBlocks) {
  std::string text;
  Lines expected;
  for (int i = 0; i < 100000; ++i) {
    expected.push_back(std::to_string(i));
    text += expected.back() + "\n";
  }
  EXPECT_EQ(lines_of(text), expected);
}

TEST(TextReader, ReadsTextThatArrivesByteByByte) {
  const TextInPieces slow(TextInPieces::bytes_of("\xEF\xBB\xBFone two\r\n\r\n# three\nfour"));
  EXPECT_EQ(lines_from(slow.descriptor()), (Lines{"one two", "", "", "four"}));
}

TEST(TextReader, TakesALineOfTheGreatestLength) {
  const std::string longest(kMaxLineLength, 'x');
  EXPECT_EQ(lines_of(longest + "\ny"), (Lines{longest, "y"}));
}

TEST(TextReader, TakesALastLineOfTheGreatestLength) {
  const std::string longest(kMaxLineLength, 'x');
  EXPECT_EQ(lines_of(longest), Lines{longest});
}

TEST(TextReader, ALineIsTooLongByOneCharacter) {
  EXPECT_EQ(error_of_reading("a\n" + std::string(kMaxLineLength + 1, 'x') + "\n"),
            "in.txt:2:1048577: expected the end of the line, found more than 1048576 characters");
}

TEST(TextReader, ALastLineIsTooLongByOneCharacter) {
  EXPECT_EQ(error_of_reading(std::string(kMaxLineLength + 1, 'x')),
            "in.txt:1:1048577: expected the end of the line, found more than 1048576 characters");
}

TEST(TextReader, ALineWithoutEndIsAnErrorBeforeItFillsTheMemory) {
  const int zeros = ::open("/dev/zero", O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(message_of([&] { lines_from(zeros); }),
            "in.txt:1:1048577: expected the end of the line, found more than 1048576 characters");
  ::close(zeros);
}

TEST(TextReader, FilledLinesPassOverBlankLinesAndComments) {
  const TextFile file("\n \t\n# a\r\nb\n\n");
  TextReader reader(file.descriptor(), "in.txt");
  LineScanner line;
  ASSERT_TRUE(reader.next_filled_line(line));
  EXPECT_EQ(line.word(), "b");
  EXPECT_EQ(line.line_number(), 4u);
  EXPECT_FALSE(reader.next_filled_line(line));
}

TEST(TextReader, TheEndIsThePlaceAfterTheLastLine) {
  const TextFile file("a\nb\n");
  TextReader reader(file.descriptor(), "in.txt");
  for (LineScanner line; reader.next_line(line);) {
  }
  EXPECT_EQ(to_string(reader.end_place()), "in.txt:3:1");
}

TEST(TextReader, TheEndOfAnEmptyTextIsItsStart) {
  const TextFile file("");
  const TextReader reader(file.descriptor(), "in.txt");
  EXPECT_EQ(to_string(reader.end_place()), "in.txt:1:1");
}

TEST(TextReader, CountsTheBytesItHasRead) {
  const TextFile file("ab\r\n# c\n");
  TextReader reader(file.descriptor(), "in.txt");
  for (LineScanner line; reader.next_line(line);) {
  }
  EXPECT_EQ(reader.bytes_read(), 8u);
}

TEST(TextReader, AFailureToReadNamesTheFileAndTheReason) {
  const int folder = ::open("/", O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(message_of([&] { lines_from(folder); }), "cannot read in.txt: Is a directory");
  ::close(folder);
}

TEST(TextReader, NoLineWaitsBeforeTheFirstRead) {
  const TextFile file("a\n");
  const TextReader reader(file.descriptor(), "in.txt");
  EXPECT_FALSE(reader.has_lines_waiting(1));
}

TEST(TextReader, LinesThatHaveArrivedAreWaiting) {
  const TextInPieces slow({"a\nb\nc\n"}, TextInPieces::Then::silence);
  TextReader reader(slow.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  EXPECT_TRUE(reader.has_lines_waiting(2));
  EXPECT_FALSE(reader.has_lines_waiting(3));
}

TEST(TextReader, HalfALineIsNotWaiting) {
  const TextInPieces slow({"a\nb", "c\n"}, TextInPieces::Then::silence);
  TextReader reader(slow.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  EXPECT_FALSE(reader.has_lines_waiting(1));
  reader.next_line(line);
  EXPECT_EQ(line.rest(), "bc");
}

TEST(TextReader, BlankLinesAndCommentsAreNotWaitedFor) {
  const TextInPieces slow({"a\n\n \t\r\n # b\n\n"}, TextInPieces::Then::silence);
  TextReader reader(slow.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  EXPECT_FALSE(reader.has_lines_waiting(1));
}

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

TEST(TextReader, PartsEndAtABoundary) {
  const TextFile file("a\nb\n\nc\n\nd\n");
  TextReader reader(file.descriptor(), "in.txt");
  EXPECT_EQ(parts_of(reader, 1), std::vector<std::string>{"a\nb\n\nc\n\n"});
  EXPECT_EQ(reader.waiting(), "d\n");
}

TEST(TextReader, WhatIsBehindTheLengthOfABoundaryStays) {
  const TextFile file("a\nb\na\nb\n");
  TextReader reader(file.descriptor(), "in.txt");
  TextPart part;
  ASSERT_TRUE(reader.take_part("\nb", 1, 1, part));
  EXPECT_EQ(part.text(), "a\nb\na\n");
  EXPECT_EQ(reader.waiting(), "b\n");
}

TEST(TextReader, ATextWithoutABoundaryHasNoPart) {
  const TextFile file("a\nb\n");
  TextReader reader(file.descriptor(), "in.txt");
  EXPECT_EQ(parts_of(reader, 100), std::vector<std::string>{});
  LineScanner line;
  EXPECT_TRUE(reader.next_line(line));
  EXPECT_EQ(line.peek(), "a");
}

TEST(TextReader, PartsAreAsLargeAsIsAskedFor) {
  const std::string paragraph = std::string(95, 'a') + "\n\n";
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

TEST(TextReader, PartsMayBePutBack) {
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

TEST(TextReader, ManyPartsMayBePutBack) {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += std::to_string(i) + "\n\n";
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  std::vector<TextPart> parts(1);
  while (reader.take_part("\n\n", 2, 20000, parts.back())) parts.emplace_back();
  parts.pop_back();
  EXPECT_GE(parts.size(), 15u);
  for (std::size_t i = parts.size(); i-- > 0;) reader.put_back(parts[i]);
  EXPECT_TRUE(reader.waiting() == text);
  // That is no part again: it would be one of the whole.
  TextPart part;
  EXPECT_FALSE(reader.take_part("\n\n", 2, 20000, part));
  while (reader.waiting().size() > 20000) reader.skip(reader.waiting().find("\n\n") + 2, 2);
  ASSERT_TRUE(reader.take_part("\n\n", 2, 20000, part));
  EXPECT_TRUE(text.ends_with(part.text()));
  EXPECT_LT(part.buffer.size() + TextReader::kSlack, text.size());
}

TEST(TextReader, AByteOrderMarkInAPartIsAPartOfAWord) {
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

TEST(TextReader, SaysWhenItIsAboutToWait) {
  const TextInPieces input({"a\nb\n"}, TextInPieces::Then::silence);
  TextReader reader(input.descriptor(), "in.txt");
  LineScanner line;
  ASSERT_TRUE(reader.next_line(line));
  int count = 0;
  reader.set_before_waiting([&] { throw ++count; });  // rather than wait
  ASSERT_TRUE(reader.next_line(line));
  EXPECT_EQ(count, 0);
  EXPECT_THROW(reader.next_line(line), int);
  EXPECT_EQ(count, 1);
}

// No line of the part is given out before: the failure comes behind it.
TEST(TextReader, AFailureToReadDoesNotLoseWhatWasReadBefore) {
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

TEST(LineScanner, TakesWordsBetweenBlanksAndTabs) {
  const TextFile file("  ab\tc \t d\n");
  TextReader reader(file.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  EXPECT_EQ(line.word(), "ab");
  EXPECT_EQ(line.peek(), "c");
  EXPECT_EQ(line.word(), "c");
  EXPECT_EQ(line.rest(), "d");
  EXPECT_EQ(line.word(), "d");
  EXPECT_TRUE(line.at_end());
  EXPECT_EQ(line.word(), "");
}

TEST(LineScanner, PlacesAreColumnsFromOne) {
  const TextFile file("\n  ab\tc");
  TextReader reader(file.descriptor(), "in.txt");
  LineScanner line;
  reader.next_filled_line(line);
  EXPECT_EQ(to_string(line.place()), "in.txt:2:3");
  const std::string_view first = line.word();
  EXPECT_EQ(to_string(line.place()), "in.txt:2:6");
  EXPECT_EQ(to_string(line.place_of(first)), "in.txt:2:3");
  line.word();
  EXPECT_EQ(to_string(line.place()), "in.txt:2:7");
}

TEST(LineScanner, ReadsNumbersInEveryDecimalForm) {
  EXPECT_EQ(number_in("12"), 12);
  EXPECT_EQ(number_in("+12.5"), 12.5);
  EXPECT_EQ(number_in("-.5"), -0.5);
  EXPECT_EQ(number_in("5."), 5);
  EXPECT_EQ(number_in("1e3"), 1000);
  EXPECT_EQ(number_in("+1.5E-1"), 0.15);
}

TEST(LineScanner, NamesThePlaceOfABadNumber) {
  EXPECT_EQ(error_of_number("  1,5 2"), "in.txt:1:3: expected the x of the eye, found '1,5'");
}

TEST(LineScanner, WhatOnlyLooksLikeANumberIsAnError) {
  for (const std::string word :
       {"nan", "inf", "-inf", "0x10", "1.5abc", "1e", "--1", "+-1", ".", "+", "1_000"})
    EXPECT_EQ(error_of_number(word), "in.txt:1:1: expected the x of the eye, found '" + word + "'");
}

TEST(LineScanner, SaysThatANumberIsTooLarge) {
  EXPECT_EQ(error_of_number("-1e309"),
            "in.txt:1:1: expected the x of the eye within a double's range, found '-1e309'");
}

TEST(LineScanner, NamesTheEndOfTheLineWhereANumberIsMissing) {
  EXPECT_EQ(error_of_number("  # 5"), "in.txt:1:1: expected the x of the eye, found the end of the line");
}

TEST(LineScanner, NamesThePlaceBehindTheLastWordWhereANumberIsMissing) {
  EXPECT_EQ(error_in("12 \t # 5", [](LineScanner& line) { line.word(), line.number("a number"); }),
            "in.txt:1:3: expected a number, found the end of the line");
}

TEST(LineScanner, CountsAreWholeNumbersWithoutASign) {
  for (const std::string word : {"-1", "+1", "1.0", "1e3", "x", "18446744073709551616"})
    EXPECT_EQ(error_in(word, [](LineScanner& line) { line.count("the number of a triangle"); }),
              "in.txt:1:1: expected the number of a triangle, found '" + word + "'");
}

TEST(LineScanner, NamesWhatStandsTooMuchOnALine) {
  EXPECT_EQ(
      error_in("1 2 3", [](LineScanner& line) { line.word(), line.expect_end("the x of ", "the eye"); }),
      "in.txt:1:3: expected the end of the line after the x of the eye, found '2'");
}

}  // namespace
}  // namespace pipeline
