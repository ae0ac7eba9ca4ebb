#include "libpipeline/text/error.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "tests/text/text_input.h"

namespace pipeline {
namespace {

TEST(SourceLocation, NamesFileLineAndColumn) {
  EXPECT_EQ(to_string({"in.txt", 3, 14}), "in.txt:3:14");
}

TEST(SourceLocation, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_string({"in.txt", 3, 0}), "in.txt:3");
  EXPECT_EQ(to_string({"in.txt", 0, 0}), "in.txt");
  EXPECT_EQ(to_string({"in.txt", 0, 5}), "in.txt");
}

TEST(SourceLocation, TellsAnOptionFromAFile) {
  EXPECT_TRUE((SourceLocation{"--eye"}.is_option()));
  EXPECT_FALSE((SourceLocation{"-"}.is_option()));
  EXPECT_FALSE((SourceLocation{""}.is_option()));
}

TEST(InputError, StartsWithItsPlace) {
  const InputError error({"in.txt", 3, 14}, expected_but_found("a number", "'x'"));
  EXPECT_EQ(std::string(error.what()), "in.txt:3:14: expected a number, found 'x'");
  EXPECT_EQ(to_string(error.location()), "in.txt:3:14");
}

TEST(IoError, NamesWhatFailedTheFileAndTheReason) {
  const IoError error("open", "in.txt", ENOENT);
  EXPECT_EQ(std::string(error.what()), "cannot open in.txt: No such file or directory");
  EXPECT_EQ(error.error_number(), ENOENT);
}

TEST(Quoted, KeepsPrintableCharacters) {
  EXPECT_EQ(pipeline::quoted("a 'b' ~"), "'a 'b' ~'");
}

TEST(Quoted, ShowsOtherBytesInHexadecimal) {
  EXPECT_EQ(pipeline::quoted(std::string_view("\0\t\x1b\x7f\xc3\xa9", 6)),
            "'\\x00\\x09\\x1b\\x7f\\xc3\\xa9'");
}

TEST(Quoted, CutsWhatIsLongerThanFortyBytes) {
  EXPECT_EQ(pipeline::quoted(std::string(40, 'a')), "'" + std::string(40, 'a') + "'");
  EXPECT_EQ(pipeline::quoted(std::string(41, 'a')), "'" + std::string(40, 'a') + "...'");
}

TEST(Quoted, NothingIsAPairOfQuotes) {
  EXPECT_EQ(pipeline::quoted(""), "''");
}

TEST(Counted, OneIsSingular) {
  EXPECT_EQ(counted(0, "triangle"), "0 triangles");
  EXPECT_EQ(counted(1, "triangle"), "1 triangle");
  EXPECT_EQ(counted(18446744073709551615u, "pixel"), "18446744073709551615 pixels");
}

TEST(OnOneLine, ShowsControlCharactersInHexadecimal) {
  EXPECT_EQ(on_one_line("a\nb\r\x7f"), "a\\x0ab\\x0d\\x7f");
}

TEST(OnOneLine, KeepsAllOtherBytes) {
  EXPECT_EQ(on_one_line("#a 'b' \xc3\xa9"), "#a 'b' \xc3\xa9");
}

}  // namespace
}  // namespace pipeline
