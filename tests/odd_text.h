#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "tests/random_numbers.h"

namespace pipeline {

/// A vertex line in the form nearly all text has.
inline std::string fixed_vertex(RandomNumbers& random) {
  std::array<char, 80> line{};
  std::snprintf(line.data(), line.size(), "%.7f %.7f %.7f\n", random.between(-9, 9), random.between(-9, 9),
                random.between(-1, 1));
  return line.data();
}

inline std::string three_fixed_vertices(RandomNumbers& random) {
  return fixed_vertex(random) + fixed_vertex(random) + fixed_vertex(random);
}

/// A body of stage text of so many triangles, in the usual form but for one in `distance` of them and what
/// stands around it.
inline std::string odd_stage_text(int triangle_count, int distance, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::string text;
  for (int i = 0; i < triangle_count; ++i) {
    switch (random.whole(0, 10 * distance)) {
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
        text += "1 .5 -2.25\n1e-3 2 3\n4 5 6 # the last\n\n";
        break;
      case 4:
        text += "0.12345678901234567890 2 3\n4 5 6\n7 8 9\n\n";
        break;
      case 5:
        text += "1.0000000 2.0000000 3.0000000\r\n4 5 6\r\n7 8 9\r\n\r\n";
        break;
      case 6:  // no line between this triangle and the next
        text += three_fixed_vertices(random);
        break;
      case 7:
        text += "triangle 5 # with a comment\n\n";
        break;
      default:
        break;
    }
    text += three_fixed_vertices(random) + "\n";
  }
  return text;
}

}  // namespace pipeline
