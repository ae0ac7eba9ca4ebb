#include "tools/stage_rounds.h"

#include <utility>

namespace pipeline {
namespace {

// Enough that one that takes longer does not keep the others waiting.
constexpr int kSlotsPerThread = 6;

}  // namespace

StageRounds::StageRounds(Tool& tool, StageWriter& writer, const CoordinateRounder& rounder, int thread_count,
                         const std::function<BatchTransform(CoordinateRounder&)>& make_transform)
    : tool_(tool), writer_(writer), team_(thread_count) {
  for (Round& round : rounds_)
    for (int i = 0; i < thread_count * kSlotsPerThread; ++i)
      round.slots.emplace_back(writer, rounder, make_transform);
}

void StageRounds::Slot::work() {
  try {
    transform(batch);
  } catch (...) {
    failure = std::current_exception();
  }
  writer.begin_part(batch.empty() ? 0 : batch.numbers.front());
  writer.write(batch);
}

LineAndColumn StageRounds::run(const std::function<bool(TriangleBatch&)>& read) {
  Round* in_work = &rounds_[0];
  Round* next = &rounds_[1];
  do {
    // What is in work is not kept back while the input is waited for.
    fill(*next, read, in_work->count == 0);
    team_.finish();
    tool_.timing().lap(&Timing::work_seconds);
    start(*next);
    write(*in_work);
    std::swap(in_work, next);
  } while (in_work->count > 0 || (has_more_ && read_failure_ == nullptr));
  if (read_failure_ != nullptr) std::rethrow_exception(read_failure_);
  LineAndColumn first;
  for (const Round& round : rounds_)
    for (const Slot& slot : round.slots) {
      const LineAndColumn place = slot.rounder.first_uncertain();
      if (place.is_known() && (!first.is_known() || place.line() < first.line())) first = place;
    }
  return first;
}

/// Reads batches until the round is full, the input ends or fails, or would have to be waited for.
void StageRounds::fill(Round& round, const std::function<bool(TriangleBatch&)>& read, bool may_wait) {
  round.count = 0;
  for (Slot& slot : round.slots) {
    if (!has_more_ || read_failure_ != nullptr) break;
    if (!(may_wait && round.count == 0) && !tool_.input().is_ready()) break;
    try {
      has_more_ = read(slot.batch);
    } catch (...) {
      read_failure_ = std::current_exception();
      break;
    }
    if (has_more_) ++round.count;
    tool_.timing().triangle_count += slot.batch.size();
  }
  tool_.timing().lap(&Timing::read_seconds);
}

void StageRounds::start(Round& round) {
  if (round.count == 0) return;
  team_.start(round.count, [&round](int i, int) { round.slots[static_cast<std::size_t>(i)].work(); });
}

void StageRounds::write(Round& round) {
  for (int i = 0; i < round.count; ++i) {
    const Slot& slot = round.slots[static_cast<std::size_t>(i)];
    writer_.append_part(slot.writer);
    if (slot.failure == nullptr) continue;
    tool_.output().flush();
    std::rethrow_exception(slot.failure);
  }
  round.count = 0;
  tool_.output().flush();
  tool_.timing().lap(&Timing::write_seconds);
}

}  // namespace pipeline
