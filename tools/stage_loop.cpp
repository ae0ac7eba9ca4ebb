#include "tools/stage_loop.h"

namespace pipeline {

void StageLoop::write(const TriangleBatch& batch) {
  writer_.write(batch);
  tool_.output().flush();
  tool_.timing().lap(&Timing::write_seconds);
}

/// Completes the text, and notes on stderr where its digits are uncertain or too few.
void StageLoop::finish() {
  writer_.finish();
  if (const LineAndColumn uncertain = rounder_.first_uncertain(); uncertain.is_known())
    tool_.note(to_string(rounder_.location_of(uncertain)) +
               ": numbers cancel here beyond 31 digits; the last digits of this vertex are not certain");
  if (!writer_.keeps_four_digits())
    tool_.note("the largest coordinate keeps fewer than 4 significant digits; use --digits exact");
}

}  // namespace pipeline
