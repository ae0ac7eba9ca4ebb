#include "libpipeline/text/fixed_depths.h"

#include "libpipeline/text/fixed_number.h"

namespace pipeline {

FixedDepths write_fixed_depths(std::span<const double> depths, double rear, char* out) {
  FixedDepths written = {0, out};
  for (const double depth : depths) {
    if (depth < rear) {
      char* const end = write_fixed<6>(written.end, depth);
      if (end == nullptr) break;
      *end = '\t';
      written.end = end + 1;
    }
    ++written.count;
  }
  return written;
}

}  // namespace pipeline
