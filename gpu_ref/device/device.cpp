#include <hmlfc/gpu/device.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>

#include "device_state.hpp"
#include "kept_messages.hpp"

namespace hmlfc::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr uint64_t kMaxChunkBytes = uint64_t{1} << 34;
constexpr uint64_t kMinChunkBytes = 64;

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

constexpr const char* kNoVulkan =
    "no Vulkan on this machine: install a driver (on Debian mesa-vulkan-drivers, which needs no "
    "GPU)";

bool has_layer(const vk::raii::Context& context, const std::string& name) {
  const auto layers = context.enumerateInstanceLayerProperties();
  return std::ranges::any_of(
      layers, [&](const vk::LayerProperties& layer) { return name == layer.layerName.data(); });
}

void make_instance(Device::State& state, bool validation) {
  std::vector<const char*> layers;
  std::vector<const char*> extensions;
  if (validation) {
    if (!has_layer(state.context, kValidationLayer)) {
      throw MachineError(
          FailureKind::kUnusable,
          "the Vulkan validation layer is missing (Debian: vulkan-validationlayers)");
    }
    layers.push_back(kValidationLayer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  const vk::ApplicationInfo application("hmlfc", 1, nullptr, 0, VK_API_VERSION_1_2);
  const auto synchronisation = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  const vk::ValidationFeaturesEXT features(synchronisation);
  vk::InstanceCreateInfo info({}, &application, layers, extensions);
  if (validation) info.setPNext(&features);
  try {
    state.instance.emplace(state.context, info);
  } catch (const vk::IncompatibleDriverError&) {  // there is no driver
    throw MachineError(FailureKind::kUnusable, kNoVulkan);
  }
  if (!validation) return;
  state.messenger.emplace(*state.instance, keep_messages(state.messages));
}

std::optional<uint32_t> compute_family(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  for (uint32_t i = 0; i < families.size(); ++i) {
    if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
  }
  return std::nullopt;
}

std::string missing_of(const vk::raii::PhysicalDevice& physical) {
  if (physical.getProperties().apiVersion < VK_API_VERSION_1_2) return "Vulkan 1.2";
  if (!compute_family(physical)) return "a queue for compute";
  const auto features = physical.getFeatures2<vk::PhysicalDeviceFeatures2,
                                              vk::PhysicalDeviceBufferDeviceAddressFeatures>();
  const auto& addresses = features.get<vk::PhysicalDeviceBufferDeviceAddressFeatures>();
  if (addresses.bufferDeviceAddress == VK_FALSE) return "bufferDeviceAddress";
  return {};
}

using Type = vk::PhysicalDeviceType;
// The best first.
constexpr std::array<std::pair<Type, const char*>, 5> kKinds = {
    {{Type::eDiscreteGpu, "discrete GPU"},
     {Type::eIntegratedGpu, "integrated GPU"},
     {Type::eVirtualGpu, "virtual GPU"},
     {Type::eCpu, "CPU"},
     {Type::eOther, "other"}}};

size_t kind_rank(Type type) {
  const auto found = std::ranges::find(kKinds, type, &std::pair<Type, const char*>::first);
  return found == kKinds.end() ? kKinds.size() - 1 : static_cast<size_t>(found - kKinds.begin());
}

size_t rank_of(const DeviceInfo& device) {
  const auto found =
      std::ranges::find_if(kKinds, [&](const auto& kind) { return device.kind == kind.second; });
  return static_cast<size_t>(found - kKinds.begin());
}

std::vector<DeviceInfo> infos(const std::vector<vk::raii::PhysicalDevice>& devices) {
  std::vector<DeviceInfo> list;
  std::ranges::transform(devices, std::back_inserter(list), info_of);
  return list;
}

bool has_extension(const vk::raii::PhysicalDevice& physical, const std::string& name) {
  const auto extensions = physical.enumerateDeviceExtensionProperties();
  return std::ranges::any_of(extensions, [&](const vk::ExtensionProperties& extension) {
    return name == extension.extensionName.data();
  });
}

// The extensions that `options` take.
std::vector<const char*> extensions_of(const Device::State& state, const DeviceOptions& options) {
  if (!options.guard_pages) return {};
  constexpr const char* kHostMemory = VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME;
  if (!has_extension(*state.physical, kHostMemory)) {
    throw MachineError(FailureKind::kUnusable, state.info.name + " has no " + kHostMemory);
  }
  return {kHostMemory};
}

void make_device(Device::State& state, const DeviceOptions& options) {
  const auto extensions = extensions_of(state, options);
  const uint32_t family = *compute_family(*state.physical);
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
  // Everything but addresses stays off, robustBufferAccess too: no kernel leans on it.
  vk::PhysicalDeviceBufferDeviceAddressFeatures addresses(VK_TRUE);
  state.device.emplace(*state.physical,
                       vk::DeviceCreateInfo({}, queue, {}, extensions, {}, &addresses));
  state.queue.emplace(*state.device, family, 0);
  complete(state, family, options);
}

void set_limits(Device::State& state, uint64_t chunk_bytes) {
  const auto properties =
      state.physical->getProperties2<vk::PhysicalDeviceProperties2,
                                     vk::PhysicalDeviceMaintenance3Properties>();
  const uint64_t allocation =
      properties.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
  // Kernels reach buffers by address: the limit of a binding does not count.
  state.max_buffer_bytes = allocation;
  const uint64_t most = std::min(kMaxChunkBytes, std::bit_floor(state.max_buffer_bytes));
  if (chunk_bytes != 0 && (!std::has_single_bit(chunk_bytes) || chunk_bytes < kMinChunkBytes)) {
    throw MachineError(FailureKind::kUnusable,
                       "chunk_bytes is a power of two, at least " + std::to_string(kMinChunkBytes));
  }
  state.chunk_bytes = chunk_bytes == 0 ? most : std::min(chunk_bytes, most);
}

std::shared_ptr<Device::State> open_state(const DeviceOptions& options) {
  auto state = make_state();
  make_instance(*state, options.validation);
  auto devices = state->instance->enumeratePhysicalDevices();
  const std::vector<DeviceInfo> list = infos(devices);
  const size_t chosen = choose_device(list, options.device);
  if (chosen == list.size()) {
    const std::string which = options.device.empty() ? std::string("that can run the decoder")
                                                     : "\"" + options.device + "\"";
    std::string names;
    for (const DeviceInfo& info : list) names += (names.empty() ? "" : ", ") + info.name;
    throw MachineError(FailureKind::kUnusable,
                       "no Vulkan device " + which + "; there are: " +
                           (names.empty() ? "none (Debian: mesa-vulkan-drivers)" : names));
  }
  if (!list[chosen].missing.empty()) {
    throw MachineError(FailureKind::kUnusable,
                       list[chosen].name + " has no " + list[chosen].missing);
  }
  state->physical.emplace(std::move(devices[chosen]));
  state->info = list[chosen];
  state->guard_pages = options.guard_pages;
  make_device(*state, options);
  return state;
}

}  // namespace

// Without the loader's library the context throws.
std::shared_ptr<Device::State> make_state() {
  try {
    return std::make_shared<Device::State>();
  } catch (const std::exception&) {
    throw MachineError(FailureKind::kUnusable, kNoVulkan);
  }
}

DeviceInfo info_of(const vk::raii::PhysicalDevice& physical) {
  const vk::PhysicalDeviceProperties properties = physical.getProperties();
  DeviceInfo info;
  info.name = properties.deviceName.data();
  info.kind = kKinds[kind_rank(properties.deviceType)].second;
  info.missing = missing_of(physical);
  if (properties.apiVersion >= VK_API_VERSION_1_2) {
    const auto driver =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
            .get<vk::PhysicalDeviceDriverProperties>();
    info.driver = std::string(driver.driverName.data()) + " " + driver.driverInfo.data();
  }
  return info;
}

void complete(Device::State& state, uint32_t family, const DeviceOptions& options) {
  state.family = family;
  state.timeout_nanoseconds = static_cast<uint64_t>(options.timeout_seconds * 1e9);
  state.submission_bytes = options.submission_bytes;
  state.upload_bytes = 4 * std::max<uint64_t>(1, options.upload_bytes / 4);
  state.disparity_bytes = options.disparity_bytes;
  if (options.check_barriers) state.hazards.emplace();
  state.pool.emplace(
      *state.device,
      vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer, family));
  state.kernels.emplace(*state.physical, *state.device, options);
  const auto limits = state.physical->getProperties().limits;
  state.max_workgroups = limits.maxComputeWorkGroupCount[0];
  const auto family_properties = state.physical->getQueueFamilyProperties()[family];
  if (family_properties.timestampValidBits != 0) {
    state.timestamp_seconds = static_cast<double>(limits.timestampPeriod) * 1e-9;
    state.timestamp_mask = ~uint64_t{0} >> (64 - family_properties.timestampValidBits);
  }
  set_limits(state, options.chunk_bytes);
}

