#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "libpipeline/error.h"

namespace pipeline {

// CLI11 in our words: the same form for every message and every help text.

/// "a, b or c".
std::string listed(const std::vector<std::string>& words);

/// Adds an option that takes one of a few words, each of which stands for a value. What `chosen` holds is the
/// default, if it is one of those.
template <typename T>
void add_choice(CLI::App& options, const std::string& name, T& chosen,
                const std::vector<std::pair<std::string, T>>& choices, const std::string& help) {
  std::vector<std::string> words;
  std::string type_name;
  std::string default_word;
  for (const auto& [word, value] : choices) {
    words.push_back(word);
    type_name += (type_name.empty() ? "" : "|") + word;
    if (value == chosen) default_word = word;
  }
  const auto take = [&chosen, name, choices, words](const std::string& found) {
    for (const auto& [word, value] : choices)
      if (word == found) return void(chosen = value);
    throw CLI::ValidationError(name, expected_but_found(listed(words), pipeline::quoted(found)));
  };
  options.add_option_function<std::string>(name, take, help)->type_name(type_name)->default_str(default_word);
}

/// Options and operands with their defaults, at the end of --help how the tools go together.
void set_help_form(CLI::App& options);

/// The command line as CLI11 takes it, last word first. A word like "-.5" becomes "-0.5": only a digit behind
/// the minus tells CLI11 that it is a number and no option.
std::vector<std::string> words_for_parsing(int argc, char** argv);

/// What is wrong with the command line: "option: expected ..., found ...".
std::string explained(const CLI::App& options, const CLI::ParseError& error);

}  // namespace pipeline
