#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "tests/numbers/random_numbers.h"

namespace pipeline {

/// The form of a text's vertex lines: the number of decimals, and the columns behind the coordinates.
struct TextForm {
  int decimals = 7;
  std::string columns = {};
};

inline std::string three_vertices(RandomNumbers& random, const TextForm& form = {}) {
  std::string lines;
  for (int i = 0; i < 3; ++i) {
    std::array<char, 120> line{};
    std::snprintf(line.data(), line.size(), "%.*f %.*f %.*f", form.decimals, random.between(-9, 9),
                  form.decimals, random.between(-9, 9), form.decimals, random.between(-1, 1));
    lines += line.data() + form.columns + "\n";
  }
  return lines;
}

/// A body of stage text with so many triangles and, about once in `distance` triangles, something unusual
/// between them.
inline std::string odd_stage_text(int triangle_count, int distance, std::uint64_t seed,
                                  const TextForm& form = {}) {
  RandomNumbers random(seed);
  const std::string& columns = form.columns;
  std::string text;
  for (int i = 0; i < triangle_count; ++i) {
    switch (random.whole(0, 8 * distance)) {
      case 0:
        text += "# a comment\n";
        break;
      case 1:
        text += "triangle " + std::to_string(random.whole(0, 1 << 30)) + "\n";
        break;
      case 2:
        text += "\n\n \n";
        break;
      case 3:
        for (const std::string vertex : {"1 .5 -2.25", "1e-3 2 3", "4 5 6"})
          text += vertex + columns + " # so\n";
        text += "\n";
        break;
      case 4:
        for (const std::string vertex : {"0.12345678901234567890 2 3", "4 5 6", "  7 8 9"})
          text += vertex + columns + "\n";
        text += "\n";
        break;
      case 5:
        for (int k = 0; k < 3; ++k) text += "1.0000000 2.0000000 3.0000000" + columns + "\r\n";
        text += "\r\n";
        break;
      case 6:  // no line between this triangle and the next
        text += three_vertices(random, form);
        break;
      case 7:
        text += "triangle 5 # with a comment\n\n";
        break;
      default:
        break;
    }
    text += three_vertices(random, form) + "\n";
  }
  return text;
}

}  // namespace pipeline
