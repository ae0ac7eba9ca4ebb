#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pipeline {

/// A thread pool whose owner works, too. It does one job at a time. A job is a number of tasks; tasks start
/// in order and may finish in any order. A worker runs one task at a time. Workers are numbered from 0, the
/// owner, to size() - 1.
class ThreadPool {
 public:
  /// `thread_count`, at least 1, includes the owner: a pool of 1 runs all tasks in finish(). If the system
  /// refuses threads, the pool is smaller.
  explicit ThreadPool(int thread_count);
  /// Cancels, see cancel().
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// The number of threads, the owner included.
  [[nodiscard]] int size() const { return static_cast<int>(threads_.size()) + 1; }

  using Task = std::function<void(int number, int worker)>;

  /// Has the other workers run `task(number, worker)` for numbers from 0 to task_count - 1. The job before
  /// must be finished.
  void start(int task_count, Task task);
  /// Runs tasks until all are done. A task's exception drops all queued tasks, and is rethrown here.
  void finish();
  /// Drops all queued tasks and waits for the running ones, whose exceptions are lost. For destructors of
  /// objects that tasks use.
  void cancel();

 private:
  static constexpr int kOwner = 0;
  using Lock = std::unique_lock<std::mutex>;

  void work(int worker);
  void do_next_task(Lock& lock, int worker);
  [[nodiscard]] bool has_task() const { return next_task_ < task_count_; }

  std::mutex mutex_;
  std::condition_variable has_tasks_;
  std::condition_variable is_task_done_;
  Task task_;  // of the job
  int task_count_ = 0, next_task_ = 0;
  int busy_count_ = 0;  // tasks that are running
  bool is_over_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

}  // namespace pipeline
