#pragma once

#include <sys/resource.h>

#include <string>

namespace pipeline {

/// Goes on in a child process; the parent waits for it and ends with its exit status. A library that reads
/// any bytes as any of fifty formats may crash, or never end; the user still gets one clear message: if a
/// signal ends the child, this process throws std::runtime_error that names `what` was read. SIGTERM, SIGINT,
/// SIGHUP and SIGPIPE end both. Where no process can be made, goes on without one.
void go_on_in_child(const std::string& what);

/// While it lives, `seconds` of processor time end this process by SIGXCPU, and a minute and twenty times as
/// long on the clock by SIGALRM; `megabytes` are all the memory it can get (a file of a line may ask for
/// gigabytes), and nothing reaches stderr: assimp prints its own assertions there before it aborts.
class ImportLimits {
 public:
  ImportLimits(double seconds, double megabytes);
  ~ImportLimits();
  ImportLimits(const ImportLimits&) = delete;
  ImportLimits& operator=(const ImportLimits&) = delete;

 private:
  void limit_memory(double megabytes);

  struct rlimit former_time_ = {};
  struct rlimit former_memory_ = {};
  int stderr_ = -1;
};

}  // namespace pipeline
