#include "conform/dut.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hmlfc::conform {

const Waiver* Dut::waiver(const std::string& id) const {
  const auto found = std::ranges::find(waivers, id, &Waiver::vector);
  return found == waivers.end() ? nullptr : &*found;
}

std::optional<std::string> beyond_claims(const Dut& dut, Profile profile, int level,
                                         const StreamHeader* header) {
  if (profile > dut.profile) return fmt::format("profile {}", profile_name(profile));
  if (level > dut.level) return fmt::format("level {}, above {}", level, dut.level);
  if (header == nullptr) return std::nullopt;
  const DutLimits& limits = dut.limits;
  const auto above = [](const char* field, auto value, auto limit) -> std::optional<std::string> {
    if (value <= limit) return std::nullopt;
    return fmt::format("{} {}, above {}", field, value, limit);
  };
  if (auto what = above("rows", header->rows, limits.rows)) return what;
  if (auto what = above("cols", header->cols, limits.cols)) return what;
  if (auto what = above("width", header->width, limits.width)) return what;
  if (auto what = above("height", header->height, limits.height)) return what;
  if (auto what = above("depth", header->depth, limits.depth)) return what;
  if (auto what = above("tree_height", header->tree_height, limits.tree_height)) return what;
  const auto& logs = limits.block_log2;
  if (std::ranges::find(logs, header->block_log2) == logs.end()) {
    return fmt::format("block_log2 {}", header->block_log2);
  }
  return std::nullopt;
}

}  // namespace hmlfc::conform
