#include "systemc/cross_coverage.hpp"

#include <string_view>

#include "oracle/request.hpp"

namespace hmlfc::tb {
namespace {

constexpr std::array<std::string_view, 4> kStatusKinds{"no error", "bad_request", "bus_error",
                                                       "error of a block"};

size_t kind_of_status(uint8_t status) {
  if (status == 0) return 0;
  if (status == static_cast<uint8_t>(ErrorCode::kBadRequest)) return 1;
  return status == kBusError ? 2 : 3;
}

}  // namespace

BlockKinds kind_of_block(const LevelRecord& block) {
  const unsigned state = block.key ? 4 : static_cast<unsigned>(block.state());
  return static_cast<BlockKinds>(1u << (2 * state + (block.site.plane == Plane::kY ? 0 : 1)));
}

void CrossCoverage::on_answer(uint8_t status, BlockKinds shown, const StreamHeader& header,
                              bool waited) {
  const size_t stream = (header.block_log2 - 1) * 4 + static_cast<size_t>(header.profile) * 2 +
                        static_cast<size_t>(header.chroma_format);
  auto& hits = hits_[stream][waited ? 1 : 0];
  ++hits[kBlockKinds + kind_of_status(status)];
  for (size_t kind = 0; kind < kBlockKinds; ++kind) hits[kind] += shown >> kind & 1;
}

std::vector<NamedCount> CrossCoverage::all() const {
  std::vector<NamedCount> all;
  for (size_t s = 0; s < kStreams; ++s) {
    const std::string stream = "B " + std::to_string(2u << s / 4) + ", " +
                               std::string(profile_name(static_cast<Profile>(s / 2 % 2))) +
                               (s % 2 == 0 ? ", 4:2:0" : ", 4:4:4");
    for (size_t waited = 0; waited < 2; ++waited) {
      for (size_t i = 0; i < kBlockKinds + kStatuses; ++i) {
        const std::string what =
            i < kBlockKinds ? std::string(i / 2 == 4 ? "key" : state_name(BlockState(i / 2))) +
                                  (i % 2 == 0 ? " Y" : " chroma")
                            : std::string(kStatusKinds[i - kBlockKinds]);
        all.push_back({"cross " + what + ", " + stream + (waited == 1 ? ", answer waited" : ""),
                       hits_[s][waited][i]});
      }
    }
  }
  return all;
}

}  // namespace hmlfc::tb
