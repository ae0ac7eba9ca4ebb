#include "tools/separate_outputs.h"

#include <cstddef>
#include <optional>

#include "libpipeline/text/error.h"
#include "libpipeline/text/output_file.h"
#include "tools/command_line.h"

namespace pipeline {
namespace {

std::string described(const NamedOutput& output) {
  return output.option.empty() ? "standard output" : output.option + " " + pipeline::quoted(output.path);
}

}  // namespace

NamedOutput standard_output() {
  return {"", "/dev/stdout"};
}

void expect_separate(const std::vector<NamedOutput>& outputs) {
  std::vector<std::optional<OutputPlace>> places;
  for (const NamedOutput& output : outputs) {
    const auto place = output.path.empty() ? std::nullopt : place_of_output(output.path);
    for (std::size_t i = 0; place && i < places.size(); ++i)
      if (places[i] == place)
        throw UsageError(
            expected_but_found("a place of its own for every output",
                               "the same one for " + described(outputs[i]) + " and " + described(output)));
    places.push_back(place);
  }
}

}  // namespace pipeline
