#include "gpu/gpu_test.hpp"

#include <cstdlib>

#include "decoder/open_stream.hpp"
#include "gpu/kernel_files.hpp"

namespace hmlfc::gpu {
namespace {

DeviceOptions with_environment(DeviceOptions options, bool check_barriers) {
  const char* name = std::getenv("HMLFC_GPU_DEVICE");
  if (name != nullptr) options.device = name;
  const char* kernels = std::getenv("HMLFC_GPU_KERNELS");
  if (kernels != nullptr) options.kernels = read_kernels(kernels);
  options.check_barriers = check_barriers;
  options.cache_folder = "";  // tests leave nothing behind
  return options;
}

std::optional<Device> opened(const DeviceOptions& options) {
  auto device = Device::open(options);
  if (device) return std::move(*device);
  ADD_FAILURE() << device.error().message;
  return std::nullopt;
}

Outcome<Device>& shared_device() {
  static Outcome<Device> device = Device::open(with_environment({}, true));
  return device;
}

// The requests at the borders, then those of all kinds.
tb::RequestSource requests_of(const tb::GoldenStream& stream, const CheckPlan& plan) {
  const Geometry& geometry = stream.geometry();
  const StreamHeader& header = stream.header();
  std::vector<tb::Request> requests;
  if (plan.borders) requests = tb::border_requests(geometry, header);
  if (plan.borders) {
    const auto bad = tb::bad_requests(geometry, header);
    requests.insert(requests.end(), bad.begin(), bad.end());
  }
  const auto mixed = tb::mixed_requests(geometry, header, plan.requests, plan.seed, 30);
  while (const auto request = mixed()) requests.push_back(*request);
  return tb::listed_requests(std::move(requests));
}

}  // namespace

void GpuTest::SetUp() {
  if (!shared_device()) GTEST_SKIP() << shared_device().error().message;
}

std::optional<Device> GpuTest::open(DeviceOptions options) {
  return opened(with_environment(std::move(options), true));
}

std::optional<Device> GpuTest::open_unchecked(DeviceOptions options) {
  return opened(with_environment(std::move(options), false));
}

Device& GpuTest::device() { return *shared_device(); }

std::optional<CheckResult> check_bytes(Device& device, std::span<const uint8_t> device_bytes,
                                       std::span<const uint8_t> model_bytes,
                                       const CheckPlan& plan) {
  OpenOptions options;
  options.check_sections = false;
  const auto view = open_stream(device_bytes, options);
  if (!view) return std::nullopt;
  const auto stream = tb::GoldenStream::open(model_bytes, {view->header.block_log2, 12, 16, 16});
  if (!stream) return std::nullopt;
  auto decoder = GpuDecoder::open(device, *view);
  if (!decoder) {
    ADD_FAILURE() << decoder.error().message;
    return std::nullopt;
  }
  decoder->limit_submissions(plan.blocks_at_once);
  CheckOptions check;
  check.stages = plan.stages;
  auto result = check_stream(*decoder, **stream, requests_of(**stream, plan), check);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return std::nullopt;
  }
  return *result;
}

CheckCounts expect_equal(Device& device, std::span<const uint8_t> bytes, const CheckPlan& plan) {
  const auto result = check_bytes(device, bytes, bytes, plan);
  if (!result) return {};
  if (result->mismatch) ADD_FAILURE() << to_string(*result->mismatch);
  return result->counts;
}

CheckCounts expect_scan_equal(GpuDecoder& decoder, std::span<const uint8_t> bytes,
                              const tb::ScanPlan& plan) {
  const unsigned block_log2 = bytes[30];  // FIL-1
  const auto stream = tb::GoldenStream::open(bytes, {block_log2, 12, 16, 16}).value();
  const auto source = tb::scan_requests(stream->geometry(), stream->header(), plan);
  const auto result = check_stream(decoder, *stream, source, {});
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  EXPECT_FALSE(result->mismatch) << to_string(*result->mismatch);
  EXPECT_EQ(result->counts.failed(), 0u);
  return result->counts;
}

}  // namespace hmlfc::gpu
