#include "libpipeline/scene/spelling.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace pipeline {
namespace {

constexpr std::array<std::string_view, 5> kKnown = {"push", "pop", "triangle", "translate", "end"};

TEST(NearestWord, MayLackALetter) {
  EXPECT_EQ(nearest_word("trangle", kKnown), "triangle");
  EXPECT_EQ(nearest_word("triangl", kKnown), "triangle");
}

TEST(NearestWord, MayHaveALetterTooMany) {
  EXPECT_EQ(nearest_word("triangles", kKnown), "triangle");
  EXPECT_EQ(nearest_word("xpush", kKnown), "push");
}

TEST(NearestWord, MayHaveAnotherLetter) {
  EXPECT_EQ(nearest_word("pusn", kKnown), "push");
}

TEST(NearestWord, MayHaveTwoLettersSwapped) {
  EXPECT_EQ(nearest_word("trianlge", kKnown), "triangle");
  EXPECT_EQ(nearest_word("psuh", kKnown), "push");
}

TEST(NearestWord, IsTheOneWithTheFewestChanges) {
  EXPECT_EQ(nearest_word("trianslate", kKnown), "translate");
}

TEST(NearestWord, MayDifferInEveryThirdLetter) {
  EXPECT_EQ(nearest_word("trxnslxte", kKnown), "translate");
  EXPECT_EQ(nearest_word("pux", kKnown), "");
  EXPECT_EQ(nearest_word("cube", kKnown), "");
}

TEST(NearestWord, OfNothingIsNothing) {
  EXPECT_EQ(nearest_word("", kKnown), "");
  EXPECT_EQ(nearest_word("push", {}), "");
  EXPECT_EQ(nearest_word(std::string(100'000, 'p'), kKnown), "");
}

TEST(SpellingHint, TellsUpperCaseFromAMisspelling) {
  EXPECT_EQ(spelling_hint("Push", kKnown), " (keywords are lower case)");
  EXPECT_EQ(spelling_hint("TRIANGLE", kKnown), " (keywords are lower case)");
  EXPECT_EQ(spelling_hint("Pusch", kKnown), " (did you mean push?)");
  EXPECT_EQ(spelling_hint("quad", kKnown), "");
}

TEST(SpellingHint, IsNoneForAKnownWord) {
  EXPECT_EQ(spelling_hint("push", kKnown), "");
}

}  // namespace
}  // namespace pipeline
