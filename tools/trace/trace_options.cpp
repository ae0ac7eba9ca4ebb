#include "tools/trace/trace_options.h"

#include <array>
#include <string>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

constexpr int kSamplesOfSampling = 5;

constexpr std::array kSamplings = {"basic", "regular", "jittered", "adaptive"};  // by Sampling
constexpr int kMaxDepth = 1000;  // a thread's stack has room for this

}  // namespace

TraceOptions::TraceOptions(CommandLine& options)
    : PictureOptions(options, "trace", false), projection(options) {
  add_pixels(options);
  add_color_and_light(options);
  options.begin_group("Debugging");
  options.add_repeatable(
      "--probe", "COLUMN,ROW", probes,
      "List the rays that make this pixel's color on stderr: path, weight and color; repeatable");
  add_framed(options);
}

void TraceOptions::add_pixels(CommandLine& options) {
  options.begin_group("Pixels");
  options.add_choice<std::optional<Sampling>>(
      "--sampling", sampling,
      {{kSamplings[0], Sampling::basic},
       {kSamplings[1], Sampling::regular},
       {kSamplings[2], Sampling::jittered},
       {kSamplings[3], Sampling::adaptive}},
      "Where the rays of a pixel go.\n"
      "basic: one through its center\n"
      "regular: through the centers of N x N cells, as in zbuf\n"
      "jittered: through a random point of each cell, the same in every run\n"
      "adaptive: jittered, but only the five cells in the corners and the middle where these look alike\n"
      "(default: regular)");
  options.add_whole("--samples", sample_count, 1, kMaxSamples,
                    "Smooth edges: a pixel is the mean of N x N samples; by default " +
                        std::to_string(kSamplesOfSampling) + " with any --sampling but basic");
  options.add_whole("--threshold", threshold, 0, 255,
                    "With --sampling adaptive: take all samples where a channel of the first five differs by "
                    "at least N levels");
  options.add_whole("--threads", thread_count, 0, kMaxThreads,
                    "How many threads trace rays (0: all that help)");
}

void TraceOptions::add_color_and_light(CommandLine& options) {
  options.begin_group("Color and light");
  add_shading(options);
  add_background(options);
  options.add_flag("--no-shadows", without_shadows, "Light every surface that faces a light, as zbuf does");
  options.add_flag("--no-recursion", without_recursion,
                   "Draw mirrors and glass matte and opaque, as zbuf does");
  options.add_number(
      "--min-contribution", "E", min_contribution, [](double part) { return part >= 0 && part <= 1; },
      "a number from 0 to 1", "Cut rays that can bring less than this part of a pixel's color");
  options.add_whole("--max-depth", max_depth, 0, kMaxDepth, "How often a ray may be mirrored or refracted");
}

void TraceOptions::complete(const CommandLine& options, bool is_terminal) {
  PictureOptions::complete(is_terminal, false);
  if (!options.is_given("--samples") && sampling && *sampling != Sampling::basic)
    sample_count = kSamplesOfSampling;
  if (sampling == Sampling::basic && sample_count > 1)
    throw UsageError("--samples", "1 with --sampling basic, which has one ray a pixel",
                     "'" + std::to_string(sample_count) + "'");
  if (options.is_given("--threshold") && sampling != Sampling::adaptive)
    throw UsageError("--threshold", "--sampling adaptive, which alone has one",
                     sampling ? kSamplings[static_cast<std::size_t>(*sampling)] : "no --sampling");
  if (!sampling) sampling = Sampling::regular;
}

}  // namespace pipeline
