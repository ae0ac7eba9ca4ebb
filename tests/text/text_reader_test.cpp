#include "libpipeline/text/text_reader.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/text/text_input.h"

namespace pipeline {
namespace {

using Lines = std::vector<std::string>;

/// The lines that the reader delivers, without the blanks around them.
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

/// The error of reading the first word of a text as a number.
std::string error_of_number(const std::string& text) {
  const TextFile file(text);
  TextReader reader(file.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  return message_of([&] { line.number("the x of ", "the eye"); });
}

TEST(TextReader, EndsLinesAndLeavesOutCommentsAndBlanks) {
  const std::pair<std::string, Lines> texts[] = {
      {"", {}},
      {"\n", {""}},
      {"a b\n\nc\n", {"a b", "", "c"}},
      {"a\nb", {"a", "b"}},
      {"a\r\n\r\nb\r\n", {"a", "", "b"}},
      {"a\r\nb\r", {"a", "b"}},
      {" \ta \t b\t \n \t \n", {"a \t b", ""}},
      {"a # b\n# c\n#\nd#e # f", {"a", "", "", "d"}},
      {"# a\r\nb", {"", "b"}},
      {"\xEF\xBB\xBF 1\n", {"1"}},
      {"\xEF\xBB\xBF", {}},
      {"a\n\xEF\xBB\xBF*", {"a", "\xEF\xBB\xBF*"}},
      {{"\0\n", 2}, {{'\0'}}},
  };
  for (const auto& [text, lines] : texts) EXPECT_EQ(lines_of(text), lines) << text;
}

TEST(LineScanner, NamesTheNumberThatIsWrong) {
  const Refusal refusals[] = {
      {"1\r2", "1:1: expected the x of the eye, found '1\\x0d2'"},
      {"\xEF\xBB\xBFx", "1:1: expected the x of the eye, found 'x'"},
      {"\xEF\xBB"
       "1",
       "1:1: expected the x of the eye, found '\\xef\\xbb1'"},
      {std::string("1\0 2", 4),
       "1:1: expected the x of the eye, found '1\\x00' (is this UTF-16? save it as UTF-8)"},
      {"\u22121 2",
       "1:1: expected the x of the eye, found '\\xe2\\x88\\x921' (a dash of a printed page: type the minus "
       "sign -)"},
      {"1\u00a02",
       "1:1: expected the x of the eye, found '1\\xc2\\xa02' (a no-break space of a printed page: type a "
       "blank)"},
      {"  1,5 2",
       "1:3: expected the x of the eye, found '1,5' (decimals have a point, and blanks stand between "
       "numbers)"},
      {"-1e309", "1:1: expected the x of the eye within a double's range, found '-1e309'"},
      {"  # 5", "1:1: expected the x of the eye, found the end of the line"},
  };
  for (const auto& [text, error] : refusals) EXPECT_EQ(error_of_number(text), "in.txt:" + error) << text;
}

TEST(TextReader, KnowsACommentFromABlankLine) {
  const TextFile file("# only this\n\n a # and more\n");
  TextReader reader(file.descriptor(), "in.txt");
  std::vector<bool> comments;
  for (LineScanner line; reader.next_line(line);) comments.push_back(line.is_comment());
  EXPECT_EQ(comments, (std::vector<bool>{true, false, false}));
}

TEST(TextReader, AByteOrderMarkDoesNotCountTowardsTheLengthOfALine) {
  const std::string longest(kMaxLineLength, 'x');
  EXPECT_EQ(lines_of("\xEF\xBB\xBF" + longest + "\n"), Lines{longest});
  EXPECT_THROW(lines_of("\xEF\xBB\xBFx" + longest + "\n"), InputError);
}

TEST(TextReader, ReadsLinesAcrossBlocks) {
  // A block is 65536 bytes: in turn, the end of a line, a carriage return and a word lie across its end.
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

TEST(TextReader, ALastLineIsTooLongByOneCharacter) {
  const std::string longest(kMaxLineLength, 'x');
  EXPECT_EQ(lines_of(longest), Lines{longest});
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

TEST(TextReader, KnowsWhereTheTextEndsAndItsBytes) {
  const TextFile file("ab\r\n# c\n");
  TextReader reader(file.descriptor(), "in.txt");
  for (LineScanner line; reader.next_line(line);) {
  }
  EXPECT_EQ(to_string(reader.end_location()), "in.txt:3:1");
  EXPECT_EQ(reader.bytes_read(), 8u);
}

TEST(TextReader, AFailureToReadNamesTheFileAndTheReason) {
  const int folder = ::open("/", O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(message_of([&] { lines_from(folder); }), "cannot read in.txt: Is a directory");
  ::close(folder);
}

TEST(TextReader, NothingIsBufferedBeforeTheFirstRead) {
  const TextFile file("a\n");
  const TextReader reader(file.descriptor(), "in.txt");
  EXPECT_FALSE(reader.has_buffered_lines(1));
}

TEST(TextReader, FilledLinesThatHaveArrivedAreBuffered) {
  const TextInPieces slow({"a\nb\n \t\r\n # b\n\nc\n"}, TextInPieces::Then::silence);
  TextReader reader(slow.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  EXPECT_TRUE(reader.has_buffered_lines(2));
  EXPECT_FALSE(reader.has_buffered_lines(3));
}

TEST(TextReader, HalfALineDoesNotCountAsBuffered) {
  const TextInPieces slow({"a\nb", "c\n"}, TextInPieces::Then::silence);
  TextReader reader(slow.descriptor(), "in.txt");
  LineScanner line;
  reader.next_line(line);
  EXPECT_FALSE(reader.has_buffered_lines(1));
  reader.next_line(line);
  EXPECT_EQ(line.rest(), "bc");
}

// The text before it is delivered first.
TEST(TextReader, AFailureToReadComesAfterTheTextBeforeIt) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
  ASSERT_EQ(::send(ends[1], "a\n\nb\n", 5, 0), 5);
  ASSERT_EQ(::send(ends[0], "never read", 10, 0), 10);
  ::close(ends[1]);  // with unread data: the connection is reset
  TextReader reader(ends[0], "in.txt");
  LineScanner line;
  int line_count = 0;
  const std::string message = message_of([&] {
    while (reader.next_line(line)) ++line_count;
  });
  ::close(ends[0]);
  EXPECT_EQ(line_count, 3);
  EXPECT_EQ(message, "cannot read in.txt: Connection reset by peer");
}

// The beginning.

std::string beginning_from(int descriptor) {
  TextReader reader(descriptor, "in.txt");
  return std::string(reader.beginning());
}

TEST(TextReader, TheBeginningIsTheWholeLinesOfTheFirstBlock) {
  EXPECT_EQ(beginning_from(TextFile("a\n\nb\n").descriptor()), "a\n\nb\n");
  EXPECT_EQ(beginning_from(TextFile("a\n\nb").descriptor()), "a\n\n");
  EXPECT_EQ(beginning_from(TextFile("a").descriptor()), "a");
  EXPECT_EQ(beginning_from(TextFile("").descriptor()), "");
  EXPECT_EQ(beginning_from(TextFile("\xEF\xBB\xBFx\n").descriptor()), "x\n");  // no byte order mark
}

TEST(TextReader, TheBeginningIsNotConsumed) {
  const TextFile file("a\nb\nc\nd\ne\n");
  TextReader reader(file.descriptor(), "in.txt");
  EXPECT_EQ(reader.beginning(), "a\nb\nc\nd\ne\n");
  LineScanner line;
  EXPECT_TRUE(reader.next_line(line));
  EXPECT_EQ(line.location().line, 1u);
  EXPECT_EQ(line.rest(), "a");
}

TEST(TextReader, TheBeginningOfAPipeIsWholeLines) {
  const TextInPieces pieces({"a\nb"}, TextInPieces::Then::silence);
  EXPECT_EQ(beginning_from(pieces.descriptor()), "a\n");
}

TEST(TextReader, TheBeginningWaitsForTheFirstLine) {
  const TextInPieces lines(TextInPieces::bytes_of("ab\n"), TextInPieces::Then::silence);
  EXPECT_EQ(beginning_from(lines.descriptor()), "ab\n");
  const TextInPieces half_a_line(TextInPieces::bytes_of("ab"), TextInPieces::Then::end);
  EXPECT_EQ(beginning_from(half_a_line.descriptor()), "ab");
}

TEST(TextReader, TheBeginningOfALongTextIsShort) {
  std::string comments;
  while (comments.size() < 1'000'000) comments += "# nothing\n";
  EXPECT_LT(beginning_from(TextFile(comments).descriptor()).size(), 200'000u);
  const std::string endless(4 * kMaxLineLength, 'x');
  const TextFile file(endless);
  TextReader reader(file.descriptor(), "in.txt");
  EXPECT_EQ(reader.beginning(), "");
  EXPECT_LT(reader.bytes_read(), 2 * kMaxLineLength);
}

TEST(TextReader, AFailureToReadTheBeginningNamesTheFileAndTheReason) {
  TextReader reader(-1, "in.txt");
  EXPECT_EQ(message_of([&] { reader.beginning(); }), "cannot read in.txt: Bad file descriptor");
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

TEST(LineScanner, ColumnsCountFromOne) {
  const TextFile file("\n  ab\tc");
  TextReader reader(file.descriptor(), "in.txt");
  LineScanner line;
  reader.next_filled_line(line);
  EXPECT_EQ(to_string(line.location()), "in.txt:2:3");
  line.word();
  EXPECT_EQ(to_string(line.location()), "in.txt:2:6");
  line.word();
  EXPECT_EQ(to_string(line.location()), "in.txt:2:7");
}

}  // namespace
}  // namespace pipeline
