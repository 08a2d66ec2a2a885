#include "bits/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace hmlfc {
namespace {

// The threads that ran a loop of many short pieces.
std::set<std::thread::id> threads_of_a_loop() {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  parallel_for(64, [&](size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::scoped_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  return threads;
}

TEST(Parallel, CallsTheBodyOnceForEachIndexInNestedLoops) {
  std::vector<std::atomic<int>> calls(7 * 11);
  parallel_for(7, [&](size_t i) { parallel_for(11, [&](size_t j) { ++calls[i * 11 + j]; }); });
  EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const auto& n) { return n == 1; }));
  parallel_for(0, [](size_t) { FAIL() << "there is nothing to do"; });
}

TEST(Parallel, PartsCoverTheRangeOnce) {
  for (const size_t count : {0u, 1u, 15u, 16u, 17u, 100u}) {
    std::vector<std::atomic<int>> calls(count);
    parallel_for_parts(count, 16, [&](size_t begin, size_t end) {
      EXPECT_LT(begin, end);
      for (size_t i = begin; i < end; ++i) ++calls[i];
    });
    EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const auto& n) { return n == 1; }));
  }
}

TEST(Parallel, ThrowsTheExceptionOfABody) {
  EXPECT_THROW(parallel_for(100,
                            [](size_t i) {
                              if (i == 61) throw std::runtime_error("61");
                            }),
               std::runtime_error);
}

TEST(Parallel, UsesTheThreadsItIsGiven) {
  const ThreadLimit three(3);
  run_on_threads(3, [] {
    size_t most = 0;
    // On a busy machine a second thread may come too late for one loop.
    for (int loop = 0; loop < 100 && most < 2; ++loop) {
      most = std::max(most, threads_of_a_loop().size());
      EXPECT_LE(most, 3u);
    }
    EXPECT_GE(most, 2u);
  });
  run_on_threads(1, [] {
    EXPECT_EQ(threads_of_a_loop(), std::set<std::thread::id>{std::this_thread::get_id()});
  });
  const ThreadLimit one(1);
  EXPECT_EQ(threads_of_a_loop(), std::set<std::thread::id>{std::this_thread::get_id()});
}

}  // namespace
}  // namespace hmlfc
