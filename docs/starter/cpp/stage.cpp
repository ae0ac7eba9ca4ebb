// Three stages of the pipeline: reading and writing are done; the calculation is yours.
//
//     g++ -O2 -o stage stage.cpp && ./stage view < stage1.txt > stage2.txt
//
// The first word is model, view or project. Try each: pipeline check-stage view -- ./stage view
#include <array>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <stack>
#include <string>
#include <vector>

using Point = std::array<double, 3>;
using Matrix = std::array<std::array<double, 4>, 4>;

// Says once on stderr what is missing; stdout is for the next stage.
void to_do(const std::string& text) {
  static std::set<std::string> said;
  if (said.insert(text).second) std::cerr << "to do: " << text << "\n";
}

// Your part: these four functions. The rest is done.

// The current matrix after translate X Y Z, scale X Y Z or rotate DEGREES X Y Z.
Matrix transformed(const Matrix& matrix, const std::string& command, const std::vector<double>& numbers) {
  to_do("transformed() in stage.cpp: multiply the matrix by the command's, which goes on the right");
  (void)command, (void)numbers;
  return matrix;
}

// A vertex of a triangle in world space.
Point to_world(const Matrix& matrix, Point p) {
  to_do("to_world() in stage.cpp: multiply the matrix by the point (x, y, z, 1)");
  (void)matrix;
  return p;
}

// A point of world space in view space: the eye at the origin, looking down -z.
Point to_view(Point eye, Point look, Point up, Point p) {
  to_do("to_view() in stage.cpp: subtract the eye, then turn by the rows r, u and -l");
  (void)eye, (void)look, (void)up;
  return p;
}

// A point of view space in normalized device coordinates. The angle is in degrees.
Point to_ndc(double fov_y, double aspect, double near, double far, Point p) {
  to_do("to_ndc() in stage.cpp: multiply by the perspective matrix, then divide by w");
  (void)fov_y, (void)aspect, (void)near, (void)far;
  return p;
}

// The next line that is not empty, without its comment; false at the end.
bool next_line(std::string& line) {
  while (std::getline(std::cin, line))
    if ((line = line.substr(0, line.find('#'))).find_first_not_of(" \t\r") != std::string::npos) return true;
  return false;
}

std::vector<double> numbers_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<double>(in), {}};
}

Point point(const std::vector<double>& numbers) {
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

// Writes a vertex, and a blank line after every third.
void write(Point p) {
  static int count = 0;
  std::printf("%.7f %.7f %.7f\n%s", p[0], p[1], p[2], ++count % 3 ? "" : "\n");
}

// Reads a scene: four lines of the camera, then commands.
void model() {
  std::string line;
  for (const char* name : {"eye", "look", "up", "perspective"})
    if (next_line(line)) std::printf("%s %s\n", name, line.c_str());
  Matrix matrix{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  std::stack<Matrix> saved;
  for (std::string command; next_line(line);) {
    std::istringstream words(line);
    std::getline(words >> command, line);  // the numbers, or nothing: then they have the next line
    if (command == "end") return;
    if (command == "push")
      saved.push(matrix);
    else if (command == "pop")
      matrix = saved.top(), saved.pop();
    else if (command == "triangle")
      for (int i = 0; i < 3 && next_line(line); ++i) write(to_world(matrix, point(numbers_of(line))));
    else if (!numbers_of(line).empty() || next_line(line))
      matrix = transformed(matrix, command, numbers_of(line));
  }
}

// Reads a header of words and numbers, then vertices. View passes the perspective on.
void later_stage(bool is_view) {
  std::map<std::string, std::vector<double>> header;
  for (std::string line, word; next_line(line);) {
    std::istringstream(line) >> word;
    if (word[0] >= 'a') {  // not a digit or a sign
      header[word] = numbers_of(line.substr(line.find(word) + word.size()));
      if (is_view && word == "perspective") std::printf("%s\n", line.c_str());
      continue;
    }
    const Point p = point(numbers_of(line));
    const auto& lens = header["perspective"];
    write(is_view ? to_view(point(header["eye"]), point(header["look"]), point(header["up"]), p)
                  : to_ndc(lens.at(0), lens.at(1), lens.at(2), lens.at(3), p));
  }
}

int main(int, char** words) {
  const std::string stage = words[1];
  stage == "model" ? model() : later_stage(stage == "view");
}
