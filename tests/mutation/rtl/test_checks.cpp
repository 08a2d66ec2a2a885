#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

#include <gtest/gtest.h>

#include "check.hpp"

namespace hmlfc::tb {
namespace {

// A test says no clocks: as if it had so many.
constexpr uint64_t kClocks = 6'000;
constexpr rlim_t kSeconds = 20;  // of CPU time; the longest takes a third of that

class TestCheck final : public Check {
 public:
  explicit TestCheck(std::string name) : name_(std::move(name)) {}

  const std::string& id() const override { return name_; }
  uint64_t size() const override { return kClocks; }

  Verdict run(uint64_t& clocks) override {
    clocks = kClocks;
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("a process for " + name_ + " cannot be started");
    if (child == 0) run_test();
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    const bool hangs = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
    return {hangs, hangs ? "takes too long" : "fails"};
  }

 private:
  // In the child.
  [[noreturn]] void run_test() const {
    const rlimit limit{kSeconds, kSeconds + 1};
    setrlimit(RLIMIT_CPU, &limit);
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    GTEST_FLAG_SET(filter, name_);
    _exit(RUN_ALL_TESTS());
  }

  std::string name_;
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
