// Options of a tool, read from its --help-all, and values for them.

#pragma once

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/require.h"

namespace pipeline {

/// An option of a tool, with the kinds of its values.
using Option = std::vector<std::string>;

/// The options in the output of --help-all, so that a new one is tried from its first day on. --timing is
/// left out, since it reports more than a reason.
inline std::vector<Option> options_in(const std::string& help_all) {
  std::istringstream help(help_all);
  std::vector<Option> options;
  for (std::string line; std::getline(help, line);) {
    if (!line.starts_with("  -")) continue;
    std::istringstream words(line.substr(line.find("--"), line.find("  ", 2) - line.find("--")));
    Option option{std::istream_iterator<std::string>(words), {}};
    if (option[0] != "--help" && option[0] != "--version" && option[0] != "--timing")
      options.push_back(option);
  }
  require(options.size() > 5, "--help-all lists the options");
  return options;
}

/// A value of a kind: one of `a|b`, or one that its name in --help stands for.
inline std::string value_of(const std::string& kind, FuzzBytes& bytes) {
  static const std::map<std::string, std::string> kFixed = {
      {"FILE", "/dev/null"}, {"WIDTHxHEIGHT", "5x4"}, {"RRGGBB[AA]", "12345678"},
      {"RRGGBB", "123456"},  {"COLUMN,ROW", "2,3"},   {"A:B", "1:3"},
      {"[all]", "all"}};
  static const std::vector<std::string> kNumbers = {"2", "0", "1", "0.5", "3", "7", "-1", "1e155", "1e-200"};
  if (const auto fixed = kFixed.find(kind); fixed != kFixed.end()) return fixed->second;
  std::vector<std::string> choices;
  std::istringstream words(kind);
  for (std::string word; std::getline(words, word, '|');) choices.push_back(word);
  const std::string& choice = choices[static_cast<std::size_t>(bytes.whole(int(choices.size()) - 1))];
  const bool is_word =
      std::any_of(choice.begin(), choice.end(), [](unsigned char c) { return std::islower(c); });
  return is_word ? choice : kNumbers[static_cast<std::size_t>(bytes.whole(int(kNumbers.size()) - 1))];
}

/// Adds up to three options with their values to a command line, which may make it a misuse.
inline void add_any(const std::vector<Option>& options, std::vector<std::string>& words, FuzzBytes& bytes) {
  for (int count = bytes.whole(3); count > 0; --count) {
    const Option& option = options[static_cast<std::size_t>(bytes.whole(int(options.size()) - 1))];
    words.push_back(option[0]);
    for (std::size_t i = 1; i < option.size(); ++i) words.push_back(value_of(option[i], bytes));
  }
}

}  // namespace pipeline
