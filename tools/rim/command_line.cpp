#include "tools/rim/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

// The widths of --help, in characters.
constexpr std::size_t kLineWidth = 80;
constexpr std::size_t kNameWidth = 25;

constexpr const char* kLastGroup = "General";

/// The text with line breaks instead of blanks, so that no line is longer than `width`.
std::string wrapped(std::string_view text, std::size_t width) {
  std::string lines;
  std::size_t column = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    const bool is_first = column == 0;
    const bool has_room = column + 1 + word.size() <= width;
    if (!is_first) lines += has_room ? ' ' : '\n';
    column = is_first || !has_room ? word.size() : column + 1 + word.size();
    lines += word;
    begin = end + 1;
    if (end < text.size() && text[end] == '\n') {
      lines += '\n';
      column = 0;
    }
  }
  return lines;
}

/// The option or operand that a message of CLI11 names: "--depth-image", not "--depth", which it contains.
const CLI::Option* named_in(const CLI::App& options, const std::string& message) {
  const CLI::Option* named = nullptr;
  for (const CLI::Option* option : options.get_options()) {
    const bool is_longer = named == nullptr || option->get_name().size() > named->get_name().size();
    if (is_longer && message.find(option->get_name()) != std::string::npos) named = option;
  }
  return named;
}

/// A former option, and its replacement.
struct OldName {
  std::string_view tool, option, now;
};
constexpr std::string_view kOneThread = "one thread does the work";
constexpr std::string_view kExpectFramed = "now --expect-framed";
constexpr std::array kOldNames = {
    OldName{"model", "--threads", kOneThread},      OldName{"view", "--threads", kOneThread},
    OldName{"project", "--threads", kOneThread},    OldName{"zbuf", "--framed", kExpectFramed},
    OldName{"trace", "--framed", kExpectFramed},    OldName{"join-seen", "--framed", kExpectFramed},
    OldName{"mesh2scene", "--up", "now --up-axis"},
};

/// " (did you mean --image?)" for a word such as --imgae=out.bmp, or nothing.
std::string option_hint(const CLI::App& options, const std::string& word) {
  const std::string_view found = std::string_view(word).substr(0, word.find('='));
  for (const auto& [tool, option, now] : kOldNames)
    if (tool == options.get_name() && option == found) return " (" + std::string(now) + ")";
  std::vector<std::string> names;
  for (const CLI::Option* option : options.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string_view nearest =
      nearest_word(found, std::vector<std::string_view>(names.begin(), names.end()));
  return nearest.empty() ? "" : " (did you mean " + std::string(nearest) + "?)";
}

std::string explained_extra(const CLI::App& options) {
  const std::string word = options.remaining().front();
  if (word.size() > 1 && word.front() == '-')
    return expected_but_found("an option of " + options.get_name(), pipeline::quoted(word)) +
           option_hint(options, word);
  return expected_but_found("no further operand", pipeline::quoted(word));
}

std::string explained_count(const CLI::Option& option) {
  const int expected = option.get_items_expected_min();
  const std::size_t found = option.results().size();
  return expected_but_found(
      (expected == 1 ? "one value (" : std::to_string(expected) + " values (") + option.get_type_name() + ")",
      found == 0 ? "none" : std::to_string(found));
}

/// The words in CLI11's order, last word first. A flag and its word are joined, as CLI11 expects. A word like
/// "-.5" becomes "-0.5": without a digit after the minus, CLI11 takes it for an option.
std::vector<std::string> words_for_parsing(int argc, char** argv,
                                           std::span<const std::pair<std::string, std::string>> flag_words) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (const auto& [flag, word] : flag_words) {
    const std::array both = {flag, word};
    const auto found = std::search(words.begin(), words.end(), both.begin(), both.end());
    if (found == words.end()) continue;
    *found += "=" + word;
    words.erase(std::next(found));
  }
  for (std::string& word : words)
    if (word.starts_with("-.") && parse_number(word).error == NumberError::none) word.insert(1, "0");
  std::reverse(words.begin(), words.end());
  return words;
}

/// The error in the command line: "option: expected ..., found ...".
std::string explained(const CLI::App& options, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return explained_extra(options);
  const CLI::Option* const option = named_in(options, error.what());
  if (option == nullptr) return error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return option->get_name() + ": " + explained_count(*option);
  const bool is_checked = dynamic_cast<const CLI::ValidationError*>(&error) != nullptr;  // explained already
  if (option->get_expected_max() == 0 && !option->results().empty() && !is_checked)
    return option->get_name() + ": " +
           expected_but_found("no value", pipeline::quoted(option->results().back()));
  return error.what();
}

class HelpForm : public CLI::Formatter {
 public:
  HelpForm(const ToolDescription& tool, const std::string& usage) : tool_(tool), usage_(usage) {
    column_width(kNameWidth);
    label("Positionals", "Operands");
  }

