#include "libpipeline/text/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <forward_list>
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
  if (path == "/dev/stdin") return STDIN_FILENO;
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    std::uint64_t number = 0;
    if (path.starts_with(folder) && parse_count(std::string_view(path).substr(folder.size()), number) &&
        std::in_range<int>(number))
      return static_cast<int>(number);
  }
  return kNone;
}

bool has_status(const std::string& path, struct stat& status) {
  const int own_descriptor = own_descriptor_of(path);
  return (own_descriptor != kNone ? ::fstat(own_descriptor, &status) : ::stat(path.c_str(), &status)) == 0;
}

/// The end of the chain of symbolic links that begins at `path`, whether or not a file exists there.
std::string target_of(const std::string& path) {
  constexpr int kMaxLinks = 40;  // the kernel's limit
  std::string target = path;
  std::error_code error;
  for (int i = 0; i <= kMaxLinks; ++i) {
    if (own_descriptor_of(target) != kNone || !std::filesystem::is_symlink(target, error)) return target;
    const std::filesystem::path folder = std::filesystem::path(target).parent_path();
    target = (folder / std::filesystem::read_symlink(target, error)).string();
    if (error) throw IoError("open", path, error.value());
  }
  throw IoError("open", path, ELOOP);
}

/// Holds back, while it exists, the signals whose handler may call `remove_unfinished`.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t waiting;
    sigemptyset(&waiting);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&waiting, number);
    pthread_sigmask(SIG_BLOCK, &waiting, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

// Changed only while signals wait, so that a handler never sees it half changed.
std::forward_list<std::string> unfinished;

void drop_unfinished(const std::string& path) {
  const SignalsWait wait;
  unfinished.remove(path);
}

}  // namespace

void add_unfinished(const std::string& path) {
  const SignalsWait wait;
  unfinished.push_front(path);
}

void keep_unfinished() {
  const SignalsWait wait;
  unfinished.clear();
}

bool remove_unfinished() noexcept {
  for (const std::string& path : unfinished)
    if (::unlink(path.c_str()) != 0) ::rmdir(path.c_str());
  return !unfinished.empty();
}

std::optional<FilePlace> place_of(const std::string& path) {
  if (path.empty()) return std::nullopt;
#ifdef _WIN32  // there, stat() numbers no files
  if (!is_replaced(path)) return std::nullopt;
  std::string canonical = std::filesystem::absolute(path).string();
  return FilePlace{0, 0, ::_strlwr(canonical.data())};
#endif
  struct stat status = {};
  std::string target = path;
  if (has_status(path, status) || has_status(target = target_of(path), status))
    return S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode)
               ? std::optional(FilePlace{status.st_dev, status.st_ino, ""})
               : std::nullopt;
  if (own_descriptor_of(target) != kNone) throw IoError("open", path, errno);
  const std::size_t name = target.rfind('/') + 1;  // 0 if there is no slash
  const std::string folder = name == 0 ? "." : target.substr(0, name);
  if (::stat(folder.c_str(), &status) != 0) return std::nullopt;
  return FilePlace{status.st_dev, status.st_ino, target.substr(name)};
}

bool is_replaced(const std::string& path) {
  const std::string target = target_of(path);
  struct stat status = {};
  return own_descriptor_of(target) == kNone && (!has_status(target, status) || S_ISREG(status.st_mode));
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
  if (temporary_path_.empty()) return;
  ::unlink(temporary_path_.c_str());
  drop_unfinished(temporary_path_);
}

void OutputFile::open_directly(int own_descriptor) {
  // A duplicate descriptor keeps the file offset; reopening the file would not.
  descriptor_ = own_descriptor != kNone ? ::fcntl(own_descriptor, F_DUPFD_CLOEXEC, 0)
                                        : ::open(target_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (descriptor_ < 0) throw IoError("open", path_, errno);
}

std::string OutputFile::temporary_name(int attempt) const {
  const std::string name = ".pipeline-" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
  return target_.substr(0, target_.size() - std::filesystem::path(target_).filename().native().size()) + name;
}

/// Opens a file that has no name yet; false where the system does not support it. Its name is linked later,
/// through /proc.
bool OutputFile::open_unnamed([[maybe_unused]] const std::string& folder, [[maybe_unused]] unsigned mode) {
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

/// Tries temporary names until `make` makes a file under one. If all fail, errno is that of `make`.
void OutputFile::make_temporary(const std::function<bool(const std::string&)>& make) {
  for (int i = 0; i < kMaxAttempts; ++i) {
    std::string name = temporary_name(i);
    const SignalsWait wait;
    add_unfinished(name);
    if (make(name)) {
      temporary_path_ = std::move(name);
      return;
    }
    const int error = errno;
    drop_unfinished(name);
    errno = error;
    if (error != EEXIST) return;
  }
}

void OutputFile::open_beside(bool exists, unsigned mode) {
  const std::string folder = std::filesystem::path(target_).parent_path().string();
  if (!open_unnamed(folder.empty() ? "." : folder, mode))
    make_temporary([&](const std::string& name) {
      descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      return descriptor_ >= 0;
    });
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
  drop_unfinished(temporary_path_);
  temporary_path_.clear();
}

/// Links the file to its name, or to a temporary one if an older file has that name.
void OutputFile::link_into_place() {
  const std::string file = "/proc/self/fd/" + std::to_string(unnamed_);
  const auto link_to = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  bool is_linked = link_to(target_);
  if (!is_linked && errno == EEXIST)
    make_temporary([&](const std::string& name) { return is_linked = link_to(name); });
  if (!is_linked) throw IoError("replace", path_, errno);
  ::close(unnamed_);
  unnamed_ = kNone;
}

}  // namespace pipeline
