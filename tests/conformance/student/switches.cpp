#include "tests/conformance/student/switches.h"

#include <algorithm>
#include <cassert>
#include <iostream>
#include <iterator>
#include <set>

namespace {

// The names of mistakes.txt and of habits.txt.
constexpr std::string_view kNames[] = {
#include "switch_names.inc"
};

std::set<std::string_view>& chosen() {
  static std::set<std::string_view> names;
  return names;
}

bool is_known(std::string_view name) {
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

bool is_chosen(std::string_view name) {
  assert(is_known(name));
  return chosen().count(name) > 0;
}

}  // namespace

bool switch_on(std::string_view name) {
  if (!is_known(name)) return false;
  chosen().insert(*std::find(std::begin(kNames), std::end(kNames), name));
  return true;
}

bool mistake(std::string_view name) {
  return is_chosen(name);
}
bool habit(std::string_view name) {
  return is_chosen(name);
}

void print_switches() {
  for (const std::string_view name : kNames) std::cout << name << '\n';
}