size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& wanted) {
  size_t number = devices.size();
  const auto [end, error] =
      std::from_chars(wanted.data(), wanted.data() + wanted.size(), number, 10);
  const bool numbered =
      !wanted.empty() && error == std::errc{} && end == wanted.data() + wanted.size();
  size_t best = devices.size();
  for (size_t i = 0; i < devices.size(); ++i) {
    const bool named =
        numbered ? i == number : lower(devices[i].name).find(lower(wanted)) != std::string::npos;
    if (!named || (wanted.empty() && !devices[i].missing.empty())) continue;
    if (best == devices.size() || rank_of(devices[i]) < rank_of(devices[best])) best = i;
  }
  return best;
}

Outcome<std::vector<DeviceInfo>> list_devices() {
  return guard_device([] {
    const auto state = make_state();
    make_instance(*state, false);
    return infos(state->instance->enumeratePhysicalDevices());
  });
}

Device::State::~State() { settle(); }

void Device::State::settle() noexcept {
  if (!lost || abandoned.empty()) return;
  try {
    device->waitIdle();
  } catch (const std::exception&) {
    // A lost device does nothing any more.
  }
  abandoned.clear();
}

Outcome<Device> Device::open(const DeviceOptions& options) {
  return guard_device([&] { return Device(open_state(options)); });
}

const DeviceInfo& Device::info() const { return state_->info; }

const SubmissionCounts& Device::counts() const { return state_->counts; }

const std::vector<std::string>& Device::validation_messages() const { return state_->messages; }

}  // namespace hmlfc::gpu
