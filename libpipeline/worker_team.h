#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pipeline {

/// Some threads that, together with the one that owns the team, do the numbered tasks of one job after
/// another. Whoever is free takes the next task, so nothing that tasks of one job share may depend on their
/// order.
class WorkerTeam {
 public:
  /// `thread_count`, at least 1, includes the owner: a team of 1 does everything in finish(). Where the
  /// system has fewer threads to give, the team is smaller.
  explicit WorkerTeam(int thread_count);
  /// Waits for tasks that were begun; others are not done any more.
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  /// Has the others begin with `task(0)` to `task(task_count - 1)`; the job before has to be finished.
  void start(int task_count, std::function<void(int)> task);
  /// Helps until every task of the job is done. What a task threw is thrown here; the tasks not yet begun are
  /// left out.
  void finish();

 private:
  void work();
  void do_tasks(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable has_tasks_;
  std::condition_variable is_done_;
  std::function<void(int)> task_;
  int task_count_ = 0;
  int next_task_ = 0;
  int busy_count_ = 0;
  bool is_over_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

}  // namespace pipeline
