#pragma once

#include <variant>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/coverage/type_list.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/depth_format.h"

namespace pipeline {

/// The rules for the pixels that a triangle covers, and for storing and comparing depths.
struct PixelRules {
  CoverageRules::Choice coverage;
  DepthFormats::Choice depth;
  /// At least 0; a fragment wins over a visible triangle only if it is nearer by more than this.
  double depth_epsilon = 0;
};

/// A depth format chosen at run time. Stored depths are doubles, which hold every format's values. Functions
/// called for each fragment are inlined.
class AnyDepth {
 public:
  AnyDepth(const PixelRules& chosen, const Viewport& screen)
      : format_(DepthFormats::made(chosen.depth, screen)) {}

  [[nodiscard, gnu::always_inline]] double store(double z) const {
    return std::visit([z](const auto& format) { return static_cast<double>(format.store(z)); }, format_);
  }
  [[nodiscard, gnu::always_inline]] double depth(double stored) const {
    return std::visit(
        [stored]<typename Depth>(const Depth& format) {
          return static_cast<double>(format.depth(static_cast<typename Depth::Stored>(stored)));
        },
        format_);
  }
  [[nodiscard]] double separation(double size) const {
    return std::visit([size](const auto& format) { return format.separation(size); }, format_);
  }

 private:
  DepthFormats::Object format_;
};

}  // namespace pipeline
