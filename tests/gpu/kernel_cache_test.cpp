// Compiled kernels in a file: what is read is what this driver wrote, or nothing.
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

#include <gtest/gtest.h>

#include "device/device_state.hpp"
#include "device/kernel_cache.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::gpu {
namespace {

vk::PhysicalDeviceProperties device_of(uint32_t vendor, uint8_t version) {
  vk::PhysicalDeviceProperties properties;
  properties.vendorID = vendor;
  properties.deviceID = 7;
  properties.pipelineCacheUUID.fill(version);
  return properties;
}

// What a driver gives: its header, then `bytes` bytes `value`.
std::vector<uint8_t> data_of(const vk::PhysicalDeviceProperties& device, size_t bytes,
                             uint8_t value) {
  VkPipelineCacheHeaderVersionOne header{};
  header.headerSize = sizeof(header);
  header.headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE;
  header.vendorID = device.vendorID;
  header.deviceID = device.deviceID;
  std::memcpy(header.pipelineCacheUUID, device.pipelineCacheUUID.data(), VK_UUID_SIZE);
  std::vector<uint8_t> data(sizeof(header) + bytes, value);
  std::memcpy(data.data(), &header, sizeof(header));
  return data;
}

std::vector<char> content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void replace(const std::filesystem::path& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

class GpuKernelCache : public testing::Test {
 protected:
  test::TempFolder folder_;
  vk::PhysicalDeviceProperties device_ = device_of(1, 1);
  KernelCacheFile file_{folder_.path() / "new" / "folder", device_};
};

TEST_F(GpuKernelCache, GivesWhatWasWrittenAndLeavesOneFile) {
  EXPECT_TRUE(file_.read().empty());
  for (const uint8_t value : {uint8_t{1}, uint8_t{2}}) {
    const auto data = data_of(device_, 1000, value);
    EXPECT_TRUE(file_.write(data));
    EXPECT_EQ(file_.read(), data);
  }
  const std::filesystem::directory_iterator files(file_.path().parent_path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST_F(GpuKernelCache, OfAnotherDriverIsNone) {
  ASSERT_TRUE(file_.write(data_of(device_, 10, 1)));
  const KernelCacheFile updated(file_.path().parent_path(), device_of(1, 2));
  EXPECT_EQ(updated.path(), file_.path());
  EXPECT_TRUE(updated.read().empty());
  EXPECT_NE(KernelCacheFile(file_.path().parent_path(), device_of(2, 1)).path(), file_.path());
  // Written under this device's name, with the header of another one.
  EXPECT_TRUE(file_.write(data_of(device_of(2, 1), 10, 1)));
  EXPECT_TRUE(file_.read().empty());
}

// Each byte changed, and each length too short.
TEST_F(GpuKernelCache, ThatIsDamagedIsNone) {
  ASSERT_TRUE(file_.write(data_of(device_, 10, 1)));
  const auto whole = content(file_.path());
  for (size_t i = 0; i < whole.size(); ++i) {
    auto damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    replace(file_.path(), damaged);
    EXPECT_TRUE(file_.read().empty()) << "byte " << i;
    damaged = whole;
    damaged.resize(i);
    replace(file_.path(), damaged);
    EXPECT_TRUE(file_.read().empty()) << "length " << i;
  }
}

TEST_F(GpuKernelCache, ThatCannotBeWrittenIsNoError) {
  const auto data = data_of(device_, 10, 1);
  replace(folder_.path() / "file", {'a'});
  const KernelCacheFile below_a_file(folder_.path() / "file", device_);
  EXPECT_FALSE(below_a_file.write(data));
  EXPECT_TRUE(below_a_file.read().empty());
  const KernelCacheFile none({}, device_);
  EXPECT_FALSE(none.write(data));
  EXPECT_TRUE(none.read().empty());
}

TEST_F(GpuKernelCache, IsWholeWhoeverWrites) {
  ASSERT_TRUE(file_.write(data_of(device_, 0, 0)));
  std::atomic<int> writing = 4;
  std::vector<std::thread> writers;
  for (uint8_t writer = 1; writer <= 4; ++writer) {
    writers.emplace_back([&, writer] {
      for (size_t i = 0; i < 50; ++i) file_.write(data_of(device_, 50000u * writer, writer));
      --writing;
    });
  }
  while (writing > 0) {
    const auto data = file_.read();
    EXPECT_FALSE(data.empty());
    if (data.empty()) break;
    EXPECT_EQ(data, data_of(device_, data.size() - 32, data.size() == 32 ? 0 : data.back()));
  }
  for (std::thread& writer : writers) writer.join();
}

// The environment for one test.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value == nullptr ? unsetenv(name) : setenv(name, value, 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(GpuKernelCacheFolder, FollowsTheEnvironment) {
  const Variable home("HOME", "/home/someone");
  {
    const Variable caches("XDG_CACHE_HOME", "/caches");
    EXPECT_EQ(default_cache_folder(), "/caches/hmlfc");
  }
  for (const char* unusable : {"", "relative", static_cast<const char*>(nullptr)}) {
    const Variable caches("XDG_CACHE_HOME", unusable);
    EXPECT_EQ(default_cache_folder(), "/home/someone/.cache/hmlfc");
    const Variable nowhere("HOME", unusable);
    EXPECT_TRUE(default_cache_folder().empty());
  }
}

// The bytes that the driver keeps after the kernels of `use`, in `folder`; 0 where there is none.
// On Mesa's null device, since lavapipe keeps nothing.
size_t kept_bytes(const std::filesystem::path& folder, KernelUse use) {
  const Variable family("RADV_FORCE_FAMILY", "fiji");
  DeviceOptions options;
  options.device = "FIJI";
  options.cache_folder = folder.string();
  auto device = Device::open(options);
  if (!device) return 0;
  Device::State& state = device->state();
  state.kernels->prepare(use, false);
  return KernelCacheFile(folder, state.physical->getProperties()).read().size();
}

TEST(GpuKernelCacheOfADriver, HasTheKernelsOfProcessesBefore) {
  const test::TempFolder first;
  const test::TempFolder second;
  const size_t references = kept_bytes(first.path(), KernelUse::kReferences);
  if (references == 0) GTEST_SKIP() << "the driver RADV is missing (Debian: mesa-vulkan-drivers)";
  const size_t frames = kept_bytes(second.path(), KernelUse::kFrames);
  EXPECT_GT(references, 1000u);
  EXPECT_GT(frames, references);
  // Drivers may write what they keep a little otherwise the second time.
  const auto is_kept = [&](size_t before) {
    const size_t bytes = kept_bytes(first.path(), KernelUse::kReferences);
    return bytes >= before && bytes < before + before / 50;
  };
  EXPECT_TRUE(is_kept(references));
  const size_t both = kept_bytes(first.path(), KernelUse::kFrames);
  EXPECT_GT(both, frames + references / 2);
  EXPECT_TRUE(is_kept(both));
}

}  // namespace
}  // namespace hmlfc::gpu
