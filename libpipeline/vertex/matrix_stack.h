#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "libpipeline/vertex/affine_matrix.h"

namespace pipeline {

/// The stack of modelling matrices (glPushMatrix, glPopMatrix). A matrix that is saved again and again
/// without a change in between is kept once and counted, so that repeated pushes cost nothing.
class MatrixStack {
 public:
  /// The most saved matrices that differ from their neighbors in the stack.
  static constexpr std::size_t kMaxSaved = std::size_t{1} << 20;

  explicit MatrixStack(std::size_t max_saved = kMaxSaved) : max_saved_(max_saved) {}

  [[nodiscard]] const AffineMatrix& top() const { return top_; }
  /// top = top * t: `t` is what a point meets first.
  void multiply(const AffineMatrix& t) { set_top(top_ * t); }
  void translate(const Vec3& offset) { set_top(translated(top_, offset)); }
  void scale(const Vec3& factors) { set_top(scaled(top_, factors)); }
  /// False, and nothing happens, if max_saved() matrices are saved.
  [[nodiscard]] bool push();
  /// False, and nothing happens, if nothing is saved.
  [[nodiscard]] bool pop();
  [[nodiscard]] std::size_t max_saved() const { return max_saved_; }

 private:
  struct Saved {
    AffineMatrix matrix;
    std::uint64_t count = 1;
  };

  void set_top(const AffineMatrix& m) {
    top_ = m;
    top_is_saved_ = false;
  }

  std::size_t max_saved_;
  AffineMatrix top_ = identity();
  std::deque<Saved> saved_;
  bool top_is_saved_ = false;  // top_ is known to equal the matrix saved last
};

}  // namespace pipeline
