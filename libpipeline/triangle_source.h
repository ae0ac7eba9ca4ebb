#pragma once

#include <cstddef>
#include <cstdint>

#include "libpipeline/fixed_text.h"
#include "libpipeline/text_reader.h"
#include "libpipeline/triangle_batch.h"

namespace pipeline {

/// A place between the triangles of a text.
struct TrianglePlace {
  std::size_t line_count = 0;  // before it
  std::uint64_t number = 0;    // the next triangle's
};

/// Text that, as far as a look at its end tells, holds triangles in the form nearly all text has, and nothing
/// else: four lines each.
struct TrianglePart {
  TextPart text;
  ReadFixedText read = nullptr;  // what reads that form
  std::size_t first_vertex = 0;  // on which of its four lines, from 0, a triangle has its first vertex
  bool marks_decimals = false;   // whether batches are to say that all coordinates are exact decimals
  std::uint64_t turn = 0;        // see TriangleParts
};

/// Where a stage's triangles come from: batch by batch, or in parts that other threads read.
class TriangleSource {
 public:
  virtual ~TriangleSource() = default;

  /// Fills `batch` with the next triangles, as many as are waiting but at least one; false (and an empty
  /// batch) at the end. Triangles before a mistake are given out before the mistake is thrown.
  virtual bool read(TriangleBatch& batch) = 0;

  /// Takes the next triangles as text, about `size` characters without waiting for them. `batch` is emptied,
  /// and gets what else is to be known of them. False if what comes next is no such text. Between the first
  /// part taken and pass(), parts and nothing else may be taken.
  virtual bool take_part(std::size_t size, TrianglePart& part, TriangleBatch& batch) = 0;
  /// Undoes the last take_part() that was not undone.
  virtual void put_back(const TrianglePart& part) = 0;
  /// Where the triangles are of which the first part was or would be taken.
  [[nodiscard]] virtual TrianglePlace place() const = 0;
  /// Goes on at `place`, up to where the parts that were not put back go.
  virtual void pass(const TrianglePlace& place) = 0;

 protected:
  TriangleSource() = default;
  TriangleSource(const TriangleSource&) = default;
  TriangleSource& operator=(const TriangleSource&) = default;
};

}  // namespace pipeline
