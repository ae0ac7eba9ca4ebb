#include "libpipeline/stream/read_ahead.h"

#include <utility>

namespace pipeline {
namespace {

// In characters: about as many triangles as a batch has.
constexpr std::size_t kPartSize = std::size_t{1} << 17;
constexpr std::size_t kSlotsPerThread = 2;

}  // namespace

ReadAhead::ReadAhead(TriangleSource& source, ThreadPool& pool)
    : source_(source), parts_(source, kPartSize), pool_(pool) {
  if (pool.size() > 1) slots_.resize(kSlotsPerThread * static_cast<std::size_t>(pool.size()));
}

bool ReadAhead::read(TriangleBatch& batch) {
  do {
    take_parts();
    if (!take_first(batch)) {
      parts_.close();
      return source_.read(batch);
    }
  } while (batch.empty());  // a part may hold comments alone
  return true;
}

/// Has the pool read parts, as long as there is room and text.
void ReadAhead::take_parts() {
  while (end_ - begin_ < slots_.size() && parts_.take(slot(end_).part, slot(end_).batch)) {
    Slot& next = slot(end_++);
    next.is_done = false;
    pool_.start(1, [this, &next](int, int) {
      next.is_read = parts_.read(next.part, next.batch);
      next.is_done = true;
    });
  }
}

/// Waits for the first part in work; false if there is none, or none that could be read.
bool ReadAhead::take_first(TriangleBatch& batch) {
  if (begin_ == end_) return false;
  while (!slot(begin_).is_done) pool_.run_one();
  if (slot(begin_).is_read) {
    std::swap(batch, slot(begin_++).batch);
    return true;
  }
  pool_.finish();
  for (; end_ != begin_; --end_) parts_.put_back(slot(end_ - 1).part);
  return false;
}

}  // namespace pipeline
