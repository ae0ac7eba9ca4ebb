#include "tools/trace/trace_options.h"

#include <algorithm>
#include <thread>

namespace pipeline {
namespace {

constexpr int kMaxThreads = 256;

}  // namespace

TraceOptions::TraceOptions(CommandLine& options) {
  picture.coverage = TypeValue<CenterCoverage>();
  picture.thread_count = 0;
  options.set_usage(
      "Usage: trace [OPTIONS] CONFIG [INPUT]\n"
      "       trace [OPTIONS] --size WIDTHxHEIGHT [INPUT]");
  picture.add_screen_and_outputs(options, false);
  projection.emplace(options);
  options.begin_group("Pixels");
  picture.add_samples(options);
  options.add_whole("--threads", picture.thread_count, 0, kMaxThreads,
                    "How many threads trace rays, 0 for one on every core");
  options.begin_group("Color and light");
  picture.add_shading(options);
  picture.add_background(options);
  options.begin_group("Debugging");
  picture.add_framed(options);
}

int TraceOptions::thread_count() const {
  if (picture.thread_count > 0) return picture.thread_count;
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxThreads);
}

}  // namespace pipeline
