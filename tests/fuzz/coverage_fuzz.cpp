// The coverage rule `center` and its depths against rational arithmetic. The input is a line of config, its
// limits, and a stage text.

#include <algorithm>
#include <map>

#include "libpipeline/scene/config.h"
#include "libpipeline/stream/stage_reader.h"
#include "tests/coverage/center_rational.h"
#include "tests/coverage/center_reference.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/require.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

constexpr int kMaxPixels = 200;
constexpr std::size_t kMaxTriangles = 4;

void check_triangle(const TextTriangle& triangle, const Viewport& screen) {
  const ExactCoverage exact(triangle, screen);
  std::map<int, Span> spans;
  for (const Span& span : spans_of(CenterRows(ExactGrid(screen), triangle.exact()))) spans[span.row] = span;
  const mpq_class largest = exact.largest_depth();
  for (int row = 0; row < screen.rows; ++row) {
    const auto found = spans.find(row);
    for (int column = 0; column < screen.columns; ++column) {
      const bool is_covered =
          found != spans.end() && column >= found->second.first_column && column <= found->second.last_column;
      require(is_covered == exact.covers(row, column), "a pixel is covered as exact arithmetic says");
      // Below this size TriangleDepth makes no promises.
      if (!is_covered || largest < mpq_class(1e-288)) continue;
      const double depth = found->second.depth(column);
      require(std::isfinite(depth), "a depth is finite");
      require(abs(mpq_class(depth) - exact.depth(row, column)) <= largest * mpq_class(0x1p-50),
              "a depth is within 2^-50 of the largest of its triangle");
    }
  }
}

void check_texts(std::string_view config_text, std::string_view stage_text) {
  const TextFile config_file(config_text), stage_file(stage_text);
  TextReader config(config_file.descriptor(), "config"), text(stage_file.descriptor(), "in");
  const Viewport screen = read_config(config);
  if (screen.columns > kMaxPixels || screen.columns * screen.rows > kMaxPixels) return;
  StageReader reader(text, true);
  TriangleBatch batch;
  if (!reader.read(batch)) return;
  for (std::size_t i = 0; i < std::min(batch.size(), kMaxTriangles); ++i) {
    TextTriangle triangle = {batch.triangles[i]};
    if (!batch.low_parts.empty()) triangle.low_parts = batch.low_parts[i];
    triangle.decimal_marks = batch.decimal_marks[i];
    check_triangle(triangle, screen);
  }
}

}  // namespace

void check(FuzzBytes bytes) {
  const std::string_view text = bytes.rest();
  const std::size_t blank_line = std::min(text.find("\n\n"), text.size());
  try {
    check_texts(text.substr(0, blank_line), text.substr(std::min(blank_line + 2, text.size())));
  } catch (const InputError&) {
    // Other targets check text that is no config or no stage text.
  }
}

}  // namespace pipeline
