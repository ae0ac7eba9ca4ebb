#include "libpipeline/scene/json.h"

#include <algorithm>

#include "libpipeline/scene/model_text.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

const Json kNothing;

class JsonParser {
 public:
  JsonParser(const std::string& name, std::string_view text) : source_(name, text), text_(text) {}

  Json whole() {
    Json json = value(0);
    // Chunks of GLB are padded.
    if (peek() != '\0' || text_.find_first_not_of('\0') != std::string_view::npos) fail("the end");
    return json;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    source_.fail(text_.substr(0, 20), expected + " of JSON");
  }

  /// The next character after blanks; 0 at the end.
  char peek() {
    text_.remove_prefix(std::min(text_.find_first_not_of(" \t\r\n"), text_.size()));
    return text_.empty() ? '\0' : text_.front();
  }

  bool takes(char c) {
    if (peek() != c) return false;
    text_.remove_prefix(1);
    return true;
  }

  Json value(int depth) {
    constexpr int kDeepest = 200;
    if (depth > kDeepest) fail("no more than 200 levels");
    const char c = peek();
    if (c == '{' || c == '[') return list(c == '{', depth);
    Json json = {.is_there = true};
    if (c == '"') {
      json.text = string();
      return json;
    }
    const std::string_view word = text_.substr(0, text_.find_first_of(" \t\r\n,:]}"));
    const ParsedNumber parsed = parse_number(word);
    json.is_there = word != "null";
    json.is_number = parsed.error == NumberError::none;
    json.number = word == "true" ? 1 : parsed.value;
    if (!json.is_number && json.is_there && word != "true" && word != "false") fail("a value");
    text_.remove_prefix(word.size());
    return json;
  }

  Json list(bool is_object, int depth) {
    Json json = {.is_there = true};
    const char close = is_object ? '}' : ']';
    text_.remove_prefix(1);
    if (takes(close)) return json;
    do {
      std::string name;
      if (is_object) {
        if (peek() != '"') fail("a name");
        name = string();
        if (!takes(':')) fail("a colon");
      }
      json.items.emplace_back(std::move(name), value(depth + 1));
    } while (takes(','));
    if (!takes(close)) fail(std::string("a comma or ") + close);
    return json;
  }

  std::string string() {
    std::string text;
    for (;;) {
      text_.remove_prefix(1);
      const std::size_t end = text_.find_first_of("\"\\");
      if (end >= text_.size() - 1) fail("a closing quote, and more");
      text += text_.substr(0, end);
      text_.remove_prefix(end + 1);
      if (text_.data()[-1] == '"') return text;
      constexpr std::string_view kEscapes = "bfnrt", kMeanings = "\b\f\n\r\t";
      const char c = text_.front();
      const std::size_t known = kEscapes.find(c);
      if (c == 'u')
        append_code_point(text);
      else
        text += known == std::string_view::npos ? c : kMeanings[known];
    }
  }

  /// Reads four hexadecimal digits, and appends their code in UTF-8, also of a half of a pair.
  void append_code_point(std::string& text) {
    unsigned code = 0;
    for (const char c : text_.substr(1, 4))
      code = 16 * code + static_cast<unsigned>(c > '9' ? (c & 7) + 9 : c & 15);
    text_.remove_prefix(std::min<std::size_t>(4, text_.size() - 1));
    const auto byte = [](unsigned value) { return static_cast<char>(value); };
    if (code < 0x80)
      text += byte(code);
    else if (code < 0x800)
      text += {byte(0xc0 | code >> 6), byte(0x80 | (code & 63))};
    else
      text += {byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 63)), byte(0x80 | (code & 63))};
  }

  ModelText source_;
  std::string_view text_;  // from here on
};

}  // namespace

const Json& Json::operator[](std::string_view name) const {
  const auto found = std::ranges::find(items, name, &std::pair<std::string, Json>::first);
  return found == items.end() ? kNothing : found->second;
}

const Json& Json::operator[](std::size_t index) const {
  return index < items.size() ? items[index].second : kNothing;
}

Json parse_json(const std::string& name, std::string_view text) {
  return JsonParser(name, text).whole();
}

}  // namespace pipeline
