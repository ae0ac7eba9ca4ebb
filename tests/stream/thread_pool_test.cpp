#include "libpipeline/stream/thread_pool.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace pipeline {
namespace {

class ThreadPoolTest : public testing::TestWithParam<int> {};

TEST_P(ThreadPoolTest, DoesEveryTaskOfEveryJobOnce) {
  ThreadPool pool(GetParam());
  for (int task_count = 0; task_count < 50; ++task_count) {
    std::vector<int> times_done(static_cast<std::size_t>(task_count));
    pool.start(task_count, [&](int task, int) { ++times_done[static_cast<std::size_t>(task)]; });
    pool.finish();
    EXPECT_EQ(times_done, std::vector<int>(static_cast<std::size_t>(task_count), 1));
  }
}

TEST_P(ThreadPoolTest, FinishesWithoutAJob) {
  ThreadPool pool(GetParam());
  pool.start(0, [](int, int) { ADD_FAILURE(); });
  pool.finish();
  pool.finish();
}

TEST_P(ThreadPoolTest, DoesJobsThatStartBeforeOthersAreDone) {
  ThreadPool pool(GetParam());
  std::array<std::atomic<int>, 100> times_done = {};
  for (std::size_t job = 0; job < times_done.size(); ++job) {
    const int task_count = job % 2 == 0 ? 1 : 3;
    pool.start(task_count, [&times = times_done[job]](int task, int) { times += task + 1; });
  }
  pool.finish();
  for (std::size_t job = 0; job < times_done.size(); ++job)
    EXPECT_EQ(times_done[job], job % 2 == 0 ? 1 : 1 + 2 + 3) << job;
}

TEST_P(ThreadPoolTest, AWorkerDoesOneTaskAtATime) {
  ThreadPool pool(GetParam());
  std::vector<std::atomic<bool>> is_busy(static_cast<std::size_t>(pool.size()));
  pool.start(1000, [&](int, int worker) {
    std::atomic<bool>& is_worker_busy = is_busy.at(static_cast<std::size_t>(worker));
    EXPECT_FALSE(is_worker_busy.exchange(true));
    std::this_thread::yield();
    is_worker_busy = false;
  });
  pool.finish();
}

TEST(ThreadPool, StartsTasksInOrder) {
  ThreadPool alone(1);
  std::vector<int> begun;
  for (const int job : {10, 20, 30}) alone.start(3, [&, job](int task, int) { begun.push_back(job + task); });
  alone.finish();
  EXPECT_EQ(begun, (std::vector<int>{10, 11, 12, 20, 21, 22, 30, 31, 32}));
}

TEST(ThreadPool, DropsQueuedTasksWhenATaskThrows) {
  ThreadPool alone(1);
  std::vector<int> begun;
  for (const int job : {10, 20})
    alone.start(3, [&, job](int task, int) {
      begun.push_back(job + task);
      if (task == 1) throw std::runtime_error("task 1");
    });
  EXPECT_THROW(alone.finish(), std::runtime_error);
  alone.finish();
  EXPECT_EQ(begun, (std::vector<int>{10, 11}));
}

TEST_P(ThreadPoolTest, RethrowsTheExceptionOfATaskAndGoesOnWithTheNextJob) {
  ThreadPool pool(GetParam());
  pool.start(10, [](int task, int) {
    if (task == 3) throw std::runtime_error("task 3");
  });
  EXPECT_THROW(pool.finish(), std::runtime_error);
  std::atomic<int> done_count = 0;
  pool.start(10, [&](int, int) { ++done_count; });
  pool.finish();
  EXPECT_EQ(done_count, 10);
}

TEST_P(ThreadPoolTest, MayBeDestroyedInTheMiddleOfAJob) {
  std::atomic<int> begun_count = 0, done_count = 0;
  {
    ThreadPool pool(GetParam());
    pool.start(1000, [&](int, int) {
      ++begun_count;
      std::this_thread::yield();
      ++done_count;
    });
  }
  EXPECT_EQ(done_count, begun_count);
}

TEST_P(ThreadPoolTest, StartsNoJobAfterADroppedTask) {
  ThreadPool pool(GetParam());
  std::atomic<int> next = 0;
  const auto start_many = [&] {
    for (int number = 0; number < 1000; ++number)
      pool.start(1, [&, number](int, int) {
        while (next != number) std::this_thread::yield();  // forever if an earlier task was dropped
        next = number + 1;
        if (number == 20) throw std::runtime_error("task 20");
      });
    pool.finish();
  };
  EXPECT_THROW(start_many(), std::runtime_error);
}

TEST_P(ThreadPoolTest, MayCancelInTheMiddleOfAJobAndGoOn) {
  ThreadPool pool(GetParam());
  std::atomic<int> begun_count = 0, done_count = 0;
  pool.start(1000, [&](int, int) {
    ++begun_count;
    std::this_thread::yield();
    ++done_count;
    throw std::runtime_error("forgotten");
  });
  pool.cancel();
  EXPECT_EQ(done_count, begun_count);
  const int count = begun_count;
  pool.start(10, [&](int, int) { ++begun_count; });
  pool.finish();
  EXPECT_EQ(begun_count, count + 10);
}

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPoolTest, testing::Values(1, 2, 3, 8),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace pipeline
