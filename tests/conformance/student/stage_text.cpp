#include "tests/conformance/student/stage_text.h"

#include <iomanip>
#include <istream>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "tests/conformance/student/switches.h"

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line.substr(0, line.find('#')));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

double number(const std::string& word) {
  std::istringstream stream(word);
  double value;
  if (!(stream >> value) || !stream.eof()) throw std::runtime_error("expected a number, found " + word);
  return value;
}

std::vector<double> numbers(const std::vector<std::string>& words, std::size_t first, std::size_t count) {
  if (words.size() < first + count) throw std::runtime_error("a number is missing");
  std::vector<double> values;
  for (std::size_t i = first; i < first + count; i++) values.push_back(number(words[i]));
  return values;
}

void read_projection(std::vector<std::string> words, Camera& camera) {
  camera.kind = "perspective";
  if (words.size() > 0 && (words[0] == "ortho" || words[0] == "perspective")) {
    camera.kind = words[0];
    words.erase(words.begin());
  }
  const std::size_t count = camera.kind == "ortho" ? 6 : 4;
  camera.numbers = numbers(words, 0, count);
  camera.rule = words.size() > count ? words[count] : "";
}

Camera read_camera(std::istream& scene) {
  std::vector<std::vector<std::string>> lines;
  for (std::string line; lines.size() < 4 && std::getline(scene, line);)
    if (!words_of(line).empty()) lines.push_back(words_of(line));
  if (lines.size() < 4) throw std::runtime_error("the camera has four lines");
  Camera camera;
  camera.eye = numbers(lines[0], 0, 3);
  camera.look = numbers(lines[1], 0, 3);
  camera.up = numbers(lines[2], 0, 3);
  read_projection(lines[3], camera);
  return camera;
}

void read_stage(std::istream& text, Scene& scene) {
  Camera& camera = scene.camera;
  std::vector<Vector> points;
  for (std::string line; std::getline(text, line);) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "eye")
      camera.eye = numbers(words, 1, 3);
    else if (words[0] == "look")
      camera.look = numbers(words, 1, 3);
    else if (words[0] == "up")
      camera.up = numbers(words, 1, 3);
    else if (words[0] == "perspective" || words[0] == "ortho")
      read_projection(words, camera);
    else
      points.push_back(numbers(words, 0, 3));
    if (points.size() == 3) {
      scene.triangles.push_back({points});
      points.clear();
    }
  }
  if (!points.empty()) throw std::runtime_error("the text ends inside a triangle");
}

void write_stage(std::ostream& text, const Scene& scene, Header header) {
  const Camera& camera = scene.camera;
  const std::string end = habit("all/carriage-returns") ? "\r\n" : "\n";
  const auto write = [&](const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); i++) text << (i > 0 ? " " : "") << values[i];
    if (habit("all/blanks-at-line-ends")) text << ' ';
  };
  const auto write_named = [&](const std::string& name, const std::vector<double>& values) {
    text << name << ' ';
    write(values);
  };

  text << std::setprecision(17);  // the next stage reads the same camera
  if (header == Header::kCamera) {
    write_named("eye", camera.eye);
    text << end;
    write_named("look", camera.look);
    text << end;
    write_named("up", camera.up);
    text << end;
  }
  if (header != Header::kNone && !camera.kind.empty()) {
    write_named(camera.kind, camera.numbers);
    if (!camera.rule.empty()) text << ' ' << camera.rule;
    text << end;
  }

  if (habit("all/six-digits"))
    text << std::setprecision(6);
  else
    text << std::fixed << std::setprecision(habit("all/four-decimals") ? 4 : 7);
  for (const Triangle& triangle : scene.triangles) {
    for (const Vector& point : triangle.points) {
      write(point);
      text << end;
    }
    text << end;
  }
}
