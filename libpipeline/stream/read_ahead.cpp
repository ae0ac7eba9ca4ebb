#include "libpipeline/stream/read_ahead.h"

#include <algorithm>
#include <utility>

#include "libpipeline/text/fixed_text.h"

namespace pipeline {
namespace {

constexpr std::size_t kSlotsPerThread = 2;
// In batches. Text in another form usually stays in that form, and parsing it ahead would be wasted work.
constexpr int kPause = 16;

}  // namespace

ReadAhead::ReadAhead(StageReader& reader, ThreadPool& pool, std::size_t part_size)
    : reader_(reader), part_size_(part_size), pool_(pool) {
  if (pool.size() > 1) slots_.resize(kSlotsPerThread * static_cast<std::size_t>(pool.size()));
}

bool ReadAhead::read(TriangleBatch& batch) {
  if (pause_ > 0)
    --pause_;
  else
    start_parts();
  if (begin_ == end_) return reader_.read(batch);
  Slot& first = slot(begin_);
  wait_for(first);
  if (first.read.length != first.length) {
    drop_parts();
    pause_ = kPause;
    return reader_.read(batch);
  }
  ++begin_;
  length_ -= first.length;
  reader_.consume_fixed_form(first.read, first.batch);
  std::swap(batch, first.batch);
  return true;
}

void ReadAhead::Slot::parse() {
  const std::size_t min_length = min_fixed_triangle_length(decimals_of_number(text.data()));
  batch.clear();
  batch.triangles.resize(std::min(kBatchSize, length / min_length));
  read = read_columns(std::string_view(text).substr(0, length), TriangleFrame::stage_text,
                      {{batch.triangles}, {}}, {});
  batch.triangles.resize(read.triangle_count);
  is_done = true;
}

/// Hands parts to the pool as long as there is a free slot and text.
void ReadAhead::start_parts() {
  static_assert(TextReader::kSlack >= kFixedTextSlack);
  while (end_ - begin_ < slots_.size()) {
    const std::string_view part = next_part();
    if (part.empty()) return;
    Slot& next = slot(end_);
    next.text.assign(part.data(), part.size() + TextReader::kSlack);
    next.length = part.size();
    next.is_done = false;
    pool_.start(1, [&next](int, int) { next.parse(); });
    ++end_;
    length_ += part.size();
  }
}

/// The text of the next complete triangles after those in the slots: as many as fit a part and can be
/// buffered without waiting; empty if there are none.
std::string_view ReadAhead::next_part() {
  constexpr std::string_view kTriangleEnd = "\n\n";
  std::string_view text = reader_.buffered_triangles(length_ + part_size_);
  text.remove_prefix(std::min(length_, text.size()));
  text = text.substr(0, part_size_);
  const std::size_t last = text.rfind(kTriangleEnd);
  if (last != std::string_view::npos) return text.substr(0, last + kTriangleEnd.size());
  if (text.size() == part_size_) pause_ = kPause;
  return {};
}

/// Runs tasks of the pool until the slot is parsed.
void ReadAhead::wait_for(const Slot& slot) {
  while (!slot.is_done) pool_.run_one();
}

/// Empties all slots; the reader still has their text.
void ReadAhead::drop_parts() {
  for (std::size_t i = begin_; i != end_; ++i) wait_for(slot(i));
  end_ = begin_;
  length_ = 0;
}

}  // namespace pipeline
