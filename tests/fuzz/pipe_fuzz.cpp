// The whole pipe in one process: the four tools' own main functions, each reading the output of the previous
// one, and trace's beside the last two. The first byte of the input selects options, the rest is the scene;
// under one of them, the next bytes select any options that the tools have.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/fuzz/any_options.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/require.h"
#include "tests/text/text_input.h"

// tools/*.cpp, compiled with main renamed.
int model_main(int argc, char** argv);
int view_main(int argc, char** argv);
int project_main(int argc, char** argv);
int zbuf_main(int argc, char** argv);
int trace_main(int argc, char** argv);

namespace pipeline {
namespace {

constexpr int kBytesOfOptions = 32;

/// Makes a descriptor refer to another one's file as long as this object lives.
class Redirected {
 public:
  Redirected(int descriptor, int file)
      : descriptor_(descriptor), before_(::fcntl(descriptor, F_DUPFD_CLOEXEC, 10)) {
    ::dup2(file, descriptor);
  }
  ~Redirected() {
    if (before_ < 0)
      ::close(descriptor_);
    else
      ::dup2(before_, descriptor_);
    ::close(before_);
  }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;

 private:
  int descriptor_;
  int before_;
};

struct Run {
  int status = 0;
  std::string output;
  std::string messages;
};

Run run(int (*tool)(int, char**), std::vector<std::string> words, const std::string& input) {
  const TextFile in(input), out(""), messages("");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  Run done;
  {
    const Redirected stdin_file(STDIN_FILENO, in.descriptor());
    const Redirected stdout_file(STDOUT_FILENO, out.descriptor());
    const Redirected stderr_file(STDERR_FILENO, messages.descriptor());
    done.status = tool(static_cast<int>(words.size()), argv.data());
  }
  done.output = out.whole_text();
  done.messages = messages.whole_text();
  return done;
}

/// One line gives the reason if a run failed; a successful run prints only notes.
void check_messages(const Run& done) {
  require(done.status == 0 || done.status == 1, "what is in a scene is no misuse");
  std::size_t failures = 0;
  for (std::size_t begin = 0; begin < done.messages.size();) {
    const std::size_t end = std::min(done.messages.find('\n', begin), done.messages.size());
    if (done.messages.substr(begin, end - begin).find(": note: ") == std::string::npos) ++failures;
    begin = end + 1;
  }
  require(failures == static_cast<std::size_t>(done.status), "a failure is one line, success is quiet");
}

/// A stage text ends with an error line if the stage failed, and contains only numbers otherwise.
void check_stage_text(const Run& done) {
  const std::size_t last_line = done.output.rfind('\n', done.output.size() < 2 ? 0 : done.output.size() - 2);
  const std::string last = done.output.substr(last_line == std::string::npos ? 0 : last_line + 1);
  require(last.starts_with("error ") == (done.status != 0),
          "an error line ends the text of a failed stage alone");
  if (done.status != 0) return;
  require(done.output.find("nan") == std::string::npos, "no number is nan");
  require(done.output.find("inf") == std::string::npos, "no number is infinite");
  require(done.output.find("-0.0000000 ") == std::string::npos, "zero has no sign");
}

Run run_stage(int (*tool)(int, char**), const std::vector<std::string>& words, const Run& before) {
  Run done = run(tool, words, before.output);
  check_messages(done);
  check_stage_text(done);
  require(before.status == 0 || done.status == 1, "a failure reaches the next stage");
  return done;
}

std::pair<Run, std::string> draw(int (*tool)(int, char**), std::vector<std::string> words,
                                 const std::string& input, bool is_checked = true) {
  const TextFile config("9 7\n"), image("");
  const auto path_of = [](const TextFile& file) { return "/dev/fd/" + std::to_string(file.descriptor()); };
  words.insert(words.end(), {path_of(config), "--image", path_of(image)});
  Run done = run(tool, words, input);
  if (is_checked) check_messages(done);
  return {std::move(done), image.whole_text()};
}

void check_picture(const Run& projected, const std::string& coverage) {
  const auto [buffered, picture] = draw(zbuf_main, {"zbuf", "--coverage", coverage}, projected.output);
  require(buffered.status == projected.status, "what project has written can be drawn");
  require(buffered.status == 0 || (buffered.output.empty() && picture.empty()), "a failed run draws nothing");
  const auto [swept, swept_picture] =
      draw(zbuf_main, {"zbuf", "--coverage", coverage, "--algorithm", "scanline"}, projected.output);
  require(swept.output == buffered.output && swept_picture == picture, "both algorithms draw the same");
}

/// What rays find is what the z-buffer draws; random samples need no order. Light does what it likes, but
/// alike on all threads.
void check_rays(const Run& viewed) {
  const std::vector<std::string> plain = {"trace", "--threads", "1", "--no-shadows", "--no-recursion"};
  const auto traced = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return draw(trace_main, words, viewed.output);
  };
  const auto [rays, picture] = traced(plain, {});
  require(rays.status == 0 || (rays.output.empty() && picture.empty()), "a failed run draws nothing");
  // project refuses spheres.
  if (viewed.output.find("sphere") == std::string::npos) {
    const Run projected = run(project_main, {"project", "--digits", "exact"}, viewed.output);
    const auto [buffered, drawn] = draw(zbuf_main, {"zbuf", "--coverage", "center"}, projected.output);
    require(buffered.status == rays.status, "both draw, or none");
    require(buffered.output == rays.output && drawn == picture, "rays find what the z-buffer draws");
  }
  const std::vector<std::string> jittered = {"--samples", "2", "--sampling", "jittered"};
  const std::vector<std::string> adaptive = {"--samples", "2", "--sampling", "adaptive", "--threshold", "0"};
  require(traced(plain, jittered).second == traced(plain, adaptive).second,
          "a threshold of 0 takes all samples");
  const auto lit = traced({"trace", "--threads", "1"}, {}),
             on_threads = traced({"trace", "--threads", "3"}, {});
  require(lit.first.status == rays.status && lit.first.output == rays.output, "light changes no depth");
  require(lit.second == on_threads.second, "threads change nothing");
}

/// A tool under up to three of its options; such a command line may be a misuse.
Run run_with_any(int (*tool)(int, char**), const std::string& name, const std::string& input,
                 FuzzBytes& bytes) {
  static std::map<std::string, std::vector<Option>> known;
  if (known[name].empty()) known[name] = options_in(run(tool, {name, "--help-all"}, "").output);
  std::vector<std::string> words = {name};
  add_any(known[name], words, bytes);
  const bool draws = name == "zbuf" || name == "trace";
  Run done = draws ? draw(tool, words, input, false).first : run(tool, words, input);
  require(done.status >= 0 && done.status <= 2, "a run ends with 0, 1 or 2");
  require(done.status == 0 || !done.messages.empty(), "a failure says why");
  if (!draws && done.status != 2) check_stage_text(done);
  return done;
}

void check_any_options(FuzzBytes& bytes) {
  FuzzBytes scene = bytes;
  for (int i = 0; i < kBytesOfOptions; ++i) scene.byte();
  const Run modeled = run_with_any(model_main, "model", std::string(scene.rest()), bytes);
  const Run viewed = run_with_any(view_main, "view", modeled.output, bytes);
  run_with_any(trace_main, "trace", viewed.output, bytes);
  const Run projected = run_with_any(project_main, "project", viewed.output, bytes);
  run_with_any(zbuf_main, "zbuf", projected.output, bytes);
}

}  // namespace

void check(FuzzBytes bytes) {
  const int options = bytes.byte();
  if ((options & 64) != 0) return check_any_options(bytes);
  std::vector<std::string> digits = {"--digits", (options & 1) != 0 ? "exact" : "7"};
  const auto with_digits = [&](std::vector<std::string> words) {
    words.insert(words.end(), digits.begin(), digits.end());
    return words;
  };
  const std::vector<std::string> clips = {"auto", "near", "frustum", "reject"};
  std::vector<std::string> model_words = with_digits({"model"});
  if ((options & 2) != 0) model_words.emplace_back("--framed");
  const Run scene = {0, std::string(bytes.rest()), ""};
  const Run modeled = run_stage(model_main, model_words, scene);
  const Run viewed = run_stage(view_main, with_digits({"view"}), modeled);
  const std::string& clip = clips[static_cast<std::size_t>(options >> 2 & 3)];
  const Run projected = run_stage(project_main, with_digits({"project", "--clip", clip}), viewed);
  check_picture(projected, (options & 16) != 0 ? "center" : "nearest");
  if ((options & 32) != 0) check_rays(viewed);
}

}  // namespace pipeline
