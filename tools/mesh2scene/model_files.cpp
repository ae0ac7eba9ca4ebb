#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#include <sys/syscall.h>
#endif

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "libpipeline/text/error.h"
#include "tools/mesh2scene/readers.h"
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
  int found = -1;
  errno = ENOSYS;
#if __has_include(<linux/openat2.h>)
  open_how how = {};
  how.flags = kFound;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  found = static_cast<int>(::syscall(SYS_openat2, AT_FDCWD, path.c_str(), &how, sizeof how));
#endif
  if (found < 0 && (errno == ENOSYS || errno == EPERM)) found = find_without_links(path);
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
    : megabytes_(megabytes) {
  struct stat status = {};
  if (::fstat(STDOUT_FILENO, &status) == 0) outputs_[{status.st_dev, status.st_ino}] = "standard output";
  for (const std::string& file : written)
    if (::stat(file.c_str(), &status) == 0)
      outputs_.try_emplace({status.st_dev, status.st_ino}, "--writes " + pipeline::quoted(file));
  int model = STDIN_FILENO;
  if (path != "-") {
    if (::stat(path.c_str(), &status) != 0) throw IoError("open", path.empty() ? "''" : path, errno);
    if (S_ISDIR(status.st_mode)) throw IoError("read", path, EISDIR);
    if (!S_ISREG(status.st_mode))
      throw std::runtime_error(path + ": expected a regular file, or - for what comes through a pipe");
    model = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (model < 0 || (!folder.empty() && ::chdir(folder.c_str()) != 0)) throw IoError("open", path, errno);
  }
  model_ = content(model, path == "-" ? "<stdin>" : path);
  has_folder_ = path != "-";
}

/// The bytes of a file, which is read once; closes it.
std::string_view ModelFiles::content(int descriptor, const std::string& name) {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0) throw IoError("read", name, errno);
  const Inode inode = {status.st_dev, status.st_ino};
  if (const auto output = outputs_.find(inode); has_folder_ && output != outputs_.end())
    throw UsageError(expected_but_found("a place of its own for " + output->second,
                                        pipeline::quoted(name) + ", which the model names"));
  const auto [known, is_new] = contents_.try_emplace(inode);
  TextWriter& bytes = known->second;
  constexpr std::size_t kBlock = 1 << 16;
  const std::size_t room = megabytes_ * 1'000'000 - size_;
  // Unknown for standard input, which may be a pipe, or a file of which a part has been read.
  const std::size_t size = descriptor == STDIN_FILENO ? 0 : static_cast<std::size_t>(status.st_size);
  if (is_new && size <= room) bytes.reserve(size + kBlock);
  for (ssize_t count = is_new ? -1 : 0; count != 0;) {
    char* const p = bytes.reserve(kBlock);
    count = ::read(descriptor, p, kBlock);
    if (count < 0 && errno != EINTR) throw IoError("read", name, errno);
    bytes.commit(p + std::max<ssize_t>(count, 0));
    if (std::max(bytes.collected().size(), size) > room)
      throw std::runtime_error(name + ": expected at most " + std::to_string(megabytes_) +
                               " MB in all files of a model (--max-input), found more");
  }
  if (is_new) size_ += bytes.collected().size();
  ::close(descriptor);
  return bytes.collected();
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
    return content(opened, name);
  }
  return std::nullopt;
}

}  // namespace pipeline
