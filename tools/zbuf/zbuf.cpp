// zbuf: finds the visible triangle at each pixel. Normalized device coordinates in, depths and image out.

#include <unistd.h>

#include <csignal>

#include "libpipeline/picture/image_file.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/zbuf/render.h"
#include "tools/zbuf/screen.h"
#include "tools/zbuf/zbuf_options.h"

using namespace pipeline;

// NOLINTNEXTLINE(bugprone-exception-escape): thrown only if memory is out before anything is done
int zbuf_main(int argc, char** argv) {
  Tool tool({"zbuf",
             "Draws triangles in normalized device coordinates: writes the picture, and the depth of every "
             "pixel that shows a triangle.",
             "The output of project (or stage3.txt)",
             {"model scene.txt | view | project | zbuf config.txt -o out.bmp > z_buffer.txt",
              "zbuf --size 400x300 --coverage center --samples 4 stage3.txt"},
             "--depth-image --depth-array --triangle-array --rows --seen --certify --algorithm --depth "
             "--depth-epsilon --threads --fragments --expect-framed"},
            OutputKind::other_text);
  ZbufOptions chosen(tool.options());
  Statistics statistics(tool.options());
  // A closed pipe is a failure to write like any other: the unfinished image must be removed.
  std::signal(SIGPIPE, SIG_IGN);

  return tool.run(argc, argv, [&] {
    chosen.complete(::isatty(STDOUT_FILENO) == 1);
    if (chosen.seen_path == "-") tool.write_stage_text();
    note_depths_in_image(tool, chosen);
    const NamedFile config = config_of(tool, chosen);
    tool.expect_separate(chosen.outputs(statistics), {config});
    const Viewport whole = read_screen(tool, chosen, config);
    const Viewport screen = chosen.rows.empty() ? whole : chosen.drawn_part(whole);
    chosen.check_limits(screen);
    if (chosen.has_image()) check_image_size(chosen.image_path, screen.columns, screen.drawn_row_count());
    render(tool, chosen, screen, statistics);
  });
}
