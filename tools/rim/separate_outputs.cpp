#include "tools/rim/separate_outputs.h"

#include <utility>

#include "libpipeline/text/error.h"
#include "libpipeline/text/output_file.h"
#include "tools/rim/command_line.h"

namespace pipeline {
namespace {

bool is_stream(const NamedFile& file) {
  return file.name.starts_with("standard ");
}

std::string described(const NamedFile& file) {
  return is_stream(file) ? file.name : file.name + " " + pipeline::quoted(file.path);
}

/// True if two files may share one place: streams that the shell has joined, or an input and its replacement.
bool may_share(const NamedFile& earlier, const NamedFile& output) {
  if (is_stream(earlier) && output.name == kStandardError.name) return earlier.name != kStandardInput.name;
  return earlier.is_in_place && output.is_in_place && is_replaced(output.path);
}

}  // namespace

void expect_separate(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  std::vector<std::pair<const NamedFile*, FilePlace>> taken;
  for (const NamedFile& input : inputs)
    if (const auto place = place_of(input.path)) taken.emplace_back(&input, *place);
  for (const NamedFile& output : outputs) {
    const auto place = place_of(output.path);
    if (!place) continue;
    for (const auto& [earlier, its_place] : taken)
      if (its_place == *place && !may_share(*earlier, output))
        throw UsageError(
            expected_but_found("a place of its own for every output",
                               "the same one for " + described(*earlier) + " and " + described(output)));
    taken.emplace_back(&output, *place);
  }
}

}  // namespace pipeline
