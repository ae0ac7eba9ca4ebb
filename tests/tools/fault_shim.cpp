// Loaded before a tool (LD_PRELOAD), makes one system call or allocation fail, or all reads and writes
// short.
//
//   FAULT_CALL   malloc (any allocation), write, read, seek, close, close of stdout, close of data (of
//                a file that was written to), access, link, rename or thread
//   FAULT_AT     the number of the call that fails, from 1
//   FAULT_ERRNO  its errno
//   FAULT_MARK   a file that is created when it fails
//   FAULT_SHORT  if set, read and write transfer one byte a call

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<int> calls = 0;
std::array<std::atomic<bool>, 64> was_written;  // by descriptor

template <typename Function>
Function next_one(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// True if this call is the one that fails; sets errno.
bool fails(const char* call) {
  const char* const wanted = std::getenv("FAULT_CALL");
  if (wanted == nullptr || std::strcmp(wanted, call) != 0) return false;
  if (++calls != std::atoi(std::getenv("FAULT_AT"))) return false;
  ::syscall(SYS_close,
            static_cast<int>(::syscall(SYS_open, std::getenv("FAULT_MARK"), O_WRONLY | O_CREAT, 0600)));
  errno = std::atoi(std::getenv("FAULT_ERRNO"));
  return true;
}

bool is_file(int descriptor) {
  return descriptor > STDERR_FILENO && descriptor < static_cast<int>(was_written.size());
}

std::size_t allowed(std::size_t size) {
  return size > 1 && std::getenv("FAULT_SHORT") != nullptr ? 1 : size;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  // The C library's internal names, since dlsym allocates.
  extern void* __libc_malloc(std::size_t);  // NOLINT(bugprone-reserved-identifier)
  return fails("malloc") ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  extern void* __libc_calloc(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
  return fails("malloc") ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) {
  extern void* __libc_realloc(void*, std::size_t);  // NOLINT(bugprone-reserved-identifier)
  return fails("malloc") ? nullptr : __libc_realloc(memory, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  extern void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
  return fails("malloc") ? nullptr : __libc_memalign(alignment, size);
}

ssize_t write(int descriptor, const void* text, std::size_t size) {
  if (is_file(descriptor)) was_written[static_cast<std::size_t>(descriptor)] = true;
  return fails("write") ? -1 : ::syscall(SYS_write, descriptor, text, allowed(size));
}

ssize_t read(int descriptor, void* text, std::size_t size) {
  return fails("read") ? -1 : ::syscall(SYS_read, descriptor, text, allowed(size));
}

off_t lseek(int descriptor, off_t offset, int origin) noexcept {
  return fails("seek") ? -1 : ::syscall(SYS_lseek, descriptor, offset, origin);
}

int close(int descriptor) {
  const bool had_data =
      is_file(descriptor) && was_written[static_cast<std::size_t>(descriptor)].exchange(false);
  const bool is_failing = fails("close") || (descriptor == STDOUT_FILENO && fails("close of stdout")) ||
                          (had_data && fails("close of data"));
  const int error = errno;
  const int result = static_cast<int>(::syscall(SYS_close, descriptor));
  if (is_failing) errno = error;
  return is_failing ? -1 : result;
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  return fails("link") ? -1
                       : static_cast<int>(::syscall(SYS_linkat, from_folder, from, to_folder, to, flags));
}

int access(const char* path, int mode) noexcept {
  static const auto next = next_one<int (*)(const char*, int)>("access");
  return fails("access") ? -1 : next(path, mode);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* data) {
  static const auto next = next_one<decltype(&pthread_create)>("pthread_create");
  return fails("thread") ? errno : next(thread, attributes, work, data);
}

int rename(const char* from, const char* to) noexcept {
  static const auto next = next_one<int (*)(const char*, const char*)>("rename");
  return fails("rename") ? -1 : next(from, to);
}
}