  void show_all() { shows_all_ = true; }
  void use_fields() { shows_all_ = uses_fields_ = true; }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    return usage_.empty() ? CLI::Formatter::make_usage(app, std::move(name)) : usage_ + "\n";
  }
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
    return make_usage(app, std::move(name)) + "\n" + examples() + "\n" +
           wrapped(app->get_description(), kLineWidth) + "\n" + make_positionals(app) + groups_of(app) +
           "\n" +
           (shows_all_ || *tool_.rare == '\0' ? "" : "--help-all shows all options, and more examples.\n\n") +
           wrapped("Exit status: 0 done; 1 bad input, or reading or writing failed; 2 a wrong command line",
                   kLineWidth) +
           "\n";
  }
  std::string make_option(const CLI::Option* option, bool is_operand) const override {
    if (!uses_fields_) return CLI::Formatter::make_option(option, is_operand);
    return "  " + make_option_name(option, is_operand) + make_option_opts(option) + "\t" +
           make_option_desc(option) + "\n";
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    const bool is_operand = option->get_lnames().empty();
    return is_operand || option->get_type_name().empty() ? "" : " " + option->get_type_name();
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string standard = option->get_default_str();
    std::string text = option->get_description() + (standard.empty() ? "" : " (default: " + standard + ")");
    if (!uses_fields_) return wrapped(text, kLineWidth - kNameWidth);
    std::replace(text.begin(), text.end(), '\n', '\t');
    return text;
  }

 private:
  std::string examples() const {
    const auto line = [](const char* example) { return "  " + std::string(example) + "\n"; };
    return shows_all_ ? "Examples:\n" + line(tool_.examples[0]) + line(tool_.examples[1])
                      : "Example:\n" + line(tool_.examples[0]);
  }
  bool is_shown(const CLI::Option* option) const {
    return shows_all_ || (std::string(tool_.rare) + " ").find(option->get_name() + " ") == std::string::npos;
  }
  std::string groups_of(const CLI::App* app) const {
    std::vector<std::string> groups = app->get_groups();
    std::stable_partition(groups.begin(), groups.end(),
                          [](const std::string& group) { return group != kLastGroup; });
    std::string text;
    for (const std::string& group : groups) {
      const auto options = app->get_options([&](const CLI::Option* option) {
        return option->get_group() == group && option->nonpositional() && is_shown(option);
      });
      if (!options.empty()) text += make_group(group, false, options);
    }
    return text;
  }

  ToolDescription tool_;
  std::string usage_;         // empty: CLI11's own
  bool shows_all_ = false;    // rare options and every example, too
  bool uses_fields_ = false;  // one option per line, with tabs: for man pages and completion
};

}  // namespace

CommandLine::CommandLine(const ToolDescription& tool, const std::string& version)
    : tool_(tool), version_(version), group_(kLastGroup) {}

CommandLine::~CommandLine() = default;

bool CommandLine::is_given(const std::string& name) const {
  if (!app_) return false;
  // CLI11's own search for a name would end the program if there is no memory.
  for (const CLI::Option* option : std::as_const(*app_).get_options())
    if (option->check_name(name)) return option->count() > 0;
  return false;
}

void CommandLine::add_flag(const std::string& name, bool& chosen, const std::string& help) {
  declare(name, [=, &chosen](CLI::App& app) { app.add_flag(name, chosen, help); });
}

void CommandLine::add_flag_with_word(const std::string& name, const std::string& word, bool& chosen,
                                     bool& more, const std::string& help) {
  const auto take = [=, &chosen, &more](const std::string& found) {
    chosen = true;
    more = found == word;
    if (!more && found != "true")
      throw CLI::ValidationError(name, expected_but_found(word + " or no value", pipeline::quoted(found)));
  };
  declare(name, [=](CLI::App& app) {
    app.add_option_function<std::string>(name, take, help)->expected(0)->type_name("[" + word + "]");
  });
  flag_words_.emplace_back(name, word);
}

void CommandLine::add_word(const std::string& name, const std::string& type_name, std::string& word,
                           const std::string& help, const WordCheck& check) {
  declare(name, [=, &word](CLI::App& app) {
    CLI::Option* const option = app.add_option(name, word, help)->type_name(type_name)->capture_default_str();
    if (check) option->check(CLI::Validator([check](std::string& found) { return check(found); }, "", ""));
  });
}

void CommandLine::add_words(const std::string& name, std::size_t count, const std::string& type_name,
                            std::vector<std::string>& words, const std::string& help) {
  declare(name, [=, &words](CLI::App& app) {
    CLI::Option* const option = app.add_option(name, words, help)->type_name(type_name);
    if (count > 0) option->expected(static_cast<int>(count));
    option->allow_extra_args(false);
  });
}

void CommandLine::add_whole(const std::string& name, int& number, int least, int most,
                            const std::string& help) {
  const std::string range = "from " + std::to_string(least) + " to " + std::to_string(most);
  const auto take = [=, &number](const std::string& word) {
    std::uint64_t found = 0;
    if (!parse_count(word, found) || found < static_cast<std::uint64_t>(least) ||
        found > static_cast<std::uint64_t>(most))
      throw CLI::ValidationError(name, expected_but_found("a whole number " + range, pipeline::quoted(word)));
    number = static_cast<int>(found);
  };
  declare(name, [=, &number](CLI::App& app) {
    app.add_option_function<std::string>(name, take, help + "; N is " + range)
        ->type_name("N")
        ->default_str(std::to_string(number));
  });
}

