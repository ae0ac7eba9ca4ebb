#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "libpipeline/vertex/affine_matrix.h"

namespace pipeline {

/// The stack of model matrices (glPushMatrix, glPopMatrix). A matrix pushed again without a change in between
/// is stored once and counted, so that repeated pushes take no memory.
class MatrixStack {
 public:
  /// The limit on saved matrices that differ from their neighbors in the stack.
  static constexpr std::size_t kMaxSaved = std::size_t{1} << 20;

  explicit MatrixStack(std::size_t max_saved = kMaxSaved) : max_saved_(max_saved) {}

  [[nodiscard]] const AffineMatrix& top() const { return top_; }
  /// top = top * t: `t` is applied to a point first.
  void multiply(const AffineMatrix& t) { set_top(top_ * t); }
  void translate(const Vec3& offset) { set_top(translated(top_, offset)); }
  void scale(const Vec3& factors) { set_top(scaled(top_, factors)); }
  /// Saves the top; false, with nothing done, if it is not the matrix saved last and max_saved() are stored.
  [[nodiscard]] bool push() {
    if (top_is_saved_ || (!saved_.empty() && saved_.back().matrix == top_)) {
      ++saved_.back().count;
    } else {
      if (saved_.size() >= max_saved_) return false;
      saved_.push_back({top_});
    }
    return top_is_saved_ = true;
  }
  /// Restores the matrix saved last; false, with nothing done, if none is saved.
  [[nodiscard]] bool pop() {
    if (saved_.empty()) return false;
    if (!top_is_saved_) top_ = saved_.back().matrix;
    top_is_saved_ = --saved_.back().count > 0;
    if (!top_is_saved_) saved_.pop_back();
    return true;
  }
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
  bool top_is_saved_ = false;  // top_ equals the matrix saved last
};

}  // namespace pipeline
