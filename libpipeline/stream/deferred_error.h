#pragma once

#include <exception>
#include <stdexcept>

#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// Holds back an input error until the triangles before it are delivered, so the output does not depend on
/// the size of batches.
class DeferredError {
 public:
  /// Keeps the exception being handled; the next call of `read` throws it.
  void keep() { deferred_error_ = std::current_exception(); }

  /// Clears the batch and calls `fill`, which adds triangles to it; false if it added none. An error that
  /// `fill` throws is thrown at once if the batch is empty, else by the next call.
  template <typename Fill>
  bool read(TriangleBatch& batch, const Fill& fill) {
    batch.clear();
    if (deferred_error_) std::rethrow_exception(deferred_error_);
    try {
      fill();
    } catch (const std::runtime_error&) {  // after std::bad_alloc the batch may be half filled
      if (batch.empty()) throw;
      keep();
    }
    return !batch.empty();
  }

 private:
  std::exception_ptr deferred_error_;
};

}  // namespace pipeline
