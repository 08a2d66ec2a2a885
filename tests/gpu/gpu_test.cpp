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

// Every buffer ends at a guarded page, where the device has that: an access past its end ends the
// process.
Outcome<Device> open_guarded(const DeviceOptions& asked) {
  DeviceOptions options = with_environment(asked, true);
  options.guard_pages = true;
  if (auto guarded = Device::open(options)) return guarded;
  options.guard_pages = false;
  return Device::open(options);
}

std::optional<Device> opened(Outcome<Device> device) {
  if (device) return std::move(*device);
  ADD_FAILURE() << device.error().message;
  return std::nullopt;
}

Outcome<Device>& shared_device() {
  static Outcome<Device> device = open_guarded({});
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

CheckCounts expect_no_mismatch(const Outcome<CheckResult>& result) {
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  if (result->mismatch) ADD_FAILURE() << to_string(*result->mismatch);
  return result->counts;
}

}  // namespace

void GpuTest::SetUp() {
  if (!shared_device()) GTEST_SKIP() << shared_device().error().message;
}

std::optional<Device> GpuTest::open(const DeviceOptions& options) {
  return opened(open_guarded(options));
}

std::optional<Device> GpuTest::open_unchecked(DeviceOptions options) {
  return opened(Device::open(with_environment(std::move(options), false)));
}

std::optional<Device> GpuTest::open_validated() {
  DeviceOptions options;
  options.validation = true;
  auto device = open_guarded(options);
  const bool missing =
      !device && device.error().message.find("validation layer") != std::string::npos;
  return missing ? open({}) : opened(std::move(device));
}

Device& GpuTest::device() { return *shared_device(); }

CheckCounts expect_equal(Device& device, std::span<const uint8_t> bytes, const CheckPlan& plan) {
  OpenOptions options;
  options.check_sections = false;
  const auto view = open_stream(bytes, options);
  if (!view) return {};
  const auto stream = tb::GoldenStream::open(bytes, {view->header.block_log2, 12, 16, 16});
  if (!stream) return {};
  auto decoder = GpuDecoder::open(device, *view);
  if (!decoder) {
    ADD_FAILURE() << decoder.error().message;
    return {};
  }
  decoder->limit_submissions(plan.blocks_at_once);
  return expect_no_mismatch(check_stream(*decoder, **stream, requests_of(**stream, plan), {}));
}

CheckCounts expect_scan_equal(GpuDecoder& decoder, std::span<const uint8_t> bytes,
                              const tb::ScanPlan& plan) {
  const unsigned block_log2 = bytes[30];  // FIL-1
  const auto stream = tb::GoldenStream::open(bytes, {block_log2, 12, 16, 16}).value();
  const auto source = tb::scan_requests(stream->geometry(), stream->header(), plan);
  const CheckCounts counts = expect_no_mismatch(check_stream(decoder, *stream, source, {}));
  EXPECT_EQ(counts.failed(), 0u);
  return counts;
}

}  // namespace hmlfc::gpu
