#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>

#include <gtest/gtest.h>

#include "check.hpp"

namespace hmlfc::tb {
namespace {

// A test says no clocks: as if it had so many.
constexpr uint64_t kClocks = 6'000;
// CPU time after which a test hangs that has passed: so many times what that took, and the least.
constexpr double kTimesAsLong = 4;
constexpr double kLeastSeconds = 0.5;
constexpr double kFirstSeconds = 60;

class TestCheck final : public Check {
 public:
  explicit TestCheck(std::string name) : name_(std::move(name)) {}

  const std::string& id() const override { return name_; }
  uint64_t size() const override { return kClocks; }

  Verdict run(uint64_t& clocks) override {
    clocks = kClocks;
    const double before = seconds_of_children();
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("a process for " + name_ + " cannot be started");
    if (child == 0) run_test();
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      limit_ = std::min(limit_, kTimesAsLong * (seconds_of_children() - before) + kLeastSeconds);
      return {};
    }
    const bool hangs = WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF;
    return {hangs, hangs ? "takes too long" : "fails"};
  }

 private:
  static double seconds_of_children() {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    const auto seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
  }

  // In the child.
  [[noreturn]] void run_test() const {
    const auto whole = static_cast<time_t>(limit_);
    const itimerval limit{
        {}, {whole, static_cast<suseconds_t>(1e6 * (limit_ - static_cast<double>(whole)))}};
    setitimer(ITIMER_PROF, &limit, nullptr);
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    GTEST_FLAG_SET(filter, name_);
    _exit(RUN_ALL_TESTS());
  }

  std::string name_;
  double limit_ = kFirstSeconds;
};

}  // namespace

std::vector<std::unique_ptr<Check>> test_checks(std::string_view part) {
  int count = 1;
  char program[] = "rtl_mutants";
  char* arguments[]{program, nullptr};
  testing::InitGoogleTest(&count, arguments);
  std::vector<std::unique_ptr<Check>> found;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    if (std::string_view(suite.name()).find(part) == std::string_view::npos) continue;
    for (int k = 0; k < suite.total_test_count(); ++k) {
      found.push_back(std::make_unique<TestCheck>(std::string(suite.name()) + "." +
                                                  suite.GetTestInfo(k)->name()));
    }
  }
  return found;
}

}  // namespace hmlfc::tb
