// A minimal filter of bare stage text: std::from_chars, a matrix, std::to_chars. Reads standard input, writes
// standard output.

#include <unistd.h>

#include <array>
#include <charconv>
#include <string>
#include <string_view>

namespace {

constexpr std::size_t kBlockSize = 64 * 1024;

void write_all(std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (count < 0) _exit(1);
    done += static_cast<std::size_t>(count);
  }
  text.clear();
}

std::array<double, 3> transformed(const std::array<double, 3>& p) {
  const double x = p[0] - 1.8, y = p[1] - 1.2, z = p[2] - 2.4;
  return {0.8 * x - 0.6 * z, 0.36 * x + 0.8 * y + 0.48 * z, 0.48 * x - 0.6 * y + 0.64 * z};
}

void filter_line(std::string_view line, std::string& out) {
  std::array<double, 3> point{};
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  for (double& number : point) {
    while (at < end && *at == ' ') ++at;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc{}) _exit(1);
    at = after;
  }
  char separator = ' ';
  const std::array<double, 3> moved = transformed(point);
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<char, 400> digits;
    separator = i == 2 ? '\n' : ' ';
    out.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), moved[i],
                                            std::chars_format::fixed, 7)
                                  .ptr);
    out += separator;
  }
}

}  // namespace

int main() {
  std::string in, out;
  std::array<char, kBlockSize> block;
  for (ssize_t count; (count = ::read(STDIN_FILENO, block.data(), block.size())) > 0;) {
    in.append(block.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end; (end = in.find('\n', begin)) != std::string::npos; begin = end + 1) {
      if (end == begin) {
        out += '\n';
      } else {
        filter_line(std::string_view(in).substr(begin, end - begin), out);
      }
      if (out.size() > kBlockSize - 1024) write_all(out);
    }
    in.erase(0, begin);
  }
  write_all(out);
}
