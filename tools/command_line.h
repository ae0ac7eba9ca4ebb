#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "libpipeline/error.h"

namespace pipeline {

// CLI11 in our words: the same form for every message and every help text.

/// "a, b or c".
std::string listed(const std::vector<std::string>& words);

/// Adds an option that takes one of `words`; `take` gets the index of the one that was found.
void add_word_option(CLI::App& options, const std::string& name, const std::vector<std::string>& words,
                     const std::string& default_word, const std::string& help,
                     const std::function<void(std::size_t)>& take);

/// Adds an option that takes the name of a file; what `check` throws as an InputError is wrong with it.
void add_file_option(CLI::App& options, const std::string& name, std::string& path,
                     const std::function<void(const std::string&)>& check, const std::string& help);

/// Adds an option that takes one of a few words, each of which stands for a value. What `chosen` holds is the
/// default, if it is one of those.
template <typename T>
void add_choice(CLI::App& options, const std::string& name, T& chosen,
                const std::vector<std::pair<std::string, T>>& choices, const std::string& help) {
  std::vector<std::string> words;
  std::string default_word;
  for (const auto& [word, value] : choices) {
    words.push_back(word);
    if (value == chosen) default_word = word;
  }
  const auto take = [&chosen, choices](std::size_t index) { chosen = choices[index].second; };
  add_word_option(options, name, words, default_word, help, take);
}

/// Adds `--threads`: `help` says what they do. From 1 to 256.
void add_thread_option(CLI::App& options, int& thread_count, const std::string& help);

/// Options and operands with their defaults, at the end of --help how the tools go together.
void set_help_form(CLI::App& options);

/// The command line as CLI11 takes it, last word first. A word like "-.5" becomes "-0.5": only a digit behind
/// the minus tells CLI11 that it is a number and no option.
std::vector<std::string> words_for_parsing(int argc, char** argv);

/// What is wrong with the command line: "option: expected ..., found ...".
std::string explained(const CLI::App& options, const CLI::ParseError& error);

}  // namespace pipeline
