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

/// A picture of visible triangles, drawn batch by batch. The visibility algorithm, the coverage rule and the
/// depth format are chosen at run time.
class Drawing {
 public:
  virtual ~Drawing() = default;

  /// The place for the next batch and its tags.
  virtual TaggedBatch& next() = 0;
  /// Draws this batch, at the latest in finish().
  virtual void draw_next() = 0;
  /// Draws the batches still waiting.
  virtual void finish() = 0;

  /// Calls `visit` with the tags, which it may change, of every row with something drawn; for no row if
  /// triangles are kept until their rows are visited.
  virtual void for_each_drawn_row(const std::function<void(std::span<PixelTag>)>& visit) = 0;
  /// Calls `visit(VisibleRow)` for every row of the screen's drawn_rows(), empty ones, too, from the top.
  virtual void for_each_row(const std::function<void(const VisibleRow&)>& visit) const = 0;
};

/// Makes a drawing. A pixel without a triangle has the tag `background`. The pool may do other work, too.
std::unique_ptr<Drawing> drawing(Algorithm algorithm, const PixelRules& rules, const Viewport& screen,
                                 PixelTag background, ThreadPool& pool);

}  // namespace pipeline
