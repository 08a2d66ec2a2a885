#include <fmt/format.h>

#include "conform/markup.hpp"
#include "conform/report_files.hpp"

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

std::string test_case(const VectorResult& result) {
  const size_t slash = std::min(result.id.find('/'), result.id.size());
  std::string inner;
  const std::string reason = escaped(result.reason);
  if (result.waived()) {
    inner = fmt::format("<skipped message=\"waived: {}\"/>", escaped(result.waiver));
  } else if (result.status == Status::kFail || result.status == Status::kTimeout) {
    inner = fmt::format("<failure type=\"{}\" message=\"{}\">{}</failure>",
                        status_name(result.status), reason, details(result));
  } else if (result.status == Status::kError) {
    inner = fmt::format("<error type=\"error\" message=\"{}\">{}</error>", reason, details(result));
  } else if (result.status != Status::kPass) {
    inner = fmt::format("<skipped message=\"{}: {}\"/>", status_name(result.status), reason);
  }
  return fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">{}</testcase>\n",
                     escaped(result.id.substr(0, slash)),
                     escaped(result.id.substr(std::min(slash + 1, result.id.size()))),
                     result.seconds, inner);
}

std::string test_suite(const Report& report, const Run& run) {
  const Tally counts = tally(run);
  double seconds = 0;
  for (const VectorResult& result : run.results) seconds += result.seconds;
  std::string text = fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" "
      "time=\"{:.3f}\" timestamp=\"{}\">\n",
      escaped(run.dut), run.results.size(), counts.of(Status::kFail) + counts.of(Status::kTimeout),
      counts.of(Status::kError),
      counts.of(Status::kSkipped) + counts.of(Status::kNotSupported) + counts.waived, seconds,
      escaped(report.system.date));
  for (const VectorResult& result : run.results) text += test_case(result);
  return text + "  </testsuite>\n";
}

}  // namespace

std::string junit_text(const Report& report) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const Run& run : report.runs) text += test_suite(report, run);
  return text + "</testsuites>\n";
}

}  // namespace hmlfc::conform
