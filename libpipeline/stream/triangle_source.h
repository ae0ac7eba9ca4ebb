#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// A place between the triangles of a text.
struct StreamPosition {
  std::size_t line_count = 0;  // before it
  std::uint64_t number = 0;    // the next triangle's
};

/// Text of whole triangles, and perhaps more.
struct TrianglePart {
  TextPart text;
  std::uint64_t turn = 0;  // see TriangleParts
};

/// What was found in a part.
struct PartContents {
  bool is_whole = false;          // nothing but triangles, and all of them read
  std::uint64_t next_number = 0;  // behind the last
  /// The first triangle of the batch that has its number from one in the text, if such a number stands there.
  /// Those before it are counted from the part's beginning.
  std::optional<std::size_t> first_numbered = {};
};

/// Where a stage's triangles come from: batch by batch, or in parts that other threads read.
class TriangleSource {
 public:
  virtual ~TriangleSource() = default;

  /// Fills `batch` with the next triangles, as many as are waiting but at least one; false (and an empty
  /// batch) at the end. Triangles before a mistake are given out before the mistake is thrown.
  virtual bool read(TriangleBatch& batch) = 0;

  /// Takes the next triangles as text, about `size` characters without waiting for them. `batch` is emptied,
  /// and gets what else is to be known of them. False if no such text comes next, or none is in memory.
  /// Between the first part taken and pass(), parts and nothing else may be taken.
  virtual bool take_part(std::size_t size, TextPart& part, TriangleBatch& batch) = 0;
  /// Reads the triangles of a part into the batch it was taken with. What else there is, mistakes included,
  /// is left for read(). For any thread.
  virtual PartContents read_part(TextReader& part, TriangleBatch& batch) const = 0;
  /// Undoes the last take_part() that was not undone.
  virtual void put_back(const TextPart& part) = 0;
  /// Where the triangles are of which the first part was or would be taken.
  [[nodiscard]] virtual StreamPosition location() const = 0;
  /// Goes on at `place`, up to where the parts that were not put back go.
  virtual void pass(const StreamPosition& location) = 0;

 protected:
  TriangleSource() = default;
  TriangleSource(const TriangleSource&) = default;
  TriangleSource& operator=(const TriangleSource&) = default;
};

}  // namespace pipeline
