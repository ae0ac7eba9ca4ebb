// Stage 4: clipping and scan conversion with a z-buffer.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/conformance/student/stages.h"
#include "tests/conformance/student/switches.h"

namespace {

/// The colors of triangles: numbers that look random, always the same.
class Random {
 public:
  Color next_color() {
    const int red = next(), green = next(), blue = next();
    return {red, green, blue};
  }

 private:
  int next() {
    state_ = 214013 * state_ + 2531011;
    return static_cast<int>((state_ >> 16 & 0x7fff) % 256);
  }

  std::uint32_t state_ = habit("zbuf/other-colors") ? 2021 : 1;
};

/// Other numbers in every run, unless STUDENT_SEED is set.
std::mt19937& seeded() {
  static const char* const seed = std::getenv("STUDENT_SEED");
  static std::mt19937 numbers(seed ? std::strtoul(seed, nullptr, 10) : std::random_device()());
  return numbers;
}

/// The pixels: their number, and where their centers are.
struct Grid {
  explicit Grid(const Config& config) : width(config.width), height(config.height) {
    double left = mistake("zbuf/window-is-one") ? -1 : config.left;
    double bottom = mistake("zbuf/window-is-one") ? -1 : config.bottom;
    if (mistake("zbuf/left-and-bottom-exchanged")) std::swap(left, bottom);
    const int less = mistake("zbuf/width-minus-one") ? 1 : 0;
    dx = -2 * left / (width - less);
    dy = -2 * bottom / (height - less);
    left_x = mistake("zbuf/no-half-pixel-in-x") ? left : left + (1 - less) * dx / 2;
    top_y = mistake("zbuf/no-half-pixel-in-y") ? -bottom : -bottom - (1 - less) * dy / 2;
  }

  int width, height;
  double dx, dy, left_x, top_y;
};

/// A whole number from -1 to `limit`: a double may be too large for an int.
int whole(double value, int limit) {
  return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(limit)));
}

struct Range {
  int first, last;
};

/// A range of pixel centers without the ends that lie on the edges, at `low` and `high`.
Range without_edges(Range range, double low, double high) {
  const auto is_on = [](int center, double edge) { return std::abs(center - edge) < 1e-9; };
  return {range.first + is_on(range.first, low), range.last - is_on(range.last, high)};
}

Range rows_of(const Triangle& triangle, const Grid& grid) {
  std::vector<double> y = {triangle.points[0][1], triangle.points[1][1], triangle.points[2][1]};
  std::sort(y.begin(), y.end());
  const double y_min = y[mistake("zbuf/half-triangle") ? 1 : 0], y_max = y[2];
  const double top = (grid.top_y - y_max) / grid.dy, bottom = (grid.top_y - y_min) / grid.dy;
  Range rows = {whole(std::ceil(top), grid.height), whole(std::floor(bottom), grid.height)};
  if (habit("zbuf/center")) rows.last = whole(std::ceil(bottom) - 1, grid.height);
  if (mistake("zbuf/row-short")) rows.last--;
  if (mistake("zbuf/strict-edges")) rows = without_edges(rows, top, bottom);
  return rows;
}

Range columns_between(double x_left, double x_right, const Grid& grid) {
  const double left = (x_left - grid.left_x) / grid.dx, right = (x_right - grid.left_x) / grid.dx;
  const int more = mistake("zbuf/column-long") ? 1 : 0;
  Range columns = {whole(std::floor(left + 0.5), grid.width),
                   whole(std::floor(right + 0.5) + more, grid.width)};
  if (habit("zbuf/center"))
    columns = {whole(std::ceil(left), grid.width), whole(std::ceil(right) - 1 + more, grid.width)};
  if (habit("zbuf/truncated-ends")) columns = {whole(left, grid.width), whole(right, grid.width)};
  if (mistake("zbuf/column-short")) columns.last--;
  if (mistake("zbuf/strict-edges")) columns = without_edges(columns, left, right);
  return columns;
}

/// The points, with the same y, where the edges meet the middle of a row of pixels; of a row below the
/// triangle, where its lowest edges would.
std::vector<Vector> met_at(const Triangle& triangle, double y) {
  std::vector<Vector> result;
  const double inside =
      std::max(y, std::min({triangle.points[0][1], triangle.points[1][1], triangle.points[2][1]}));
  for (int i = 0; i < 3; i++) {
    Vector a = triangle.points[i], b = triangle.points[(i + 1) % 3];
    const auto is_lower = [](const Vector& p, const Vector& q) {
      return std::vector<double>{p[1], p[0], p[2]} < std::vector<double>{q[1], q[0], q[2]};
    };
    if (is_lower(b, a)) std::swap(a, b);
    if (a[1] == b[1] || inside < a[1] || inside > b[1]) continue;
    if (habit("zbuf/other-formulas") && y != b[1]) {
      const double from_top = b[1] - y;
      const auto at = [&](int axis) { return b[axis] + (a[axis] - b[axis]) / (b[1] - a[1]) * from_top; };
      result.push_back({at(0), y, at(2)});
      continue;
    }
    const double t = (y - a[1]) / (b[1] - a[1]);
    result.push_back(y == b[1] ? b : Vector{a[0] + t * (b[0] - a[0]), y, a[2] + t * (b[2] - a[2])});
  }
  return result;
}

