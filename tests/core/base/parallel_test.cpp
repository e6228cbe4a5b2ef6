// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace oikos::base {
namespace {

TEST(ParallelFor, CallsEveryIndexOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<std::atomic<int>> calls(1000);
    parallelFor(1000, threads, [&](int i) { ++calls[i]; });
    for (const auto& count : calls) {
      ASSERT_EQ(count, 1);
    }
  }
}

TEST(ParallelFor, DoesNothingForNothing) {
  parallelFor(0, 4, [](int) { FAIL(); });
  parallelFor(-1, 4, [](int) { FAIL(); });
}

TEST(ParallelFor, UsesTheCallingThreadAloneWhenOneIsAllowed) {
  std::set<std::thread::id> users;
  parallelFor(100, 1, [&](int) { users.insert(std::this_thread::get_id()); });
  EXPECT_EQ(users, std::set{std::this_thread::get_id()});
}

TEST(ParallelFor, SlotsReducedInOrderGiveTheSameBitsForAnyThreadCount) {
  const auto sum = [](int threads) {
    std::vector<double> slots(5000);
    parallelFor(5000, threads, [&](int i) { slots[i] = std::sin(i) / (1 + i % 7); });
    return std::accumulate(slots.begin(), slots.end(), 0.0);
  };
  const double expected = sum(1);
  for (const int threads : {2, 3, 4, 16}) {
    EXPECT_EQ(sum(threads), expected) << threads;
  }
}

TEST(ParallelFor, RethrowsTheFailureOfTheLowestIndexAfterAllHaveRun) {
  for (const int threads : {1, 2, 5}) {
    std::atomic<int> calls = 0;
    try {
      parallelFor(100, threads, [&](int i) {
        ++calls;
        if (i % 30 == 17) {
          throw std::runtime_error(std::to_string(i));
        }
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "17");
    }
    EXPECT_EQ(calls, 100);
  }
}

TEST(ParallelFor, NestsAndServesManyCallersAtOnce) {
  std::vector<std::jthread> callers;
  std::atomic<int> calls = 0;
  for (int caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&] {
      for (int round = 0; round < 50; ++round) {
        parallelFor(5, 3, [&](int) { parallelFor(7, 2, [&](int) { ++calls; }); });
      }
    });
  }
  callers.clear();
  EXPECT_EQ(calls, 4 * 50 * 5 * 7);
}

/// More calls than helpers have come to: what they find later belongs to callers that have gone.
TEST(ParallelFor, ShortCallsInARowLeaveNothingBehind) {
  for (int round = 0; round < 20'000; ++round) {
    int slots[3] = {0, 0, 0};
    parallelFor(3, 3, [&](int i) { slots[i] = i + 1; });
    ASSERT_EQ(slots[0] + slots[1] + slots[2], 6);
  }
}

}  // namespace
}  // namespace oikos::base
