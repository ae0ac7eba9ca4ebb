#include "tools/stages/stage_loop.h"

#include <cstdint>
#include <string>

namespace pipeline {

void StageLoop::write(const TriangleBatch& batch) {
  writer_.write(batch);
  if (statistics_.is_wanted()) extent_.add(batch);
  tool_.output().flush();
  tool_.timing().lap(&Timing::write_seconds);
}

/// Completes the text, and notes uncertain digits.
void StageLoop::finish(const UncertainDigits& uncertain_lights) {
  writer_.finish();
  statistics_.add("triangles", tool_.timing().triangle_count);
  note_uncertain("light", uncertain_lights);
  note_uncertain("vertex", rounder_.uncertain());
}

void StageLoop::note_if_no_triangle_came() const {
  if (tool_.timing().triangle_count == 0 && Tool::is_last_stage()) tool_.note("no triangle came");
}

void StageLoop::write_statistics(NumberFormat format) {
  if (!statistics_.is_wanted()) return;
  statistics_.add(extent_, format);
  tool_.close_output();
  statistics_.finish();
  statistics_.commit();
}

void StageLoop::note_uncertain(const char* one_of_them, const UncertainDigits& uncertain) const {
  if (uncertain.count == 0) return;
  const std::uint64_t others = uncertain.count - 1;
  const std::string and_others = others == 0 ? "" : " and of " + std::to_string(others) + " more";
  tool_.note(to_string(rounder_.location_of(uncertain.first)) + ": the digits of this " + one_of_them +
             and_others + " are not certain: numbers cancel here beyond 31 digits");
}

}  // namespace pipeline
