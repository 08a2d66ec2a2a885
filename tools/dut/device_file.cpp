#include "dut/device_file.hpp"

#include <algorithm>
#include <vector>

#include "io/json_members.hpp"

namespace hmlfc::lockstep {

using io::Members;

namespace {

constexpr io::JsonLimits kDeviceLimits{"a capability file", size_t{1} << 16, 3};

}  // namespace

enum class StageNumber : uint8_t {};  // in kStageNames

static void visit(const Members& m, StageNumber& stage) { m.as_name(stage, kStageNames); }

static void visit(const Members& m, Device& device) {
  std::vector<StageNumber> stages;
  std::string comment;
  m.given("comment", comment);
  m.given("name", device.name);
  m("profile", device.claims.profile);
  visit(m, device.claims);
  m.given("rgb", device.rgb);
  m.given("stop_levels", device.stop_levels);
  m.given("stages", stages);
  m.given("every_stage", device.every_stage);
  m.given("held_chroma", device.held_chroma);
  m.given("tagged", device.tagged);
  m.given("bus_errors", device.bus_errors);
  m.given("checks_sections", device.checks_sections);
  m.refuse_others("the capability file");
  for (const StageNumber stage : stages) device.stages[static_cast<size_t>(stage)] = true;
}

bool Device::shows_stages() const {
  return std::ranges::any_of(stages, [](bool shown) { return shown; });
}

io::IoResult<Device> read_device(const std::filesystem::path& file) {
  auto json = io::read_json_file<Members::Json>(file, kDeviceLimits);
  if (!json) return tl::unexpected(json.error());
  try {
    Device device;
    visit(Members(*json, true), device);
    return device;
  } catch (const io::TextError& error) {
    return io::file_error(file, error.what());
  }
}

}  // namespace hmlfc::lockstep
