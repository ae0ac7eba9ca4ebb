#include "tools/stage_team.h"

#include <stdexcept>

namespace pipeline {
namespace {

// Enough that one that takes longer does not keep the others waiting.
constexpr int kSlotsPerThread = 4;
// In characters: a block is read, and what comes of it is written as one.
constexpr std::size_t kPartSize = std::size_t{1} << 15;

/// A failure of what is done while a source reads; none of its own.
struct WriteFailure {
  std::exception_ptr cause;
};

}  // namespace

StageTeam::StageTeam(Tool& tool, StageWriter& writer, const CoordinateRounder& rounder, int thread_count,
                     TriangleSource& source,
                     const std::function<BatchTransform(CoordinateRounder&)>& make_transform)
    : tool_(tool), writer_(writer), source_(source), parts_(source, kPartSize), pool_(thread_count) {
  for (int i = 0; i < thread_count * kSlotsPerThread; ++i)
    slots_.emplace_back(writer, rounder, make_transform);
  // What is in work is not kept back while the input is waited for.
  tool_.input().set_before_waiting([this] {
    try {
      write_all();
    } catch (...) {
      throw WriteFailure{std::current_exception()};
    }
  });
}

StageTeam::~StageTeam() {
  tool_.input().set_before_waiting({});
}

void StageTeam::Slot::work(TriangleParts& parts) {
  is_read = !is_part || parts.read(part, batch);
  if (is_read) {
    triangle_count = batch.size();
    try {
      transform(batch);
    } catch (const std::runtime_error&) {
      failure = std::current_exception();
    } catch (...) {  // lack of memory may have left the batch half filled
      failure = std::current_exception();
      batch.clear();
    }
    writer.begin_part(batch.empty() ? 0 : batch.numbers.front());
    writer.write(batch);
  }
  is_done = true;
}

LineAndColumn StageTeam::run() {
  for (;;) {
    write_done();
    if (end_ - begin_ == slots_.size()) make_room();
    if (!fill_next()) break;
    Slot& next = slot(end_++);
    next.is_done = false;
    pool_.start(1, [this, &next](int, int) { next.work(parts_); });
  }
  write_all();
  if (read_failure_ != nullptr) std::rethrow_exception(read_failure_);
  LineAndColumn first;
  for (const Slot& slot : slots_) {
    const LineAndColumn location = slot.rounder.first_uncertain();
    if (location.is_known() && (!first.is_known() || location.line() < first.line())) first = location;
  }
  return first;
}

/// Fills the next slot, by a part of the text if possible; false at the end of the input or where it fails.
bool StageTeam::fill_next() {
  bool is_filled = try_to_read([this] {
    Slot& next = slot(end_);
    return next.is_part = parts_.take(next.part, next.batch);
  });
  if (!is_filled && read_failure_ == nullptr) {
    if (parts_.is_open()) write_all();
    parts_.close();
    is_filled = try_to_read([this] {
      Slot& next = slot(end_);
      next.is_part = false;
      return source_.read(next.batch);
    });
  }
  tool_.timing().lap(&Timing::read_seconds);
  return is_filled;
}

/// Keeps a failure until what was read before is written.
bool StageTeam::try_to_read(const std::function<bool()>& read) {
  try {
    return read();
  } catch (const WriteFailure& failure) {
    std::rethrow_exception(failure.cause);
  } catch (...) {
    read_failure_ = std::current_exception();
    return false;
  }
}

/// Works until the first slot is done, and writes it.
void StageTeam::make_room() {
  while (!slot(begin_).is_done) pool_.run_one();
  tool_.timing().lap(&Timing::work_seconds);
  write_done();
}

void StageTeam::write_all() {
  pool_.finish();
  tool_.timing().lap(&Timing::work_seconds);
  write_done();
}

void StageTeam::write_done() {
  while (begin_ != end_ && slot(begin_).is_done) {
    if (!slot(begin_).is_read) return put_back();
    write(slot(begin_++));
  }
}

/// Puts back all that is in work: parts of which the first holds more than triangles.
void StageTeam::put_back() {
  pool_.finish();
  for (; end_ != begin_; --end_) parts_.put_back(slot(end_ - 1).part);
  parts_.close();
}

void StageTeam::write(const Slot& slot) {
  tool_.timing().triangle_count += slot.triangle_count;
  writer_.append_part(slot.writer);
  tool_.output().flush();
  tool_.timing().lap(&Timing::write_seconds);
  if (slot.failure != nullptr) std::rethrow_exception(slot.failure);
}

}  // namespace pipeline
