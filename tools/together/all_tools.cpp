// One program for five tools: called model, it is model. For where five programs are five times the same
// code: a page.

#include <array>
#include <cstdio>
#include <string_view>

#include "tools/rim/exit_status.h"

// The mains of the tools, renamed (CMakeLists.txt).
int model_entry(int argc, char** argv);
int view_entry(int argc, char** argv);
int project_entry(int argc, char** argv);
int zbuf_entry(int argc, char** argv);
int trace_entry(int argc, char** argv);

namespace {

struct Entry {
  std::string_view name;
  int (*run)(int argc, char** argv);
};

constexpr std::array<Entry, 5> kEntries = {{{"model", model_entry},
                                            {"view", view_entry},
                                            {"project", project_entry},
                                            {"zbuf", zbuf_entry},
                                            {"trace", trace_entry}}};

}  // namespace

int main(int argc, char** argv) {
  std::string_view name = argc > 0 ? argv[0] : "";
  name.remove_prefix(name.find_last_of('/') + 1);  // npos + 1 is 0
  for (const Entry& entry : kEntries)
    if (entry.name == name) return entry.run(argc, argv);
  std::fputs("all-tools: expected to be called model, view, project, zbuf or trace\n", stderr);
  return pipeline::kExitMisuse;
}
