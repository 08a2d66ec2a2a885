#include <fmt/format.h>

#include "conform/report.hpp"

namespace hmlfc::conform {
namespace {

std::string details(const VectorResult& result) {
  std::string text = result.reason;
  if (!result.stage.empty()) text += "\n" + result.stage;
  if (!result.clauses.empty()) text += fmt::format("\nclauses: {}", fmt::join(result.clauses, " "));
  if (!result.comment.empty()) text += "\n" + result.comment;
  if (!result.messages.empty()) text += "\n" + result.messages;
  return escaped(text);
}

// What stands in a test case; nothing where it has passed.
std::string outcome(const VectorResult& result) {
  const std::string reason = escaped(result.reason);
  if (result.waived()) {
    return fmt::format("<skipped message=\"waived: {}\"/>", escaped(result.waiver));
  }
  switch (result.status) {
    case Status::kPass:
      return "";
    case Status::kFail:
    case Status::kTimeout:
      return fmt::format("<failure type=\"{}\" message=\"{}\">{}</failure>",
                         status_name(result.status), reason, details(result));
    case Status::kError:
      return fmt::format("<error type=\"error\" message=\"{}\">{}</error>", reason,
                         details(result));
    default:
      return fmt::format("<skipped message=\"{}: {}\"/>", status_name(result.status), reason);
  }
}

std::string test_suite(const Report& report, const Run& run) {
  const Tally counts = tally(run);
  std::string cases;
  double seconds = 0;
  for (const VectorResult& result : run.results) {
    const std::string& id = result.id.text();
    const size_t slash = id.find('/');
    seconds += result.seconds;
    cases +=
        fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">{}</testcase>\n",
                    id.substr(0, slash), id.substr(slash + 1), result.seconds, outcome(result));
  }
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" "
      "time=\"{:.3f}\" timestamp=\"{}\">\n{}  </testsuite>\n",
      escaped(run.dut), run.results.size(), counts.of(Status::kFail) + counts.of(Status::kTimeout),
      counts.of(Status::kError),
      counts.of(Status::kSkipped) + counts.of(Status::kNotSupported) + counts.waived, seconds,
      escaped(report.system.date), cases);
}

}  // namespace

std::string junit_text(const Report& report) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const Run& run : report.runs) text += test_suite(report, run);
  return text + "</testsuites>\n";
}

}  // namespace hmlfc::conform
