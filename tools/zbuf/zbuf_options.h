#pragma once

#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/coverage/type_list.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/depth_format.h"
#include "tools/zbuf/picture_options.h"

namespace pipeline {

enum class Algorithm { zbuffer, scanline };

/// Which pixels a triangle covers, and which of its depths are kept.
struct PixelRules {
  TypeChoice<CoverageRules> coverage;
  TypeChoice<DepthFormats> depth;
  double depth_epsilon = 0;
};

/// The options of `zbuf`, as members with their defaults.
struct ZbufOptions : PictureOptions {
  /// `words` are those of the command line.
  ZbufOptions(CommandLine& options, std::span<char* const> words);

  PixelRules rules;
  Algorithm algorithm = Algorithm::zbuffer;
  std::string seen_path;       // "-": standard output; empty: no file
  std::string certainty_path;  // likewise
  std::string rows;            // "A:B", if the option is given
  bool wireframe = false;
  bool has_all_edges = false;  // the wireframe, hidden ones too
  std::string fragments_path;  // empty: no file

  /// Chooses the options that depend on others, and on whether standard output is a terminal. A UsageError if
  /// options exclude each other.
  void complete(bool is_terminal);
  /// The screen with the rows that are to be drawn. A UsageError if it does not have them.
  [[nodiscard]] Viewport drawn_part(Viewport screen) const;
  /// A UsageError if the depth format cannot store the depths between the limits of Z.
  void check_limits(const Viewport& screen) const;
  /// The files and pipes of a run.
  [[nodiscard]] std::vector<NamedFile> outputs(const Statistics& statistics) const;

 private:
  void add_pixels(CommandLine& options);
};

/// Calls visit<Rule, Depth>() for the coverage rule and the depth format chosen.
template <typename Visitor>
decltype(auto) dispatch(const PixelRules& chosen, Visitor&& visit) {
  return std::visit(
      [&]<typename Rule, typename Depth>(TypeValue<Rule>, TypeValue<Depth>) -> decltype(auto) {
        return visit.template operator()<Rule, Depth>();
      },
      chosen.coverage, chosen.depth);
}

template <typename Interface, template <typename, typename> typename Of, typename Rule, typename Depth,
          typename... Arguments>
std::unique_ptr<Interface> made(const Arguments&... arguments) {
  return std::make_unique<Of<Rule, Depth>>(arguments...);
}
/// The Of<Rule, Depth> for the coverage rule and the depth format chosen: made in a function of its own, as
/// clang 14 loses members of a class that is first named in a visitor.
template <typename Interface, template <typename, typename> typename Of, typename... Arguments>
std::unique_ptr<Interface> made_for(const PixelRules& chosen, const Arguments&... arguments) {
  return dispatch(chosen, [&]<typename Rule, typename Depth>() {
    return made<Interface, Of, Rule, Depth>(arguments...);
  });
}

}  // namespace pipeline
