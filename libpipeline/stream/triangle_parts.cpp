#include "libpipeline/stream/triangle_parts.h"

#include <algorithm>
#include <exception>
#include <span>
#include <utility>

namespace pipeline {
namespace {

/// Says where the triangles of the batch are, which was read as if the text began with it.
void move_to(const StreamPosition& begin, const PartContents& contents, TriangleBatch& batch) {
  const std::size_t counted = contents.first_numbered.value_or(batch.size());
  for (std::uint64_t& number : std::span(batch.numbers).first(counted)) number += begin.number;
  for (VertexLocations& locations : batch.locations)
    for (LineAndColumn& location : locations)
      location = {location.line() + begin.line_count, location.column()};
}

/// Keeps a failure.
PartContents contents_of(TextReader& part, const TriangleSource& source, TriangleBatch& batch,
                         std::exception_ptr& failure) {
  constexpr std::size_t kUsualLength = 91;  // of a triangle: nine numbers such as 0.1234567, and line ends
  try {
    batch.reserve(part.buffered().size() / kUsualLength);
    return source.read_part(part, batch);
  } catch (...) {
    failure = std::current_exception();
    return {};
  }
}

}  // namespace

bool TriangleParts::take(TrianglePart& part, TriangleBatch& batch) {
  if (!is_open_ && source_.location().line_count < first_line_) return false;
  if (!source_.take_part(part_size_, part.text, batch)) {
    // To look for one takes time, too: the longer there was none, the longer nobody looks.
    if (!is_open_)
      first_line_ =
          source_.location().line_count + std::exchange(pause_, std::min(2 * pause_, kLongestPause));
    return false;
  }
  pause_ = kShortestPause;
  if (!is_open_) {
    is_open_ = true;
    location_ = source_.location();
    is_broken_ = false;
  }
  part.turn = taken_count_++;
  return true;
}

bool TriangleParts::read(TrianglePart& part, TriangleBatch& batch) {
  TextReader text(part.text);
  std::exception_ptr failure;
  const PartContents contents = contents_of(text, source_, batch, failure);
  for (std::uint64_t turn = turn_; turn != part.turn; turn = turn_) turn_.wait(turn);
  is_broken_ |= !contents.is_whole;
  const bool is_read = !is_broken_;
  const StreamPosition begin = location_;
  if (is_read) {
    location_.line_count += text.line_number();
    location_.number = contents.next_number + (contents.first_numbered ? 0 : begin.number);
  }
  // Others need the turn even where this thread has failed.
  turn_ = part.turn + 1;
  turn_.notify_all();
  text.give_back(part.text);
  if (failure) std::rethrow_exception(failure);
  if (is_read) move_to(begin, contents, batch);
  return is_read;
}

void TriangleParts::put_back(const TrianglePart& part) {
  source_.put_back(part.text);
}

void TriangleParts::close() {
  if (!is_open_) return;
  is_open_ = false;
  source_.pass(location_);
  // So that no text is read in vain for long.
  if (is_broken_) first_line_ = location_.line_count + kLongestPause;
}

}  // namespace pipeline
