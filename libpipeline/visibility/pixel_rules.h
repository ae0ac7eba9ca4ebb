#pragma once

#include <variant>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/coverage/type_list.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/depth_format.h"

namespace pipeline {

/// Which pixels a triangle covers, how its depths are stored, and which of them are kept.
struct PixelRules {
  CoverageRules::Choice coverage;
  DepthFormats::Choice depth;
  /// Where a triangle is visible, a fragment wins only if it is nearer by more than this, at least 0.
  double depth_epsilon = 0;
};

/// A coverage rule that is chosen at run time, for code that is not worth compiling for each.
class AnyCoverage {
 public:
  AnyCoverage(const PixelRules& chosen, const Viewport& screen)
      : rule_(CoverageRules::made(chosen.coverage, screen)) {}

  /// Calls visit(rule) with the rule in use.
  template <typename Visitor>
  decltype(auto) visit(Visitor&& visitor) const {
    return std::visit(visitor, rule_);
  }

 private:
  CoverageRules::Object rule_;
};

/// A depth format that is chosen at run time, likewise. Stored depths are doubles, which hold those of every
/// format. Its functions are inlined, as they are called for each fragment.
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