/// Positive for counterclockwise.
double area(const Triangle& triangle) {
  const Vector a = minus(triangle.points[1], triangle.points[0]),
               b = minus(triangle.points[2], triangle.points[0]);
  return a[0] * b[1] - a[1] * b[0];
}

Triangle at_whole_pixels(Triangle triangle, const Grid& grid) {
  for (Vector& point : triangle.points) {
    point[0] = grid.left_x + std::floor((point[0] - grid.left_x) / grid.dx + 0.5) * grid.dx;
    point[1] = grid.top_y - std::floor((grid.top_y - point[1]) / grid.dy + 0.5) * grid.dy;
  }
  return triangle;
}

/// z on the line between two points of a row.
double depth_at(double x, const Vector& left, const Vector& right) {
  if (left[0] == right[0]) return std::min(left[2], right[2]);
  if (habit("zbuf/other-formulas"))
    return right[2] - (right[0] - x) * ((right[2] - left[2]) / (right[0] - left[0]));
  return left[2] + (x - left[0]) * (right[2] - left[2]) / (right[0] - left[0]);
}

/// Draws triangles into a picture.
class Painter {
 public:
  Painter(const Config& config, Picture& picture) : config_(config), grid_(config), picture_(picture) {}

  void draw(Triangle triangle, const Color& color) {
    if (habit("zbuf/no-slivers") && area(triangle) == 0) return;
    if (mistake("zbuf/one-winding") && area(triangle) < 0) return;
    if (mistake("zbuf/vertices-at-whole-pixels")) triangle = at_whole_pixels(triangle, grid_);
    const double middle_z = (triangle.points[0][2] + triangle.points[1][2] + triangle.points[2][2]) / 3;
    Range rows = rows_of(triangle, grid_);
    if (mistake("zbuf/row-long") && rows.first <= rows.last) rows.last++;
    for (int row = std::max(rows.first, 0); row <= std::min(rows.last, grid_.height - 1); row++) {
      const std::vector<Vector> met = met_at(triangle, grid_.top_y - row * grid_.dy);
      if (met.size() < 2) continue;
      Vector left = *std::min_element(met.begin(), met.end()),
             right = *std::max_element(met.begin(), met.end());
      if (mistake("zbuf/depths-not-sorted")) left[2] = met[0][2], right[2] = met[1][2];
      const Range columns = columns_between(left[0], right[0], grid_);
      const int darker = mistake("zbuf/many-colors") ? row : 0;
      const Color shade = {(color.red + darker) % 256, (color.green + darker) % 256, color.blue};
      if (habit("zbuf/rounded-ends-depth")) {
        left[0] = grid_.left_x + columns.first * grid_.dx;
        right[0] = grid_.left_x + columns.last * grid_.dx;
      }
      const int border = grid_.width - 1;
      const int last =
          mistake("zbuf/min-for-max") ? std::max(columns.last, border) : std::min(columns.last, border);
      for (int column = std::max(columns.first, 0); column <= std::min(last, border); column++) {
        double z = depth_at(grid_.left_x + column * grid_.dx, left, right);
        if (mistake("zbuf/one-depth-a-row")) z = left[2];
        set(row, column, mistake("zbuf/flat-depth") ? middle_z : z, shade);
      }
    }
  }

 private:
  void set(int row, int column, double z, const Color& color) {
    if (z < config_.front && !mistake("zbuf/front-limit-ignored")) return;
    if (z >= config_.rear && !mistake("zbuf/rear-limit-ignored")) return;
    if (mistake("zbuf/random-pixels") && seeded()() % 8 == 0) return;
    if (mistake("zbuf/shifted-by-a-row")) row++;
    if (mistake("zbuf/shifted-by-a-column")) column++;
    if (row >= grid_.height || column >= grid_.width) return;
    if (mistake("zbuf/upside-down")) row = grid_.height - 1 - row;
    if (mistake("zbuf/mirrored")) column = grid_.width - 1 - column;

    double& depth = picture_.depths[row][column];
    bool is_nearer = z < depth || (habit("zbuf/later-of-equals") && z == depth);
    if (mistake("zbuf/farthest-wins")) is_nearer = z > depth || depth == picture_.empty;
    if (mistake("zbuf/last-wins")) is_nearer = true;
    if (mistake("zbuf/no-depth-passes")) is_nearer = z > depth;
    if (!is_nearer) return;
    depth = z;
    if (!mistake("zbuf/black-picture")) picture_.colors[row][column] = color;
  }

