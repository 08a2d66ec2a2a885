#include "gpu/stream_check.hpp"

#include <algorithm>
#include <vector>

#include "bits/parallel.hpp"
#include "gpu/gpu_answers.hpp"
#include "oracle/oracle.hpp"

namespace hmlfc::gpu {
namespace {

constexpr size_t kRequestsAtOnce = 1 << 15;
constexpr size_t kRequestsPerTask = 1024;

std::string quoted(const tb::Difference& difference) {
  return difference.stage + ": " + difference.field + ": expected " +
         std::to_string(difference.expected) + ", actual " + std::to_string(difference.actual);
}

std::string status_difference(uint8_t expected, uint8_t actual) {
  return "status: expected " + tb::status_name(expected) + ", actual " + tb::status_name(actual);
}

// What the model says about the requests, on all cores.
std::vector<tb::ExpectedAnswer> expected_answers(const tb::GoldenStream& stream,
                                                 std::span<const tb::Request> requests) {
  std::vector<tb::ExpectedAnswer> expected(requests.size());
  const size_t tasks = (requests.size() + kRequestsPerTask - 1) / kRequestsPerTask;
  parallel_for(tasks, [&](size_t task) {
    tb::Oracle oracle(stream);
    const size_t end = std::min(requests.size(), (task + 1) * kRequestsPerTask);
    for (size_t i = task * kRequestsPerTask; i < end; ++i) {
      expected[i] = oracle.evaluate(requests[i]);
    }
  });
  return expected;
}

// The difference of an answer, or nothing.
std::optional<std::string> answer_difference(const tb::ExpectedAnswer& expected,
                                             const tb::Answer& actual, unsigned block_size) {
  if (expected.answer.status != actual.status) {
    return status_difference(expected.answer.status, actual.status);
  }
  const size_t lane = size_t{block_size} * block_size;
  const size_t lanes = expected.request.plane == tb::kRgb ? tb::kLanes : 1;
  for (size_t c = 0; c < lanes; ++c) {
    const unsigned columns = actual.status == 0 ? expected.inside_x : block_size;
    const unsigned rows = actual.status == 0 ? expected.inside_y : block_size;
    const auto difference =
        tb::first_difference(expected.answer.samples.data() + c * lane,
                             actual.samples.data() + c * lane, "answer", block_size, columns, rows);
    if (difference) return quoted(*difference) + " of lane " + std::to_string(c);
  }
  return std::nullopt;
}

// The records of the levels, one by one. Levels below one with an error have no record here.
std::optional<Mismatch> trace_difference(const tb::Request& request,
                                         const tb::ExpectedAnswer& expected, const GpuTrace& actual,
                                         unsigned block_size, CheckCounts& counts) {
  const auto& levels = expected.planes[0]->levels;
  for (size_t i = 0; i < levels.size(); ++i) {
    const std::string place = tb::to_string(levels[i].site);
    if (i >= actual.levels.size() || actual.levels[i].site.level != levels[i].site.level) {
      return Mismatch{request, place, "no record of this level"};
    }
    const auto difference = tb::first_difference(levels[i], actual.levels[i], block_size,
                                                 expected.inside_x, expected.inside_y);
    if (difference) return Mismatch{request, place, quoted(*difference)};
    ++counts.levels;
    if (levels[i].error != 0) break;
  }
  return std::nullopt;
}

class StreamCheck {
 public:
  StreamCheck(GpuDecoder& decoder, const tb::GoldenStream& stream, const CheckOptions& options)
      : decoder_(decoder),
        stream_(stream),
        options_(options),
        block_size_(stream.geometry().block_size()) {}

  // Compares some requests; whether to go on.
  Outcome<bool> compare(std::span<const tb::Request> requests) {
    result_.counts.sent += requests.size();
    const auto expected = expected_answers(stream_, requests);
    const auto answers = gpu_answers(decoder_, block_size_, requests);
    if (!answers) return tl::unexpected(answers.error());
    for (size_t i = 0; i < requests.size(); ++i) {
      auto difference = answer_difference(expected[i], (*answers)[i], block_size_);
      if (difference) {
        result_.mismatch = Mismatch{requests[i], {}, *difference};
        break;
      }
      ++result_.counts.compared;
      ++result_.counts.statuses[(*answers)[i].status];
    }
    if (!options_.stages) return !result_.mismatch;
    return compare_stages(expected);
  }

  CheckResult result() const { return result_; }

 private:
  // The planes of a request that the model decoded, as requests of their own.
  void add_planes(const tb::ExpectedAnswer& expected, std::vector<tb::Request>& requests,
                  std::vector<tb::ExpectedAnswer>& answers) {
    for (size_t p = 0; p < expected.planes.size(); ++p) {
      if (!expected.planes[p]) continue;
      const BlockSite& site = expected.planes[p]->levels.back().site;
      const PlaneShape& shape = stream_.geometry().plane(site.plane);
      tb::ExpectedAnswer own;
      own.planes[0] = expected.planes[p];
      own.inside_x = tb::inside(shape.width, site.bx, block_size_);
      own.inside_y = tb::inside(shape.height, site.by, block_size_);
      tb::Request request = expected.request;
      request.plane = static_cast<unsigned>(site.plane);
      request.bx = site.bx;
      request.by = site.by;
      requests.push_back(request);
      answers.push_back(own);
    }
  }

  // The first stage that differs explains an answer that does, so its message wins.
  Outcome<bool> compare_stages(std::span<const tb::ExpectedAnswer> expected) {
    std::vector<tb::Request> planes;
    std::vector<tb::ExpectedAnswer> wanted;
    for (const tb::ExpectedAnswer& answer : expected) add_planes(answer, planes, wanted);
    const auto traces = gpu_traces(decoder_, planes);
    if (!traces) return tl::unexpected(traces.error());
    for (size_t i = 0; i < planes.size(); ++i) {
      auto difference =
          trace_difference(planes[i], wanted[i], (*traces)[i], block_size_, result_.counts);
      if (!difference) continue;
      result_.mismatch = difference;
      break;
    }
    return !result_.mismatch;
  }

  GpuDecoder& decoder_;
  const tb::GoldenStream& stream_;
  const CheckOptions& options_;
  unsigned block_size_;
  CheckResult result_;
};

}  // namespace

CheckCounts& CheckCounts::operator+=(const CheckCounts& other) {
  sent += other.sent;
  compared += other.compared;
  levels += other.levels;
  for (size_t i = 0; i < statuses.size(); ++i) statuses[i] += other.statuses[i];
  return *this;
}

std::string to_string(const Mismatch& mismatch) {
  std::string text = tb::to_string(mismatch.request);
  if (!mismatch.place.empty()) text += ": at " + mismatch.place;
  return text + ": " + mismatch.detail;
}

Outcome<CheckResult> check_stream(GpuDecoder& decoder, const tb::GoldenStream& stream,
                                  const tb::RequestSource& source, const CheckOptions& options) {
  StreamCheck check(decoder, stream, options);
  std::vector<tb::Request> requests;
  bool more = true;
  while (more) {
    requests.clear();
    while (requests.size() < kRequestsAtOnce) {
      const auto request = source();
      if (!request) break;
      requests.push_back(*request);
    }
    if (requests.empty()) break;
    const auto good = check.compare(requests);
    if (!good) return tl::unexpected(good.error());
    more = *good;
    if (options.progress) options.progress(check.result().counts.compared);
  }
  return check.result();
}

}  // namespace hmlfc::gpu
