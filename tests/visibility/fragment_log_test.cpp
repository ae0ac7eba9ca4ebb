#include "libpipeline/visibility/fragment_log.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/visibility/depth_format.h"

namespace pipeline {
namespace {

constexpr Viewport kFewPixels = {4, 4, -1, -1, 0, 2};
constexpr Pixel kPixel = {1, 2};
constexpr PixelRules kByCenters = {TypeValue<CenterCoverage>(), {}, 0};

/// A triangle of constant depth that covers the whole screen.
Triangle wall(double z) {
  return {{{-9, -9, z}, {9, -9, z}, {0, 9, z}}};
}

template <typename Depth = DepthF64>
std::vector<Fragment> judged(const std::vector<double>& depths) {
  const FragmentTest test({{}, TypeValue<Depth>(), 0}, kFewPixels);
  auto seen = test.nothing();
  std::vector<Fragment> fragments;
  for (const double z : depths) fragments.push_back(test.judge(seen, kPixel, 10 + fragments.size(), z));
  return fragments;
}

TEST(FragmentTest, WithAnEpsilonAFragmentHasToBeNearerByMore) {
  const FragmentTest test({{}, {}, 0.25}, kFewPixels);
  auto seen = test.nothing();
  EXPECT_EQ(test.judge(seen, kPixel, 0, 1.875).result,
            DepthTestResult::kept);  // the rear limit is not a triangle
  EXPECT_EQ(test.judge(seen, kPixel, 1, 1.625), (Fragment{kPixel, 1, 1.625, DepthTestResult::too_close, 0}));
  EXPECT_EQ(test.judge(seen, kPixel, 2, 1.5).result, DepthTestResult::kept);
}

TEST(FragmentTest, InfiniteDepthsLieOutsideTheLimits) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(judged({-kInfinity}).back().result, DepthTestResult::before_front);
  EXPECT_EQ(judged<DepthU24>({kInfinity}).back().result, DepthTestResult::beyond_rear);
}

TEST(FragmentLog, TellsOfEveryPixelFromTheTopLeft) {
  FragmentLog log(kByCenters, Viewport{2, 2, -1, -1, 0, 2});
  std::vector<Pixel> locations;
  log.add({wall(1)}, 0, [&](const Fragment& fragment) { locations.push_back(fragment.pixel); });
  EXPECT_EQ(locations, (std::vector<Pixel>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
}

TEST(FragmentLog, PixelsDoNotKnowOfEachOther) {
  FragmentLog log(kByCenters, Viewport{2, 1, -1, -1, 0, 2});
  const Triangle on_the_left = {{{-9, -9, 0.5}, {0, -9, 0.5}, {0, 99, 0.5}}};
  std::vector<DepthTestResult> results;
  const auto visit = [&](const Fragment& fragment) { results.push_back(fragment.result); };
  log.add({on_the_left}, 0, visit);
  log.add({wall(1)}, 1, visit);
  EXPECT_EQ(results, (std::vector<DepthTestResult>{DepthTestResult::kept, DepthTestResult::behind,
                                                   DepthTestResult::kept}));
}

TEST(FragmentLog, OfOnePixelTellsOfItAlone) {
  FragmentLog probe({}, kFewPixels, kPixel);
  std::vector<Fragment> fragments;
  const auto visit = [&](const Fragment& fragment) { fragments.push_back(fragment); };
  const Triangle above = {{{-1, 1, 0.5}, {1, 1, 0.5}, {0, 0.5, 0.5}}};
  const Triangle right = {{{0.5, -1, 0.5}, {1, -1, 0.5}, {0.5, 1, 0.5}}};
  probe.add({above}, 0, visit);
  probe.add({right}, 1, visit);
  probe.add({wall(1)}, 2, visit);
  EXPECT_EQ(fragments, (std::vector<Fragment>{{kPixel, 2, 1, DepthTestResult::kept, 0}}));
}

TEST(FragmentText, NamesPixelTriangleDepthAndReason) {
  EXPECT_EQ(to_text(Fragment{{3, 5}, 7, 0.25, DepthTestResult::kept, 0}),
            "3,5: triangle 7, depth 0.25: kept");
  EXPECT_EQ(to_text(Fragment{{3, 5}, 7, 0.1, DepthTestResult::behind, 2}),
            "3,5: triangle 7, depth 0.1: lost, behind triangle 2");
  EXPECT_EQ(to_text(Fragment{{3, 5}, 7, -0.0, DepthTestResult::equal, 2}),
            "3,5: triangle 7, depth 0: lost, equal and later than triangle 2");
  EXPECT_EQ(to_text(Fragment{{3, 5}, 7, -2, DepthTestResult::before_front, 0}),
            "3,5: triangle 7, depth -2: lost, before the front limit");
  EXPECT_EQ(to_text(Fragment{{3, 5}, 7, 1, DepthTestResult::beyond_rear, 0}),
            "3,5: triangle 7, depth 1: lost, beyond the rear limit");
}

}  // namespace
}  // namespace pipeline
