// A minimal filter of bare stage text: iostreams for input and output, a matrix between them. Reads standard
// input, writes standard output.

#include <array>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

int main() {
  std::cout << std::fixed << std::setprecision(7);
  for (std::string line; std::getline(std::cin, line);) {
    if (line.empty()) {
      std::cout << '\n';
      continue;
    }
    std::array<double, 3> p{};
    std::istringstream words(line);
    if (!(words >> p[0] >> p[1] >> p[2])) return 1;
    const double x = p[0] - 1.8, y = p[1] - 1.2, z = p[2] - 2.4;
    std::cout << 0.8 * x - 0.6 * z << ' ' << 0.36 * x + 0.8 * y + 0.48 * z << ' '
              << 0.48 * x - 0.6 * y + 0.64 * z << '\n';
  }
  return std::cout.flush() ? 0 : 1;
}