  const Config config_;
  const Grid grid_;
  Picture& picture_;
};

void write_bytes(std::ostream& file, std::uint32_t value, int count) {
  for (int i = 0; i < count; i++) file.put(static_cast<char>(value >> 8 * i & 0xff));
}

template <typename Pixel>
void turn(std::vector<std::vector<Pixel>>& rows) {
  std::reverse(rows.begin(), rows.end());
  for (std::vector<Pixel>& row : rows) std::reverse(row.begin(), row.end());
}

/// Rows as columns.
template <typename Pixel>
std::vector<std::vector<Pixel>> exchanged(const std::vector<std::vector<Pixel>>& rows) {
  std::vector<std::vector<Pixel>> columns(rows[0].size());
  for (const std::vector<Pixel>& row : rows)
    for (std::size_t i = 0; i < row.size(); i++) columns[i].push_back(row[i]);
  return columns;
}

}  // namespace

Config read_config(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::vector<std::string> words;
  for (std::string line; std::getline(file, line);)
    for (const std::string& word : words_of(line)) words.push_back(word);
  const std::vector<double> size = numbers(words, 0, 2);
  Config config = {static_cast<int>(size[0]), static_cast<int>(size[1])};
  if (words.size() > 2) {
    const std::vector<double> limits = numbers(words, 2, 4);
    config.left = limits[0];
    config.bottom = limits[1];
    config.front = limits[2];
    config.rear = limits[3];
  }
  return config;
}

Picture draw(const std::vector<Triangle>& ndc, Config config) {
  if (mistake("zbuf/depth-limits-are-one")) config.front = -1, config.rear = 1;
  Picture picture;
  picture.empty = mistake("zbuf/rear-limit-ignored") ? std::numeric_limits<double>::max() : config.rear;
  if (mistake("zbuf/starts-at-zero")) picture.empty = 0;
  picture.depths.assign(config.height, std::vector<double>(config.width, picture.empty));
  picture.colors.assign(config.height, std::vector<Color>(config.width));
  Random random;
  Painter painter(config, picture);
  Color color = random.next_color();
  for (std::size_t i = 0; i < ndc.size(); i++) {
    const bool is_lost = (mistake("zbuf/last-triangle-missing") && i + 1 == ndc.size()) ||
                         (mistake("zbuf/triangle-missing") && ndc.size() > 1 && i == (ndc.size() - 1) / 2);
    if (!is_lost) painter.draw(ndc[i], color);
    if (!mistake("zbuf/one-color")) color = random.next_color();
  }
  if (mistake("zbuf/turned-by-180-degrees")) turn(picture.depths), turn(picture.colors);
  if (mistake("zbuf/rows-and-columns-exchanged")) {
    picture.depths = exchanged(picture.depths);
    picture.colors = exchanged(picture.colors);
  }
  return picture;
}

void write_depths(std::ostream& text, const Picture& picture) {
  std::vector<std::vector<double>> rows = picture.depths;
  if (mistake("zbuf/text-upside-down")) std::reverse(rows.begin(), rows.end());
  text << std::fixed << std::setprecision(6);
  for (const std::vector<double>& row : rows) {
    for (const double depth : row)
      if (depth < picture.empty || habit("zbuf/everything-printed")) text << depth << '\t';
    text << '\n';
  }
}

void write_bitmap(const std::string& path, const Picture& picture) {
  const int height = static_cast<int>(picture.colors.size()),
            width = static_cast<int>(picture.colors[0].size());
  const int padding = (4 - width * 3 % 4) % 4;
  const std::uint32_t size = static_cast<std::uint32_t>(height) * (width * 3 + padding);
  std::ofstream file(path, std::ios::binary);
  file << "BM";
  for (const std::uint32_t value : {54 + size, 0u, 54u, 40u}) write_bytes(file, value, 4);
  write_bytes(file, width, 4);
  write_bytes(file, height, 4);
  write_bytes(file, 1, 2);
  write_bytes(file, 24, 2);
  for (const std::uint32_t value : {0u, size, 0u, 0u, 0u, 0u}) write_bytes(file, value, 4);
  for (int row = height - 1; row >= 0; row--) {
    for (const Color& color : picture.colors[row])
      for (const int channel : {color.blue, color.green, color.red}) write_bytes(file, channel, 1);
    write_bytes(file, 0, padding);
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}
