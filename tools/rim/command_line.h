#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "libpipeline/text/error.h"

namespace CLI {
class App;
}

namespace pipeline {

/// A wrong command line. `what()` is the complete message.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  UsageError(const std::string& option, const std::string& expected, const std::string& found)
      : std::runtime_error(option + ": " + expected_but_found(expected, found)) {}
};

/// Describes what is wrong with a word; empty if nothing is.
using WordCheck = std::function<std::string(const std::string& word)>;

/// A check whose description is the message of the InputError that `check` throws.
template <typename F>
WordCheck wrong_with_name(F check) {
  return [check](const std::string& name) -> std::string {
    try {
      check(name);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
}

/// A check that reports a word that fails `is_fine` as "expected `expected`, found ...".
template <typename F>
WordCheck expects(const char* expected, F is_fine) {
  return [=](const std::string& word) {
    return is_fine(word) ? std::string() : expected_but_found(expected, pipeline::quoted(word));
  };
}

/// A tool's part of --help.
struct ToolDescription {
  const char* name;
  const char* purpose;
  const char* input;                    // of the last operand
  std::array<const char*, 2> examples;  // command lines; --help shows the first
  const char* rare = "";                // options that only --help-all shows, separated by blanks
};

/// CLI11 with one form for all options, messages and help texts. An option's value is stored in the variable
/// it was added with; the variable's initial value is the default. --help wraps its lines.
class CommandLine {
 public:
  CommandLine(const ToolDescription& tool, const std::string& version);
  ~CommandLine();

  /// Puts later options into this group of --help; options before the first group go to General, with
  /// --help.
  void begin_group(const std::string& name) { group_ = name; }
  /// Replaces the usage lines of --help that CLI11 makes of the operands.
  void set_usage(const std::string& usage) { usage_ = usage; }
  void add_flag(const std::string& name, bool& chosen, const std::string& help);
  /// A flag with an optional `word`: "--name" sets `chosen`, "--name word" also sets `more`.
  void add_flag_with_word(const std::string& name, const std::string& word, bool& chosen, bool& more,
                          const std::string& help);
  /// An option that takes one word of any kind, which --help calls `type_name`.
  void add_word(const std::string& name, const std::string& type_name, std::string& word,
                const std::string& help, const WordCheck& check = nullptr);
  /// An option that takes `count` words; with 0, one word each time it is given.
  void add_words(const std::string& name, std::size_t count, const std::string& type_name,
                 std::vector<std::string>& words, const std::string& help);
  /// An option that takes one word and may be repeated.
  void add_repeatable(const std::string& name, const std::string& type_name, std::vector<std::string>& words,
                      const std::string& help) {
    add_words(name, 0, type_name, words, help);
  }
  /// An option that takes a whole number from `least` to `most`.
  void add_whole(const std::string& name, int& number, int least, int most, const std::string& help);
  /// An option that takes a number for which `is_fine` holds; messages describe it as `expected`.
  void add_number(const std::string& name, const std::string& type_name, double& number,
                  const std::function<bool(double)>& is_fine, const std::string& expected,
                  const std::string& help);
  /// An option that takes one of a few words, each of which stands for a value. The initial value of `chosen`
  /// is the default if it is one of them.
  template <typename T>
  void add_choice(const std::string& name, T& chosen, const std::vector<std::pair<std::string, T>>& choices,
                  const std::string& help) {
    std::vector<std::string> words;
    std::string default_word;
    for (const auto& [word, value] : choices) {
      words.push_back(word);
      if (value == chosen) default_word = word;
    }
    const auto take = [&chosen, choices](std::size_t index) { chosen = choices[index].second; };
    add_choice_of_words(name, words, default_word, help, take);
  }
  /// An operand, which may be left out.
  void add_operand(const std::string& name, std::string& word, const std::string& help);
  /// Any number of operands.
  void add_operands(const std::string& name, std::vector<std::string>& words, const std::string& help);

  /// Parses the arguments of `main`. Returns the text requested by --help or --version, else nothing. A
  /// UsageError ("option: expected ..., found ...") if the command line is wrong.
  std::optional<std::string> parse(int argc, char** argv);
  /// True if the option or operand of that name was on the command line.
  [[nodiscard]] bool is_given(const std::string& name) const;

 private:
  void add_choice_of_words(const std::string& name, const std::vector<std::string>& words,
                           const std::string& default_word, const std::string& help,
                           const std::function<void(std::size_t)>& take);

  /// An option or operand that CLI11 gets only if needed: each takes some 5 % of a tool's start-up.
  struct Declared {
    std::string name, group;
    std::function<void(CLI::App&)> add;
  };
  void declare(const std::string& name, const std::function<void(CLI::App&)>& add) {
    declared_.push_back({name, group_, add});
  }
  /// Gives CLI11 the operands and the options that the words name, or all if an option-like word names none.
  void add_to_app(std::span<const std::string> words);

  ToolDescription tool_;
  std::string version_, usage_, group_;
  std::vector<Declared> declared_;
  std::vector<std::pair<std::string, std::string>> flag_words_;  // of flags that take a word
  std::unique_ptr<CLI::App> app_;                                // none without words
};

}  // namespace pipeline
