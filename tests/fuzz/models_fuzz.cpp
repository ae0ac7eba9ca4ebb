// mesh2scene on any bytes as an OBJ, PLY, glTF or STL file: a scene that model reads, or one clear message
// and status 1. The first byte of the input selects the format; after a capital letter, the next bytes select
// any options that mesh2scene has. The tools run as processes, as mesh2scene opens files.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/fuzz/any_options.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/require.h"
#include "tests/text/temporary_folder.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

struct Run {
  int status = 0;  // of waitpid
  std::string output;
  std::string messages;
};

Run run(std::vector<std::string> words) {
  // A sanitizer ends a tool by a signal. What mesh2scene never frees does not matter.
  ::setenv("ASAN_OPTIONS", "abort_on_error=1:detect_leaks=0", 1);
  const TextFile out(""), messages("");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, messages.descriptor(), STDERR_FILENO);
  pid_t process = 0;
  require(::posix_spawn(&process, argv[0], &files, nullptr, argv.data(), environ) == 0, "the tool starts");
  ::posix_spawn_file_actions_destroy(&files);
  Run done;
  // libFuzzer's alarm interrupts the wait.
  while (::waitpid(process, &done.status, 0) < 0) require(errno == EINTR, "the tool can be waited for");
  done.output = out.whole_text();
  done.messages = messages.whole_text();
  return done;
}

std::size_t count_of_failures(const std::string& messages) {
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < messages.size();) {
    const std::size_t end = std::min(messages.find('\n', begin), messages.size());
    if (messages.substr(begin, end - begin).find(": note: ") == std::string::npos) ++count;
    begin = end + 1;
  }
  return count;
}

}  // namespace

void check(FuzzBytes bytes) {
  static const std::vector<Option> kOptions = options_in(run({MESH2SCENE, "--help-all"}).output);
  const int letter = bytes.byte(), first = std::tolower(letter);
  std::vector<std::string> words = {MESH2SCENE};
  if (first != letter) add_any(kOptions, words, bytes);
  const std::string suffix = first == 'o' ? "obj" : first == 'p' ? "ply" : first == 'g' ? "gltf" : "stl";
  const TemporaryFolder folder;
  folder.write("model." + suffix, std::string(bytes.rest()));
  words.push_back(folder.path("model." + suffix));
  const Run done = run(words);
  require(WIFEXITED(done.status) && WEXITSTATUS(done.status) <= (words.size() > 2 ? 2 : 1),
          "what is in a file ends no tool by a signal");
  if (count_of_failures(done.messages) > 1) std::fputs(done.messages.c_str(), stderr);
  const bool failed = WEXITSTATUS(done.status) != 0;
  require(count_of_failures(done.messages) == (failed ? 1U : 0U), "a failure is one line, success is quiet");
  if (failed) {
    require(done.output.empty(), "a failed run writes no scene");
    return;
  }
  folder.write("scene.txt", done.output);
  require(run({MODEL, folder.path("scene.txt")}).status == 0, "what mesh2scene has written is a scene");
}

}  // namespace pipeline
