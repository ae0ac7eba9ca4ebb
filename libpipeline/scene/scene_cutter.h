#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libpipeline/text/text_reader.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

struct SceneCommand;

/// Cuts a scene into parts that are scenes themselves and hold its triangles one after the other. ("Triangle"
/// includes spheres here.) A part consists of the camera and the settings; the transforms, the color and the
/// material in force; and then the scene's own commands without comments. The parts apply the same transforms
/// in the same order, so `model` of all parts is `model` of the scene to the last bit. Reads keywords and
/// lines, but no numbers: `model` checks numbers. Errors are InputErrors.
class SceneCutter {
 public:
  /// Reads as far as the first triangle.
  explicit SceneCutter(TextReader& text);

  /// True if a triangle comes next; otherwise the scene is read to its end.
  [[nodiscard]] bool has_triangle() const { return has_triangle_; }
  /// The number of the next triangle.
  [[nodiscard]] std::uint64_t next_number() const { return next_number_; }
  /// The number of the scene's bytes that are used so far.
  [[nodiscard]] std::size_t position() const { return text_.bytes_read() - text_.buffered().size(); }
  /// Writes the beginning of a part whose first triangle is the next one.
  void begin(TextWriter& part) const;
  /// Copies the commands from the next triangle on, up to the first triangle at or after `end`, in bytes
  /// from the scene's beginning.
  void copy(TextWriter& part, std::size_t end);

 private:
  /// A number of pushes, and the commands after them: a repeated push takes no memory.
  struct Commands {
    std::uint64_t push_count = 0;
    std::string text{};
    std::size_t in_preamble = 0;  // the length of the preamble's share of `text`
  };
  static void add_push(std::vector<Commands>& commands);

  void find_triangle(TextWriter* part);
  void carry_out(TextWriter* part);
  void pop(const LineScanner& at_pop);
  const SceneCommand& expect_allowed(const LineScanner& at_keyword) const;
  void copy_triangle(TextWriter& part);
  void copy_buffered(TextWriter& part, std::size_t end);

  TextReader& text_;
  LineScanner line_;
  bool line_is_pending_ = false;  // line_ belongs to a triangle that is not copied yet
  bool has_triangle_ = false;
  bool is_in_preamble_ = true;
  bool has_color_ = false;
  std::uint64_t next_number_ = 0;
  std::vector<Commands> preamble_ = std::vector<Commands>(1);  // the scene up to its first triangle
  std::vector<Commands> levels_ = std::vector<Commands>(1);    // the pushes and transforms in force
  std::uint64_t depth_ = 0;                                    // the sum of the pushes
  std::uint64_t depth_of_preamble_ = 0;                        // at its end
  std::uint64_t depth_kept_ = 0;                               // the least since then
  std::string color_;                                          // the last one after the preamble
  std::string material_;                                       // the last `use` there
};

}  // namespace pipeline
