#include "libpipeline/triangle_parts.h"

#include <exception>
#include <string_view>

namespace pipeline {
namespace {

constexpr std::size_t kLinesPerTriangle = 4;
// As many triangles are read in order behind text that had another form: more than there may be in parts that
// were read in vain.
constexpr std::uint64_t kReadInOrder = 1 << 14;
constexpr std::uint16_t kAllDecimal = 0x1ff;

/// Reads the text into the batch, but for what depends on the place; false if it has another form.
bool read_form(const TrianglePart& part, TriangleBatch& batch) {
  static_assert(TextReader::kSlack >= kFixedTextSlack);
  constexpr std::size_t kShortest = 9 * std::string_view("0.0000000 ").size();
  const std::string_view text = part.text.text();
  batch.triangles.resize(text.size() / kShortest + 1);
  const FixedTextPart read = part.read(text, batch.triangles);
  batch.triangles.resize(read.triangle_count);
  return read.length == text.size();
}

/// Says where the triangles of the batch are.
void set_places(const TrianglePart& part, const TrianglePlace& begin, TriangleBatch& batch) {
  const std::size_t count = batch.triangles.size();
  batch.numbers.resize(count);
  batch.places.resize(count);
  std::size_t line = begin.line_count + 1 + part.first_vertex;
  for (std::size_t i = 0; i < count; ++i, line += kLinesPerTriangle) {
    batch.numbers[i] = begin.number + i;
    batch.places[i] = {line, line + 1, line + 2};
  }
  if (part.marks_decimals) batch.decimal_marks.assign(count, kAllDecimal);
}

}  // namespace

bool TriangleParts::take(TrianglePart& part, TriangleBatch& batch) {
  if (!is_open_ && source_.place().number < first_number_) return false;
  if (!source_.take_part(part_size_, part, batch)) return false;
  if (!is_open_) {
    is_open_ = true;
    place_ = source_.place();
    has_other_form_ = false;
  }
  part.turn = taken_count_++;
  return true;
}

bool TriangleParts::read(const TrianglePart& part, TriangleBatch& batch) {
  bool has_form = false;
  std::exception_ptr failure;
  try {
    has_form = read_form(part, batch);
  } catch (...) {
    failure = std::current_exception();
  }
  for (std::uint64_t turn = turn_; turn != part.turn; turn = turn_) turn_.wait(turn);
  has_other_form_ |= !has_form;
  const bool is_read = !has_other_form_;
  const TrianglePlace begin = place_;
  if (is_read) {
    place_.line_count += kLinesPerTriangle * batch.triangles.size();
    place_.number += batch.triangles.size();
  }
  // Others need the turn even where this thread has failed.
  turn_ = part.turn + 1;
  turn_.notify_all();
  if (failure) std::rethrow_exception(failure);
  if (is_read) set_places(part, begin, batch);
  return is_read;
}

void TriangleParts::put_back(const TrianglePart& part) {
  source_.put_back(part);
}

void TriangleParts::close() {
  if (!is_open_) return;
  is_open_ = false;
  source_.pass(place_);
  if (has_other_form_) first_number_ = place_.number + kReadInOrder;
}

}  // namespace pipeline
