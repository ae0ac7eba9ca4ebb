#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace pipeline {

/// Some threads that, together with the one that owns the pool, do the numbered tasks of jobs. Tasks are
/// begun in order, by whoever is free; nothing is said of the order in which those of several workers end. A
/// worker does one task at a time. Workers have numbers, too, less than size(); the owner is 0.
class ThreadPool {
 public:
  /// `thread_count`, at least 1, includes the owner: a pool of 1 does everything in run_one() and finish().
  /// Where the system has fewer threads to give, the pool is smaller.
  explicit ThreadPool(int thread_count);
  /// As cancel().
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// How many threads there are, the owner included.
  [[nodiscard]] int size() const { return static_cast<int>(threads_.size()) + 1; }

  using Task = std::function<void(int number, int worker)>;

  /// Has the others do `task(number, worker)` for numbers from 0 to task_count - 1, after the jobs started
  /// before. So that none is begun behind one that was left out, this, too, throws what a task threw.
  void start(int task_count, Task task);
  /// Does the next task or, where all are begun, waits until one is done; returns at once if all are done.
  /// What a task threw is thrown here, in start() or in finish(); the tasks started before and not yet begun
  /// are left out.
  void run_one();
  /// Helps until every task is done.
  void finish();
  /// Waits for tasks that were begun, whatever they throw; others are not done any more. For destructors of
  /// what tasks use.
  void cancel();

 private:
  static constexpr int kOwner = 0;
  struct Job {
    Task task;
    int task_count;
    int next_task = 0;
  };
  using Lock = std::unique_lock<std::mutex>;

  void work(int worker);
  void do_next_task(Lock& lock, int worker);
  void throw_failure();

  std::mutex mutex_;
  std::condition_variable has_tasks_;
  std::condition_variable is_task_done_;
  std::deque<std::shared_ptr<Job>> jobs_;  // with tasks that are not begun
  int busy_count_ = 0;                     // tasks that are begun and not done
  bool is_over_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

}  // namespace pipeline
