// zbuf: decides which triangle is seen at each pixel. Normalized device coordinates in, depths and image out.

#include <csignal>
#include <string>
#include <vector>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/scene/config.h"
#include "tools/render.h"
#include "tools/separate_outputs.h"
#include "tools/tool.h"
#include "tools/zbuf_options.h"

using namespace pipeline;

namespace {

Viewport read_screen(const Tool& tool, const std::string& path) {
  InputFile file = tool.second_input(path, "CONFIG");
  return read_config(file.text());
}

std::vector<NamedOutput> outputs_of(const ZbufOptions& chosen) {
  const bool is_filter = chosen.z_buffer_path == "-";
  return {{"--image", chosen.image_path},
          is_filter ? standard_output() : NamedOutput{"--z-buffer", chosen.z_buffer_path},
          {"--depth-image", chosen.depth_image_path},
          {"--fragments", chosen.fragments_path}};
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"zbuf",
             "Reads triangles in normalized device coordinates and writes the depth of every pixel that "
             "shows one, and the image.",
             "The output of project (or stage3.txt)"},
            OutputKind::other_text);
  ZbufOptions chosen;
  chosen.add_to(tool.options());
  // A closed pipe is a failure to write like any other: the image that was begun has to be removed.
  std::signal(SIGPIPE, SIG_IGN);

  return tool.run(argc, argv, [&] {
    chosen.check();
    expect_separate(outputs_of(chosen));
    const Viewport screen = read_screen(tool, chosen.config_path);
    chosen.check_limits(screen);
    check_image_size(chosen.image_path, screen.columns, screen.rows);
    render(tool, chosen, screen);
  });
}
