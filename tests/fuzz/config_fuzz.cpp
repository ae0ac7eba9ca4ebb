// The config reader: any text gives a viewport within its limits or an error at its location.

#include <cmath>

#include "libpipeline/scene/config.h"
#include "libpipeline/text/number_printer.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/transcript.h"

namespace pipeline {
namespace {

std::string shortest(double value) {
  char text[kMaxNumberLength];
  return {text, print_number(text, value, 0, {.decimals = 7, .shortest = true})};
}

void check_screen(const Viewport& screen) {
  require(screen.columns >= 1 && screen.columns <= kMaxViewportSize, "the width is within its limits");
  require(screen.rows >= 1 && screen.rows <= kMaxViewportSize, "the height is within its limits");
  require(screen.left < 0 && screen.bottom < 0, "left and bottom are negative");
  require(std::isnormal(screen.dx()) && screen.dx() > 0, "a pixel has a width");
  require(std::isnormal(screen.dy()) && screen.dy() > 0, "a pixel has a height");
  require(screen.front < screen.rear && std::isfinite(screen.front) && std::isfinite(screen.rear),
          "the front limit is before the rear limit");
}

void rewrite(TextReader& text, TextWriter& output) {
  const Viewport screen = read_config(text);
  check_screen(screen);
  output.append(std::to_string(screen.columns) + " " + std::to_string(screen.rows) + "\n" +
                shortest(screen.left) + "\n" + shortest(screen.bottom) + "\n" + shortest(screen.front) + " " +
                shortest(screen.rear) + "\n");
}

}  // namespace

void check(FuzzBytes bytes) {
  const Transcript once = transcript(bytes.rest(), rewrite);
  if (!once.mistake.empty()) return;
  require(transcript(once.written, rewrite) == once, "a config written out reads back to itself");
}

}  // namespace pipeline
