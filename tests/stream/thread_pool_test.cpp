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
  alone.start(5, [&](int task, int) { begun.push_back(task); });
  alone.finish();
  EXPECT_EQ(begun, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(ThreadPool, DropsQueuedTasksWhenATaskThrows) {
  ThreadPool alone(1);
  std::vector<int> begun;
  alone.start(3, [&](int task, int) {
    begun.push_back(task);
    if (task == 1) throw std::runtime_error("task 1");
  });
  EXPECT_THROW(alone.finish(), std::runtime_error);
  alone.finish();
  EXPECT_EQ(begun, (std::vector<int>{0, 1}));
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
