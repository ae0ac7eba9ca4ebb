// Draws the triangles of a bare NDC text in the most obvious way: it tests every pixel center in the bounding
// box against the triangle, in doubles; each thread draws a part of the triangles into a picture of its own,
// and the pictures are merged. Prints the seconds of the fastest of three drawings, and how many pixels show
// a triangle.
//
// usage: draw_plainly WIDTH HEIGHT TRIANGLES THREADS

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace {

struct Point {
  double x, y, z;
};
using Triangle = std::array<Point, 3>;

/// All numbers in a file, whatever separates them.
std::vector<double> numbers_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::vector<double> numbers;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at < end;) {
    double number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error == std::errc{}) numbers.push_back(number);
    at = error == std::errc{} ? after : at + 1;
  }
  return numbers;
}

std::vector<Triangle> triangles_of(const char* path) {
  const std::vector<double> numbers = numbers_of(path);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 9 <= numbers.size(); i += 9)
    triangles.push_back({{{numbers[i], numbers[i + 1], numbers[i + 2]},
                          {numbers[i + 3], numbers[i + 4], numbers[i + 5]},
                          {numbers[i + 6], numbers[i + 7], numbers[i + 8]}}});
  return triangles;
}

struct Picture {
  Picture(int width, int height)
      : columns(width),
        rows(height),
        depths(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1.0),
        colors(depths.size()) {}

  void draw(const Triangle& ndc, std::uint32_t color) {
    Triangle p = ndc;
    for (Point& v : p) {
      v.x = (v.x + 1) / 2 * columns - 0.5;
      v.y = (1 - v.y) / 2 * rows - 0.5;
    }
    double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (area < 0) {
      std::swap(p[1], p[2]);
      area = -area;
    }
    if (!(area > 0)) return;
    const auto first = [](double a, double b, double c) {
      return std::max(static_cast<int>(std::ceil(std::min({a, b, c}))), 0);
    };
    const auto last = [](double a, double b, double c, int end) {
      return std::min(static_cast<int>(std::floor(std::max({a, b, c}))), end - 1);
    };
    const int left = first(p[0].x, p[1].x, p[2].x), right = last(p[0].x, p[1].x, p[2].x, columns);
    const int top = first(p[0].y, p[1].y, p[2].y), bottom = last(p[0].y, p[1].y, p[2].y, rows);
    const double inverse = 1 / area;
    for (int row = top; row <= bottom; ++row) {
      double* const depth = &depths[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns)];
      std::uint32_t* const pixel = &colors[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns)];
      for (int column = left; column <= right; ++column) {
        const double a = (p[2].x - p[1].x) * (row - p[1].y) - (p[2].y - p[1].y) * (column - p[1].x);
        const double b = (p[0].x - p[2].x) * (row - p[2].y) - (p[0].y - p[2].y) * (column - p[2].x);
        const double c = area - a - b;
        if (a < 0 || b < 0 || c < 0) continue;
        const double z = (a * p[0].z + b * p[1].z + c * p[2].z) * inverse;
        if (z >= -1 && z < depth[column]) {
          depth[column] = z;
          pixel[column] = color;
        }
      }
    }
  }

  /// Merges part `part` of `parts` of a picture with later triangles: the nearer pixels win.
  void merge(const Picture& later, std::size_t part, std::size_t parts) {
    for (std::size_t i = depths.size() * part / parts; i < depths.size() * (part + 1) / parts; ++i)
      if (later.depths[i] < depths[i]) {
        depths[i] = later.depths[i];
        colors[i] = later.colors[i];
      }
  }

  int columns, rows;
  std::vector<double> depths;
  std::vector<std::uint32_t> colors;
};

/// Calls work(0) to work(count - 1), each on a thread of its own.
template <typename Work>
void on_threads(std::size_t count, const Work& work) {
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < count; ++i) others.emplace_back(work, i);
  work(0);
  for (std::thread& other : others) other.join();
}

Picture drawn(const std::vector<Triangle>& triangles, int width, int height, std::size_t threads) {
  std::vector<Picture> pictures(threads, Picture(0, 0));
  on_threads(threads, [&](std::size_t part) {
    pictures[part] = Picture(width, height);
    for (std::size_t i = triangles.size() * part / threads; i < triangles.size() * (part + 1) / threads; ++i)
      pictures[part].draw(triangles[i], static_cast<std::uint32_t>(i) * 2654435761u);
  });
  on_threads(threads, [&](std::size_t part) {
    for (std::size_t later = 1; later < threads; ++later) pictures[0].merge(pictures[later], part, threads);
  });
  return std::move(pictures[0]);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const int width = std::atoi(argv[1]), height = std::atoi(argv[2]);
  const std::vector<Triangle> triangles = triangles_of(argv[3]);
  double best = 1e300;
  std::ptrdiff_t seen = 0;
  for (int frame = 0; frame < 3; ++frame) {
    const auto begin = std::chrono::steady_clock::now();
    const Picture picture = drawn(triangles, width, height, static_cast<std::size_t>(std::atoi(argv[4])));
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    seen = std::count_if(picture.depths.begin(), picture.depths.end(), [](double z) { return z < 1; });
  }
  std::printf("%.6f %td\n", best, seen);
}
