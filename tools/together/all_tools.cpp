// One program for all tools: under the name model, it is model. In a web page or an archive, separate tools
// would repeat code.

#include <algorithm>
#include <cstdio>
#include <string>

#include "tools/rim/tool.h"

// CMakeLists.txt defines ALL_TOOLS, an ENTRY for each tool that is built.
#define ENTRY(tool) int tool##_main(int argc, char** argv);
ALL_TOOLS
#undef ENTRY

namespace {

struct Entry {
  const char* name;
  int (*run)(int argc, char** argv);
};

#define ENTRY(tool) Entry{#tool, tool##_main},
constexpr Entry kEntries[] = {ALL_TOOLS};
#undef ENTRY

/// A tool's name as in its source: join_seen for /usr/bin/join-seen.
std::string name_of(const char* path) {
  std::string name = path;
  name.erase(0, name.find_last_of('/') + 1);  // npos + 1 is 0
  std::ranges::replace(name, '-', '_');
  return name;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = name_of(argc > 0 ? argv[0] : "");
  for (const Entry& entry : kEntries)
    if (entry.name == name) return entry.run(argc, argv);
  std::fputs("all-tools: expected to be called by the name of a tool, model for example\n", stderr);
  return pipeline::kExitMisuse;
}
