#pragma once

#include <functional>
#include <memory>
#include <span>

#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/visibility/pixel_rules.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {

enum class Algorithm { zbuffer, scanline };

/// A picture of visible triangles that is drawn batch by batch, by a visibility algorithm, a coverage rule
/// and a depth format that are chosen at run time.
class Drawing {
 public:
  virtual ~Drawing() = default;

  /// Where to put the next batch and its tags.
  virtual TaggedBatch& next() = 0;
  /// Draws that batch now or later, at the latest in finish().
  virtual void draw_next() = 0;
  /// Draws the batches still waiting.
  virtual void finish() = 0;

  /// Calls `visit` with the tags, which it may change, of every row in which something has been drawn; none
  /// if triangles are kept until their rows are visited.
  virtual void for_each_drawn_row(const std::function<void(std::span<PixelTag>)>& visit) = 0;
  /// Calls `visit(VisibleRow)` for every row that is drawn, from the top.
  virtual void for_each_row(const std::function<void(const VisibleRow&)>& visit) const = 0;
};

/// A pixel without a triangle has the tag `background`. The pool may do other work, too.
std::unique_ptr<Drawing> drawing(Algorithm algorithm, const PixelRules& rules, const Viewport& screen,
                                 PixelTag background, ThreadPool& pool);

}  // namespace pipeline
