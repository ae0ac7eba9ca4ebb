#include "tests/conformance/student/switches.h"

#include <algorithm>
#include <cassert>
#include <iostream>
#include <iterator>
#include <set>

namespace {

// The names of mistakes.txt and of habits.txt.
constexpr std::string_view kNames[] = {
    "model/multiplied-on-the-left",
    "model/push-and-pop-ignored",
    "model/pop-ignored",
    "model/push-of-the-identity",
    "model/pop-to-the-identity",
    "model/second-push-lost",
    "model/push-does-not-nest",
    "model/axis-not-normalized",
    "model/angle-in-radians",
    "model/rotation-transposed",
    "model/rotation-element-from-the-wrong-column",
    "model/angle-negated",
    "view/translation-after-rotation",
    "view/eye-added",
    "view/no-translation",
    "view/rotation-transposed",
    "view/eye-and-look-exchanged",
    "view/look-is-a-direction",
    "view/l-not-unit",
    "view/l-not-negated",
    "view/up-is-a-point",
    "view/up-is-0-1-0",
    "view/r-not-unit",
    "view/r-is-up-cross-l",
    "view/up-as-given",
    "view/u-is-l-cross-r",
    "view/matrix-transposed",
    "project/fov-in-radians",
    "project/fov-not-halved",
    "project/fovx-equals-fovy",
    "project/fovx-divided-by-aspect",
    "project/r-is-t-times-aspect",
    "project/r-and-t-swapped",
    "project/near-and-far-swapped",
    "project/missing-two",
    "project/z-row-sign",
    "project/w-is-plus-z",
    "project/last-element-is-one",
    "project/matrix-transposed",
    "project/depth-from-0-to-1",
    "project/depth-is-linear",
    "project/z-not-divided",
    "project/no-divide",
    "zbuf/no-half-pixel-in-x",
    "zbuf/no-half-pixel-in-y",
    "zbuf/shifted-by-a-column",
    "zbuf/shifted-by-a-row",
    "zbuf/column-short",
    "zbuf/row-short",
    "zbuf/window-is-one",
    "zbuf/front-limit-ignored",
    "zbuf/rear-limit-ignored",
    "zbuf/farthest-wins",
    "zbuf/last-wins",
    "zbuf/one-color",
    "zbuf/flat-depth",
    "zbuf/upside-down",
    "zbuf/text-upside-down",
    "zbuf/mirrored",
    "all/six-digits",
    "all/four-decimals",
    "all/exact-in-memory",
    "all/blanks-at-line-ends",
    "all/carriage-returns",
    "zbuf/center",
    "zbuf/truncated-ends",
    "zbuf/rounded-ends-depth",
    "zbuf/no-slivers",
    "zbuf/later-of-equals",
    "zbuf/everything-printed",
    "zbuf/other-colors",
    "zbuf/other-file-names",
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
