#pragma once

#include <cmath>
#include <vector>

constexpr double kPi = 3.14159265358979323846;

using Vector = std::vector<double>;  // x, y, z
using Matrix = std::vector<std::vector<double>>;

struct Triangle {
  std::vector<Vector> points;
};

inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Vector normalized(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

inline Matrix identity() {
  return {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
}

inline Matrix translation(const Vector& t) {
  return {{1, 0, 0, t[0]}, {0, 1, 0, t[1]}, {0, 0, 1, t[2]}, {0, 0, 0, 1}};
}

inline Matrix transposed(const Matrix& a) {
  Matrix result = a;
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) result[i][j] = a[j][i];
  return result;
}

inline Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result(4, std::vector<double>(4, 0));
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++)
      for (int k = 0; k < 4; k++) result[i][j] += a[i][k] * b[k][j];
  return result;
}

/// The image of a point, with its w.
inline Vector homogeneous(const Matrix& m, const Vector& p) {
  Vector result(4, 0);
  for (int i = 0; i < 4; i++) result[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3];
  return result;
}
