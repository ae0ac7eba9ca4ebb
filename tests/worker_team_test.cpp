#include "libpipeline/worker_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace pipeline {
namespace {

class WorkerTeamTest : public testing::TestWithParam<int> {};

TEST_P(WorkerTeamTest, DoesEveryTaskOfEveryJobOnce) {
  WorkerTeam team(GetParam());
  for (int task_count = 0; task_count < 50; ++task_count) {
    std::vector<int> times_done(static_cast<std::size_t>(task_count));
    team.start(task_count, [&](int task) { ++times_done[static_cast<std::size_t>(task)]; });
    team.finish();
    EXPECT_EQ(times_done, std::vector<int>(static_cast<std::size_t>(task_count), 1));
  }
}

TEST_P(WorkerTeamTest, FinishesWithoutAJob) {
  WorkerTeam team(GetParam());
  team.finish();
  team.finish();
}

TEST_P(WorkerTeamTest, ThrowsWhatATaskThrewAndGoesOnWithTheNextJob) {
  WorkerTeam team(GetParam());
  team.start(10, [](int task) {
    if (task == 3) throw std::runtime_error("task 3");
  });
  EXPECT_THROW(team.finish(), std::runtime_error);
  std::atomic<int> done_count = 0;
  team.start(10, [&](int) { ++done_count; });
  team.finish();
  EXPECT_EQ(done_count, 10);
}

TEST_P(WorkerTeamTest, MayBeDestroyedInTheMiddleOfAJob) {
  std::atomic<int> done_count = 0;
  {
    WorkerTeam team(GetParam());
    team.start(1000, [&](int) { ++done_count; });
  }
  EXPECT_LE(done_count, 1000);
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkerTeamTest, testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace pipeline
