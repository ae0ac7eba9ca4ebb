#pragma once

#include <exception>
#include <stdexcept>

#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// A mistake in a text, kept until the triangles before it were given out: how much of the text passes then
/// does not depend on the size of batches.
class DeferredError {
 public:
  /// The next call of `read` throws the exception that is being handled.
  void keep() { deferred_error_ = std::current_exception(); }

  [[nodiscard]] bool is_kept() const { return deferred_error_ != nullptr; }

  /// Has `fill` put triangles into the batch, emptied before; false if there were none. What `fill` throws
  /// is thrown at once if there are none before it, else by the next call.
  template <typename Fill>
  bool read(TriangleBatch& batch, const Fill& fill) {
    batch.clear();
    if (deferred_error_) std::rethrow_exception(deferred_error_);
    try {
      fill();
    } catch (const std::runtime_error&) {  // lack of memory may have left the batch half filled
      if (batch.empty()) throw;
      keep();
    }
    return !batch.empty();
  }

 private:
  std::exception_ptr deferred_error_;
};

}  // namespace pipeline
