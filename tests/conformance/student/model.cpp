// Stage 1: model space to world space.

#include <algorithm>
#include <istream>
#include <stack>
#include <stdexcept>

#include "tests/conformance/student/stages.h"
#include "tests/conformance/student/switches.h"

namespace {

/// Rodrigues' formula: x turned by `angle` about the unit vector `a`.
Vector rodrigues(const Vector& x, const Vector& a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Vector side = cross(a, x);
  Vector result(3);
  const double along = (mistake("model/rotation-without-a-term") ? 1 : 1 - c) * dot(a, x);
  for (int i = 0; i < 3; i++) result[i] = c * x[i] + along * a[i] + s * side[i];
  return result;
}

double largest(const Vector& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

Matrix rotation(double degrees, Vector axis) {
  double angle = degrees * kPi / 180;
  if (mistake("model/angle-in-radians")) angle = degrees;
  if (mistake("model/angle-negated")) angle = -angle;
  if (!mistake("model/axis-not-normalized")) axis = normalized(axis);
  if (mistake("model/rotation-by-euler-angles") && dot(axis, axis) > std::pow(largest(axis), 2)) {
    const auto turned = [&](Vector unit, int i) { return rotation(degrees * axis[i], unit); };
    return product(turned({1, 0, 0}, 0), product(turned({0, 1, 0}, 1), turned({0, 0, 1}, 2)));
  }

  const Vector c1 = rodrigues({1, 0, 0}, axis, angle);
  const Vector c2 = rodrigues({0, 1, 0}, axis, angle);
  const Vector c3 = rodrigues({0, 0, 1}, axis, angle);
  Matrix result = identity();
  for (int i = 0; i < 3; i++) {
    result[i][0] = c1[i];
    result[i][1] = c2[i];
    result[i][2] = c3[i];
  }
  if (mistake("model/rotation-element-from-the-wrong-column")) result[0][2] = c2[0];
  return mistake("model/rotation-transposed") ? transposed(result) : result;
}

Matrix scaling(const Vector& s) {
  return {{s[0], 0, 0, 0}, {0, s[1], 0, 0}, {0, 0, s[2], 0}, {0, 0, 0, 1}};
}

class MatrixStack {
 public:
  Matrix top = identity();

  void multiply(const Matrix& t) {
    top = mistake("model/multiplied-on-the-left") ? product(t, top) : product(top, t);
    if (mistake("model/pop-takes-one-transform")) saved.push(top);
  }

  void rotate(const Matrix& r) {
    if (!mistake("model/rotation-on-the-left")) return multiply(r);
    top = product(r, top);
  }

  void translate(const Vector& t) {
    if (!mistake("model/translation-added")) return multiply(translation(t));
    for (int i = 0; i < 3; i++) top[i][3] += t[i];
  }

  void push(bool is_after_push) {
    if (mistake("model/push-and-pop-ignored")) return;
    if (mistake("model/second-push-lost") && is_after_push) return;
    if (mistake("model/push-does-not-nest")) saved = {};
    saved.push(top);
    if (mistake("model/push-of-the-identity")) top = identity();
  }

  void pop() {
    if (mistake("model/push-and-pop-ignored") || mistake("model/pop-ignored") || saved.empty()) return;
    if (mistake("model/pop-takes-one-transform")) {
      saved.pop();
      top = saved.empty() ? identity() : saved.top();
      return;
    }
    top = mistake("model/pop-to-the-identity") ? identity() : saved.top();
    saved.pop();
  }

 private:
  std::stack<Matrix> saved;
};

}  // namespace

std::vector<Triangle> model(std::istream& commands) {
  std::vector<std::string> words;
  for (std::string line; std::getline(commands, line);)
    for (const std::string& word : words_of(line)) words.push_back(word);

  MatrixStack stack;
  std::vector<Triangle> triangles;
  std::size_t next = 0;
  const auto read = [&](std::size_t count) {
    next += count;
    return numbers(words, next - count, count);
  };
  std::string command, previous;
  while (next < words.size()) {
    previous = command;
    command = words[next++];
    if (command == "triangle") {
      Triangle triangle;
      for (int i = 0; i < 3; i++) {
        Vector point = homogeneous(stack.top, read(3));
        point.pop_back();  // w is 1
        triangle.points.push_back(point);
      }
      triangles.push_back(triangle);
    } else if (command == "translate") {
      stack.translate(read(3));
    } else if (command == "scale") {
      stack.multiply(scaling(read(3)));
    } else if (command == "rotate") {
      const double angle = read(1)[0];
      stack.rotate(rotation(angle, read(3)));
    } else if (command == "push") {
      stack.push(previous == "push");
    } else if (command == "pop") {
      stack.pop();
    } else if (command == "end") {
      return triangles;
    } else {
      throw std::runtime_error("unknown command " + command);
    }
  }
  throw std::runtime_error("the scene has no end");
}
