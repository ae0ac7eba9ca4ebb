#include "tools/mesh2scene/model_files.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#include <sys/syscall.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "libpipeline/text/error.h"
#include "tools/rim/command_line.h"

namespace pipeline {
namespace {

#ifdef O_PATH
constexpr int kFound = O_PATH | O_CLOEXEC;
#else
constexpr int kFound = O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
#endif
constexpr int kNotThere = -1, kRefused = -2;

/// Finds a file below the current folder by a path without links and `..`, for systems without openat2.
int find_without_links(const std::filesystem::path& path) {
  errno = EXDEV;
  if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end()) return -1;
  int found = ::open(".", kFound);
  for (const std::filesystem::path& step : path) {
    const int folder = std::exchange(found, ::openat(found, step.c_str(), kFound | O_NOFOLLOW));
    if (folder >= 0) ::close(folder);
  }
  return found;
}

/// Opens a regular file below the current folder. Anything else is found but not opened: to open a FIFO or a
/// device may block or have an effect.
int open_below(const std::string& path) {
#if __has_include(<linux/openat2.h>)
  open_how how = {};
  how.flags = kFound;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  auto found = static_cast<int>(::syscall(SYS_openat2, AT_FDCWD, path.c_str(), &how, sizeof how));
  if (found < 0 && (errno == ENOSYS || errno == EPERM)) found = find_without_links(path);
#else
  const int found = find_without_links(path);
#endif
  if (found < 0) return errno == EXDEV || errno == ELOOP ? kRefused : kNotThere;
  struct stat status = {};
  const bool is_regular = ::fstat(found, &status) == 0 && S_ISREG(status.st_mode);
  const std::string same = "/dev/fd/" + std::to_string(found);
  const int opened = is_regular ? ::open(same.c_str(), O_RDONLY | O_CLOEXEC) : kRefused;
  ::close(found);
  return opened;
}

}  // namespace

ModelFiles::ModelFiles(const std::string& path, std::size_t megabytes,
                       const std::vector<std::string>& written)
    : megabytes_(megabytes), room_(megabytes * 1'000'000) {
  struct stat status = {};
  if (::fstat(STDOUT_FILENO, &status) == 0) outputs_[{status.st_dev, status.st_ino}] = "standard output";
  for (const std::string& file : written)
    if (::stat(file.c_str(), &status) == 0)
      outputs_.try_emplace({status.st_dev, status.st_ino}, "--writes " + pipeline::quoted(file));
  if (path == "-") {
    model_ = read_standard_input();
    return;
  }
  if (::stat(path.c_str(), &status) != 0) throw IoError("open", path.empty() ? "''" : path, errno);
  if (S_ISDIR(status.st_mode)) throw IoError("read", path, EISDIR);
  if (!S_ISREG(status.st_mode))
    throw std::runtime_error(path + ": expected a regular file, or - for what comes through a pipe");
  const int model = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (model < 0 || (!folder.empty() && ::chdir(folder.c_str()) != 0)) throw IoError("open", path, errno);
  model_ = map(model, path);
  has_folder_ = true;
}

void ModelFiles::take_room(std::size_t bytes, const std::string& name) {
  if (bytes > room_)
    throw std::runtime_error(name + ": expected at most " + std::to_string(megabytes_) +
                             " MB in all files of a model (--max-input), found more");
  room_ -= bytes;
}

std::string_view ModelFiles::read_standard_input() {
  std::array<char, 1 << 16> block{};
  for (ssize_t size = -1; size != 0;) {
    size = ::read(STDIN_FILENO, block.data(), block.size());
    if (size < 0 && errno != EINTR) throw IoError("read", "<stdin>", errno);
    const auto count = static_cast<std::size_t>(std::max<ssize_t>(size, 0));
    take_room(count, "<stdin>");
    standard_input_.append(block.data(), count);
  }
  return standard_input_;
}

/// The bytes of a file; closes it, and keeps it mapped until the process ends.
std::string_view ModelFiles::map(int descriptor, const std::string& name) {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) throw IoError("read", name, EINVAL);
  if (const auto output = outputs_.find({status.st_dev, status.st_ino});
      has_folder_ && output != outputs_.end())
    throw UsageError(expected_but_found("a place of its own for " + output->second,
                                        pipeline::quoted(name) + ", which the model names"));
  const auto [known, is_new] = mapped_.try_emplace({status.st_dev, status.st_ino});
  const auto size = static_cast<std::size_t>(is_new ? status.st_size : 0);
  take_room(size, name);
  // An empty file cannot be mapped.
  const void* const bytes = size == 0 ? "" : ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  ::close(descriptor);
  if (bytes == MAP_FAILED) throw IoError("read", name, errno);
  if (is_new) known->second = {static_cast<const char*>(bytes), size};
  return known->second;
}

std::string ModelFiles::refusal() const {
  if (refused_.empty()) return "";
  const char* const expected = has_folder_ ? "regular files in or below the model's folder"
                                           : "no other file, as standard input has no folder";
  return expected_but_found(expected, pipeline::quoted(refused_));
}

std::optional<std::string_view> ModelFiles::read(const std::string& file) {
  const std::string last = std::filesystem::path(file).filename();
  for (const std::string& name : {file, last}) {
    const int opened = has_folder_ ? open_below(name) : kRefused;
    if (opened == kRefused && refused_.empty()) refused_ = name;
    if (opened < 0) continue;
    if (std::filesystem::path(refused_).filename() == last) refused_.clear();
    return map(opened, name);
  }
  return std::nullopt;
}

}  // namespace pipeline
