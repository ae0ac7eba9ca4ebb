#pragma once

// Included before every source of a build for Windows (CMakeLists.txt): the POSIX calls that mingw-w64
// lacks, or to which it gives another meaning.

#include <fcntl.h>
#include <io.h>
#include <pthread.h>

#include <cerrno>
#include <csignal>

// Texts and pictures keep their bytes: no CR is written before an LF. A descriptor can always be used.
inline constexpr int O_CLOEXEC = _O_NOINHERIT | _O_BINARY, O_NOCTTY = 0;
inline const int kBinaryStreams =
    ::_setmode(0, _O_BINARY) | ::_setmode(1, _O_BINARY) | ::_setmode(2, _O_BINARY);
inline constexpr int F_GETFD = 0, F_GETFL = 1, F_DUPFD_CLOEXEC = 2, AT_FDCWD = -1, AT_SYMLINK_FOLLOW = 0;
inline int fcntl(int descriptor, int command, int = 0) {
  return command == F_DUPFD_CLOEXEC ? ::_dup(descriptor) : 0;
}
inline int write(int descriptor, const void* bytes, std::size_t size) {
  const int count = ::write(descriptor, bytes, size < 1U << 30 ? static_cast<unsigned>(size) : 1U << 30);
  if (count < 0 && errno == EINVAL) errno = EPIPE;  // as Windows reports a closed pipe
  return count;
}

// Windows' own rename() does not replace a file.
extern "C" __declspec(dllimport) int __stdcall MoveFileExA(const char* from, const char* to, unsigned long);
inline int replace_file(const char* from, const char* to) {
  if (constexpr unsigned long kReplaceExisting = 1; ::MoveFileExA(from, to, kReplaceExisting) != 0) return 0;
  errno = EACCES;
  return -1;
}
#define rename replace_file

// Signals arrive in a thread of their own and cannot be held back; SIGPIPE and SIGXFSZ never arrive.
#define SIGHUP SIGBREAK  // Ctrl-Break, and a console that is closed
inline constexpr int SIGPIPE = 13, SIGXFSZ = 25;
using sigset_t = int;
#undef pthread_sigmask
inline constexpr auto ignored = [](auto...) { return 0; };
inline constexpr auto sigemptyset = ignored, sigaddset = ignored, pthread_sigmask = ignored;
inline constexpr auto fchmod = ignored, linkat = ignored;  // files have names and no modes

#define S_ISSOCK(mode) false
#define program_invocation_short_name "pipeline"
