#include "libpipeline/vertex/matrix_stack.h"

namespace pipeline {

bool MatrixStack::push() {
  if (top_is_saved_ || (!saved_.empty() && saved_.back().matrix == top_)) {
    ++saved_.back().count;
  } else {
    if (saved_.size() >= max_saved_) return false;
    saved_.push_back({top_});
  }
  top_is_saved_ = true;
  return true;
}

bool MatrixStack::pop() {
  if (saved_.empty()) return false;
  if (!top_is_saved_) top_ = saved_.back().matrix;
  top_is_saved_ = --saved_.back().count > 0;
  if (!top_is_saved_) saved_.pop_back();
  return true;
}

}  // namespace pipeline
