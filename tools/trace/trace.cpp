// trace: finds by rays what each pixel shows. View space in, depths and image out, instead of project and
// zbuf.

#include <unistd.h>

#include <csignal>

#include "libpipeline/picture/image_file.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/trace/rendering.h"
#include "tools/trace/trace_options.h"
#include "tools/zbuf/screen.h"

using namespace pipeline;

// NOLINTNEXTLINE(bugprone-exception-escape): thrown only if memory is out before anything is done
int trace_main(int argc, char** argv) {
  Tool tool(
      {"trace",
       "Traces rays to triangles and spheres in view space: writes the picture, and the depth of every "
       "pixel that shows one. Depths are as from project --digits exact and zbuf --coverage center.",
       "The output of view (or stage2.txt)",
       {"model scene.txt | view | trace config.txt -o picture.ppm > z_buffer.txt",
        "trace --size 400x300 --scene scene.txt stage2.txt"},
       "--depth-image --depth-array --triangle-array --threshold --threads --min-contribution --max-depth "
       "--expect-framed"},
      OutputKind::other_text);
  TraceOptions chosen(tool.options());
  Statistics statistics(tool.options());
  // A closed pipe is a failure to write like any other: the unfinished image must be removed.
  std::signal(SIGPIPE, SIG_IGN);

  return tool.run(argc, argv, [&] {
    chosen.complete(tool.options(), ::isatty(STDOUT_FILENO) == 1);
    note_depths_in_image(tool, chosen);
    const NamedFile config = config_of(tool, chosen);
    tool.expect_separate(outputs_of(chosen, {}, statistics), {config, chosen.projection.scene()});
    const Viewport screen = read_screen(tool, chosen, config);
    if (chosen.has_image()) check_image_size(chosen.image_path, screen.columns, screen.rows);
    trace(tool, chosen, screen, statistics);
  });
}