void CommandLine::add_number(const std::string& name, const std::string& type_name, double& number,
                             const std::function<bool(double)>& is_fine, const std::string& expected,
                             const std::string& help) {
  const auto take = [=, &number](const std::string& word) {
    const ParsedNumber found = parse_number(word);
    if (found.error != NumberError::none || !is_fine(found.value))
      throw CLI::ValidationError(name, expected_but_found(expected, pipeline::quoted(word)));
    number = found.value;
  };
  declare(name, [=, &number](CLI::App& app) {
    app.add_option_function<std::string>(name, take, help)
        ->type_name(type_name)
        ->default_str(shortest_text(number));
  });
}

void CommandLine::add_operand(const std::string& name, std::string& word, const std::string& help) {
  declare(name, [=, &word](CLI::App& app) { app.add_option(name, word, help)->capture_default_str(); });
}

void CommandLine::add_operands(const std::string& name, std::vector<std::string>& words,
                               const std::string& help) {
  declare(name, [=, &words](CLI::App& app) { app.add_option(name, words, help); });
}

void CommandLine::add_choice_of_words(const std::string& name, const std::vector<std::string>& words,
                                      const std::string& default_word, const std::string& help,
                                      const std::function<void(std::size_t)>& take) {
  std::string type_name;
  for (const std::string& word : words) {
    type_name += (type_name.empty() ? "" : "|") + word;
    if (word.starts_with('-')) flag_words_.emplace_back(name, word);  // CLI11 takes it for an option
  }
  const auto choose = [name, words, take](const std::string& found) {
    const auto word = std::find(words.begin(), words.end(), found);
    const std::vector<std::string_view> known(words.begin(), words.end());
    if (word == words.end())
      throw CLI::ValidationError(
          name, expected_but_found(listed(known), pipeline::quoted(found)) + spelling_hint(found, known));
    take(static_cast<std::size_t>(word - words.begin()));
  };
  declare(name, [=](CLI::App& app) {
    app.add_option_function<std::string>(name, choose, help)->type_name(type_name)->default_str(default_word);
  });
}

void CommandLine::add_to_app(std::span<const std::string> words) {
  const auto is_named = [](const Declared& option, std::string_view word) {  // of "-o,--output", either
    return ("," + option.name + ",").find("," + std::string(word.substr(0, word.find('='))) + ",") !=
           std::string::npos;
  };
  const auto is_option = [](std::string_view word) { return word.size() > 1 && word.starts_with('-'); };
  std::vector<bool> is_needed(declared_.size());
  bool needs_all = false;
  for (const std::string& word : words) {
    if (!is_option(word)) continue;
    const auto found =
        std::ranges::find_if(declared_, [&](const Declared& option) { return is_named(option, word); });
    needs_all = needs_all || found == declared_.end();
    if (!needs_all) is_needed[static_cast<std::size_t>(found - declared_.begin())] = true;
  }
  for (std::size_t i = 0; i < declared_.size(); ++i) {
    const Declared& option = declared_[i];
    if (!needs_all && !is_needed[i] && is_option(option.name)) continue;
    app_->option_defaults()->group(option.group);
    option.add(*app_);
  }
}

std::optional<std::string> CommandLine::parse(int argc, char** argv) {
  if (argc < 2) return std::nullopt;
  app_ = std::make_unique<CLI::App>(tool_.purpose, tool_.name);
  const auto help_form = std::make_shared<HelpForm>(tool_, usage_);
  app_->formatter(help_form)->allow_windows_style_options(false);  // there, too, /tmp/scene.txt is a file
  app_->get_help_ptr()->group(kLastGroup)->description("Print this help and exit; --help-all: every option");
  app_->option_defaults()->group(kLastGroup);
  app_->set_version_flag("--version", version_, "Print the version and exit");
  std::vector<std::string> words = words_for_parsing(argc, argv, flag_words_);
  add_to_app(words);

  const std::string_view only = argc == 2 ? argv[1] : "";
  if (only == "--help-fields") help_form->use_fields();
  if (only == "--help-all") help_form->show_all();
  if (only == "--help-fields" || only == "--help-all") return app_->help();
  try {
    app_->parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    return app_->help();
  } catch (const CLI::CallForVersion& version) {
    return std::string(version.what()) + "\n";
  } catch (const CLI::ParseError& error) {
    throw UsageError(explained(*app_, error));
  }
  for (const CLI::Option* option : std::as_const(*app_).get_options())
    if (!option->empty() && option->get_type_name() == "FILE" && option->results().front().empty())
      throw UsageError(option->get_name(), "a file's name", "nothing");
  return std::nullopt;
}

}  // namespace pipeline
