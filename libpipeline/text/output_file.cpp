#include "libpipeline/text/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

constexpr int kNone = -1;
constexpr int kMaxAttempts = 1000;  // to find a temporary name

/// N for a path that names the open descriptor N of this process, else kNone. Such a file must not be
/// replaced, even if it is a regular one.
int own_descriptor_of(const std::string& path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    std::size_t number = 0;
    if (path.starts_with(folder) && parse_count(std::string_view(path).substr(folder.size()), number) &&
        std::in_range<int>(number))
      return static_cast<int>(number);
  }
  return kNone;
}

/// The end of the chain of symbolic links that begins at `path`, whether or not a file exists there.
std::string target_of(const std::string& path) {
  constexpr int kMaxLinks = 40;  // the kernel's limit
  std::filesystem::path target = path;
  std::error_code error;
  for (int i = 0; i <= kMaxLinks; ++i) {
    if (own_descriptor_of(target) != kNone || !std::filesystem::is_symlink(target, error)) return target;
    target = target.parent_path() / std::filesystem::read_symlink(target, error);
    if (error) throw IoError("open", path, error.value());
  }
  throw IoError("open", path, ELOOP);
}

}  // namespace

std::optional<OutputPlace> place_of_output(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) {
    const std::string target = ::lstat(path.c_str(), &status) == 0 ? target_of(path) : path;
    if (const int own_descriptor = own_descriptor_of(target); own_descriptor != kNone) {
      if (::fstat(own_descriptor, &status) != 0) return std::nullopt;
    } else {
      const std::size_t name = target.rfind('/') + 1;  // 0 if there is no slash
      const std::string folder = name == 0 ? "." : target.substr(0, name);
      if (::stat(folder.c_str(), &status) != 0) return std::nullopt;
      return OutputPlace{status.st_dev, status.st_ino, target.substr(name)};
    }
  }
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) return std::nullopt;
  return OutputPlace{status.st_dev, status.st_ino, ""};
}

OutputFile::OutputFile(const std::string& path) : path_(path), target_(target_of(path)) {
  const int own_descriptor = own_descriptor_of(target_);
  struct stat status = {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (own_descriptor != kNone || (exists && !S_ISREG(status.st_mode)))
    open_directly(own_descriptor);
  else if (exists && ::access(target_.c_str(), W_OK) != 0)
    throw IoError("open", path_, errno);
  else
    open_beside(exists, exists ? status.st_mode & 0777 : 0666);
}

OutputFile::~OutputFile() {
  if (descriptor_ != kNone) ::close(descriptor_);
  if (unnamed_ != kNone) ::close(unnamed_);
  if (!temporary_path_.empty()) ::unlink(temporary_path_.c_str());
}

void OutputFile::open_directly(int own_descriptor) {
  // A duplicate descriptor keeps the file offset; reopening the file would not.
  descriptor_ = own_descriptor != kNone ? ::fcntl(own_descriptor, F_DUPFD_CLOEXEC, 0)
                                        : ::open(target_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (descriptor_ < 0) throw IoError("open", path_, errno);
}

std::string OutputFile::temporary_name(int attempt) const {
  const std::string name = ".pipeline-" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
  return std::filesystem::path(target_).parent_path() / name;
}

/// Opens a file that has no name yet; false where the system does not support it. It is linked later through
/// /proc.
bool OutputFile::open_unnamed(const std::string& folder, unsigned mode) {
#ifdef O_TMPFILE
  if (::access("/proc/self/fd", X_OK) != 0) return false;
  descriptor_ = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, mode);
  if (descriptor_ < 0) return false;
  unnamed_ = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (unnamed_ >= 0) return true;
  ::close(descriptor_);
#endif
  return false;
}

void OutputFile::open_beside(bool exists, unsigned mode) {
  const std::string folder = std::filesystem::path(target_).parent_path();
  if (!open_unnamed(folder.empty() ? "." : folder, mode)) {
    for (int i = 0; i < kMaxAttempts; ++i) {
      std::string name = temporary_name(i);
      descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      if (descriptor_ >= 0) temporary_path_ = std::move(name);
      if (descriptor_ >= 0 || errno != EEXIST) break;
    }
  }
  if (descriptor_ < 0) throw IoError("open", path_, errno);
  // The umask does not apply to an existing file. If chmod fails, the file has fewer permissions, never more.
  if (exists) static_cast<void>(::fchmod(descriptor_, mode));
}

void OutputFile::close() {
  if (descriptor_ == kNone) return;
  const int result = ::close(descriptor_);
  descriptor_ = kNone;
  // Linux closes the descriptor even if a signal interrupts the call.
  if (result != 0 && errno != EINTR) throw IoError("write", path_, errno);
}

void OutputFile::commit() {
  close();
  if (unnamed_ != kNone) link_into_place();
  if (temporary_path_.empty()) return;
  if (::rename(temporary_path_.c_str(), target_.c_str()) != 0) throw IoError("replace", path_, errno);
  temporary_path_.clear();
}

/// Links the file to its name, or to a temporary one if an older file has that name.
void OutputFile::link_into_place() {
  const std::string file = "/proc/self/fd/" + std::to_string(unnamed_);
  const auto link_to = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  bool is_linked = link_to(target_);
  for (int i = 0; !is_linked && errno == EEXIST && i < kMaxAttempts; ++i) {
    std::string name = temporary_name(i);
    is_linked = link_to(name);
    if (is_linked) temporary_path_ = std::move(name);
  }
  if (!is_linked) throw IoError("replace", path_, errno);
  ::close(unnamed_);
  unnamed_ = kNone;
}

}  // namespace pipeline
