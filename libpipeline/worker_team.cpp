#include "libpipeline/worker_team.h"

#include <cassert>
#include <utility>

namespace pipeline {

WorkerTeam::WorkerTeam(int thread_count) {
  assert(thread_count >= 1);
  threads_.reserve(static_cast<std::size_t>(thread_count));
  try {
    for (int i = 1; i < thread_count; ++i) threads_.emplace_back([this] { work(); });
  } catch (const std::exception&) {
    // The system gives no more threads. Those that are there do the same work.
  }
}

WorkerTeam::~WorkerTeam() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    next_task_ = task_count_;
  }
  has_tasks_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerTeam::start(int task_count, std::function<void(int)> task) {
  {
    const std::lock_guard lock(mutex_);
    assert(next_task_ == task_count_ && busy_count_ == 0);
    task_ = std::move(task);
    task_count_ = task_count;
    next_task_ = 0;
  }
  has_tasks_.notify_all();
}

void WorkerTeam::finish() {
  std::unique_lock lock(mutex_);
  do_tasks(lock);
  is_done_.wait(lock, [this] { return busy_count_ == 0; });
  if (failure_ != nullptr) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void WorkerTeam::work() {
  std::unique_lock lock(mutex_);
  while (!is_over_) {
    do_tasks(lock);
    has_tasks_.wait(lock, [this] { return is_over_ || next_task_ < task_count_; });
  }
}

void WorkerTeam::do_tasks(std::unique_lock<std::mutex>& lock) {
  while (next_task_ < task_count_) {
    const int number = next_task_++;
    ++busy_count_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      task_(number);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure != nullptr) {
      failure_ = failure;
      next_task_ = task_count_;
    }
    if (--busy_count_ == 0) is_done_.notify_one();
  }
}

}  // namespace pipeline
