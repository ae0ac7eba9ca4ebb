#include "tools/mesh2scene/crash_guard.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <csignal>
#include <fstream>
#include <stdexcept>

namespace pipeline {

void go_on_in_child(const std::string& what) {
  [[maybe_unused]] const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) return;
  if (child == 0) {
#ifdef __linux__
    // A signal that ends the parent is meant for both.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
#endif
    return;
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) ::_exit(1);
  if (WIFEXITED(status)) ::_exit(WEXITSTATUS(status));
  const int number = WTERMSIG(status);
  for (const int ending : {SIGTERM, SIGINT, SIGHUP, SIGPIPE})
    if (number == ending) ::raise(number);
  const bool is_endless = number == SIGXCPU || number == SIGALRM;
  throw std::runtime_error(what + (is_endless ? ": assimp does not come to an end with this file"
                                              : ": assimp crashed (signal " + std::to_string(number) + ")"));
}

ImportLimits::ImportLimits(double seconds, double megabytes) {
  // A sanitizer's handlers would end the process without a signal.
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) std::signal(number, SIG_DFL);
  if (::getrlimit(RLIMIT_CPU, &former_time_) == 0) {
    struct rusage used = {};
    ::getrusage(RUSAGE_SELF, &used);
    struct rlimit limit = former_time_;
    const double until = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + seconds + 1;
    if (former_time_.rlim_cur == RLIM_INFINITY || until < static_cast<double>(former_time_.rlim_cur))
      limit.rlim_cur = static_cast<rlim_t>(until);
    ::setrlimit(RLIMIT_CPU, &limit);
  }
  // On the clock: the machine may be busy, and a network's files may never come.
  ::alarm(static_cast<unsigned>(60 + 20 * seconds));
  limit_memory(megabytes);
  stderr_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (stderr_ >= 0 && nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  if (nowhere >= 0) ::close(nowhere);
}

void ImportLimits::limit_memory(double megabytes) {
  if (::getrlimit(RLIMIT_DATA, &former_memory_) != 0) return;
  // Beyond what the process has now, in pages: the sixth number of the line. A sanitizer's is huge.
  std::ifstream statm("/proc/self/statm");
  double pages = 0;
  for (int i = 0; i < 6; ++i) statm >> pages;
  if (!statm) return;
  const double most = pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) + megabytes * 1e6;
  struct rlimit limit = former_memory_;
  if (limit.rlim_cur != RLIM_INFINITY && static_cast<double>(limit.rlim_cur) < most) return;
  limit.rlim_cur = static_cast<rlim_t>(most);
  ::setrlimit(RLIMIT_DATA, &limit);
}

ImportLimits::~ImportLimits() {
  ::alarm(0);
  ::setrlimit(RLIMIT_CPU, &former_time_);
  ::setrlimit(RLIMIT_DATA, &former_memory_);
  if (stderr_ < 0) return;
  ::dup2(stderr_, STDERR_FILENO);
  ::close(stderr_);
}

}  // namespace pipeline
