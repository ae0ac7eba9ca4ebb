#include "tools/command_line.h"

#include <algorithm>
#include <memory>

#include "libpipeline/number_text.h"

namespace pipeline {
namespace {

bool is_flag(const CLI::Option& option) {
  return option.get_expected_max() == 0;
}

class HelpForm : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const bool is_operand = option->get_lnames().empty();
    return is_operand || is_flag(*option) ? "" : " " + option->get_type_name();
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string standard = option->get_default_str();
    return option->get_description() + (standard.empty() ? "" : " (default: " + standard + ")");
  }
};

/// The option or operand an error of CLI11's is about: the one it names, of "--depth" and "--depth-image" the
/// longer.
const CLI::Option* named_in(const CLI::App& options, const std::string& message) {
  const CLI::Option* named = nullptr;
  for (const CLI::Option* option : options.get_options()) {
    const bool is_longer = named == nullptr || option->get_name().size() > named->get_name().size();
    if (is_longer && message.find(option->get_name()) != std::string::npos) named = option;
  }
  return named;
}

std::string explained_extra(const CLI::App& options) {
  const std::string word = options.remaining().front();
  if (word.size() > 1 && word.front() == '-')
    return expected_but_found("an option of " + options.get_name(), pipeline::quoted(word));
  return expected_but_found("no further operand", pipeline::quoted(word));
}

std::string explained_count(const CLI::Option& option) {
  const int expected = option.get_items_expected_min();
  const std::size_t found = option.results().size();
  return expected_but_found(
      (expected == 1 ? "one value (" : std::to_string(expected) + " values (") + option.get_type_name() + ")",
      found == 0 ? "none" : std::to_string(found));
}

}  // namespace

std::vector<std::string> words_for_parsing(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::string& word : words)
    if (word.starts_with("-.") && parse_number(word).error == NumberError::none) word.insert(1, "0");
  std::reverse(words.begin(), words.end());
  return words;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
  return text;
}

void add_word_option(CLI::App& options, const std::string& name, const std::vector<std::string>& words,
                     const std::string& default_word, const std::string& help,
                     const std::function<void(std::size_t)>& take) {
  std::string type_name;
  for (const std::string& word : words) type_name += (type_name.empty() ? "" : "|") + word;
  const auto choose = [name, words, take](const std::string& found) {
    const auto word = std::find(words.begin(), words.end(), found);
    if (word == words.end())
      throw CLI::ValidationError(name, expected_but_found(listed(words), pipeline::quoted(found)));
    take(static_cast<std::size_t>(word - words.begin()));
  };
  options.add_option_function<std::string>(name, choose, help)
      ->type_name(type_name)
      ->default_str(default_word);
}

void add_thread_option(CLI::App& options, int& thread_count, const std::string& help) {
  options.add_option("--threads", thread_count, help + ", from 1 to 256; the output does not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

void add_file_option(CLI::App& options, const std::string& name, std::string& path,
                     const std::function<void(const std::string&)>& check, const std::string& help) {
  const auto told = [check](const std::string& word) {
    try {
      check(word);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  options.add_option(name, path, help)
      ->type_name("FILE")
      ->check(CLI::Validator(told, "", ""))
      ->capture_default_str();
}

void set_help_form(CLI::App& options) {
  options.formatter(std::make_shared<HelpForm>());
  options.footer(
      "The pipeline: model scene.txt | view | project | zbuf config.txt\n"
      "Exit status: 0 done; 1 bad input, or reading or writing failed; 2 a wrong command line");
}

std::string explained(const CLI::App& options, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return explained_extra(options);
  const CLI::Option* const option = named_in(options, error.what());
  if (option == nullptr) return error.what();
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    return expected_but_found("an operand " + option->get_name(), "none");
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return option->get_name() + ": " + explained_count(*option);
  if (is_flag(*option) && !option->results().empty())
    return option->get_name() + ": " +
           expected_but_found("no value", pipeline::quoted(option->results().back()));
  return error.what();
}

}  // namespace pipeline
