#include "libpipeline/stream/thread_pool.h"

#include <cassert>
#include <utility>

namespace pipeline {

ThreadPool::ThreadPool(int thread_count) {
  assert(thread_count >= 1);
  threads_.reserve(static_cast<std::size_t>(thread_count));
  try {
    for (int i = 1; i < thread_count; ++i) threads_.emplace_back([this, i] { work(i); });
  } catch (const std::exception&) {
    // The system refuses to start more threads; the running ones do all the work.
  }
}

ThreadPool::~ThreadPool() {
  cancel();
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  has_tasks_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::start(int task_count, Task task) {
  {
    const std::lock_guard lock(mutex_);
    assert(!has_task() && busy_count_ == 0);
    task_ = std::move(task);
    task_count_ = task_count;
    next_task_ = 0;
  }
  has_tasks_.notify_all();
}

void ThreadPool::finish() {
  Lock lock(mutex_);
  while (has_task()) do_next_task(lock, kOwner);
  is_task_done_.wait(lock, [this] { return busy_count_ == 0; });
  if (failure_ != nullptr) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::cancel() {
  Lock lock(mutex_);
  next_task_ = task_count_;
  is_task_done_.wait(lock, [this] { return busy_count_ == 0; });
  failure_ = nullptr;
}

void ThreadPool::work(int worker) {
  Lock lock(mutex_);
  for (;;) {
    has_tasks_.wait(lock, [this] { return is_over_ || has_task(); });
    if (is_over_) return;
    do_next_task(lock, worker);
  }
}

void ThreadPool::do_next_task(Lock& lock, int worker) {
  const int number = next_task_++;
  ++busy_count_;
  lock.unlock();
  std::exception_ptr failure;
  try {
    task_(number, worker);
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  if (failure != nullptr) {
    failure_ = failure;
    next_task_ = task_count_;
  }
  --busy_count_;
  is_task_done_.notify_one();
}

}  // namespace pipeline
