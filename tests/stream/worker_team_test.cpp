#include "libpipeline/stream/worker_team.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace pipeline {
namespace {

class WorkerTeamTest : public testing::TestWithParam<int> {};

TEST_P(WorkerTeamTest, DoesEveryTaskOfEveryJobOnce) {
  WorkerTeam team(GetParam());
  for (int task_count = 0; task_count < 50; ++task_count) {
    std::vector<int> times_done(static_cast<std::size_t>(task_count));
    team.start(task_count, [&](int task, int) { ++times_done[static_cast<std::size_t>(task)]; });
    team.finish();
    EXPECT_EQ(times_done, std::vector<int>(static_cast<std::size_t>(task_count), 1));
  }
}

TEST_P(WorkerTeamTest, FinishesWithoutAJob) {
  WorkerTeam team(GetParam());
  team.start(0, [](int, int) { ADD_FAILURE(); });
  team.help();
  team.finish();
  team.finish();
}

TEST_P(WorkerTeamTest, DoesJobsThatWereStartedBeforeOthersWereDone) {
  WorkerTeam team(GetParam());
  std::array<std::atomic<int>, 100> times_done = {};
  for (std::size_t job = 0; job < times_done.size(); ++job) {
    const int task_count = job % 2 == 0 ? 1 : 3;
    team.start(task_count, [&times = times_done[job]](int task, int) { times += task + 1; });
  }
  team.finish();
  for (std::size_t job = 0; job < times_done.size(); ++job)
    EXPECT_EQ(times_done[job], job % 2 == 0 ? 1 : 1 + 2 + 3) << job;
}

TEST_P(WorkerTeamTest, HelpGetsOneMoreTaskDone) {
  WorkerTeam team(GetParam());
  std::atomic<int> done_count = 0;
  for (int i = 1; i <= 200; ++i) {
    team.start(1, [&](int, int) { ++done_count; });
    while (done_count < i) team.help();
  }
  EXPECT_EQ(done_count, 200);
}

TEST_P(WorkerTeamTest, AWorkerDoesOneTaskAtATime) {
  WorkerTeam team(GetParam());
  std::vector<std::atomic<bool>> is_busy(static_cast<std::size_t>(team.size()));
  team.start(1000, [&](int, int worker) {
    std::atomic<bool>& is_worker_busy = is_busy.at(static_cast<std::size_t>(worker));
    EXPECT_FALSE(is_worker_busy.exchange(true));
    std::this_thread::yield();
    is_worker_busy = false;
  });
  team.finish();
}

TEST(WorkerTeam, BeginsTasksInOrder) {
  WorkerTeam alone(1);
  std::vector<int> begun;
  for (const int job : {10, 20, 30}) alone.start(3, [&, job](int task, int) { begun.push_back(job + task); });
  alone.help();
  EXPECT_EQ(begun, std::vector<int>{10});
  alone.finish();
  EXPECT_EQ(begun, (std::vector<int>{10, 11, 12, 20, 21, 22, 30, 31, 32}));
}

TEST(WorkerTeam, LeavesOutWhatWasNotBegunWhenATaskThrew) {
  WorkerTeam alone(1);
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

TEST_P(WorkerTeamTest, HelpThrowsWhatATaskThrew) {
  WorkerTeam team(GetParam());
  team.start(1, [](int, int) { throw std::runtime_error("task"); });
  const auto help_until_it_throws = [&] {
    for (;;) team.help();
  };
  EXPECT_THROW(help_until_it_throws(), std::runtime_error);
  team.finish();
}

TEST_P(WorkerTeamTest, ThrowsWhatATaskThrewAndGoesOnWithTheNextJob) {
  WorkerTeam team(GetParam());
  team.start(10, [](int task, int) {
    if (task == 3) throw std::runtime_error("task 3");
  });
  EXPECT_THROW(team.finish(), std::runtime_error);
  std::atomic<int> done_count = 0;
  team.start(10, [&](int, int) { ++done_count; });
  team.finish();
  EXPECT_EQ(done_count, 10);
}

TEST_P(WorkerTeamTest, MayBeDestroyedInTheMiddleOfAJob) {
  std::atomic<int> begun_count = 0, done_count = 0;
  {
    WorkerTeam team(GetParam());
    team.start(1000, [&](int, int) {
      ++begun_count;
      std::this_thread::yield();
      ++done_count;
    });
  }
  EXPECT_EQ(done_count, begun_count);
}

TEST_P(WorkerTeamTest, BeginsNothingBehindWhatWasLeftOut) {
  WorkerTeam team(GetParam());
  std::atomic<int> next = 0;
  const auto start_many = [&] {
    for (int number = 0; number < 1000; ++number)
      team.start(1, [&, number](int, int) {
        while (next != number) std::this_thread::yield();  // for ever, had one before it been left out
        next = number + 1;
        if (number == 20) throw std::runtime_error("task 20");
      });
    team.finish();
  };
  EXPECT_THROW(start_many(), std::runtime_error);
}

TEST_P(WorkerTeamTest, MayBeGivenUpInTheMiddleOfAJobAndGoOn) {
  WorkerTeam team(GetParam());
  std::atomic<int> begun_count = 0, done_count = 0;
  team.start(1000, [&](int, int) {
    ++begun_count;
    std::this_thread::yield();
    ++done_count;
    throw std::runtime_error("forgotten");
  });
  team.give_up();
  EXPECT_EQ(done_count, begun_count);
  const int count = begun_count;
  team.start(10, [&](int, int) { ++begun_count; });
  team.finish();
  EXPECT_EQ(begun_count, count + 10);
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkerTeamTest, testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace pipeline
