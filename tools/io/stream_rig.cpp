#include "io/stream_rig.hpp"

#include <algorithm>
#include <utility>

#include <hmlfc/stream_info.hpp>

namespace hmlfc::io {
namespace {

constexpr size_t kHeaderEntryBytes = 24;  // of section RIG (FIL-2)

Rig with_rows_upside_down(Rig rig) {
  for (auto& position : rig.positions) position[1] = -position[1];
  return rig;
}

}  // namespace

IoResult<std::optional<ChosenRig>> rig_of_views(const ViewList& views,
                                                const LightFieldShape& shape) {
  auto beside = rig_beside(views, shape);
  if (!beside) return tl::unexpected(beside.error());
  if (*beside) return ChosenRig{std::move(**beside)};
  auto named = rig_of_names(views);
  if (!named) return tl::unexpected(named.error());
  if (*named) return ChosenRig{std::move(**named), true};
  return std::nullopt;
}

uint64_t most_rig_bytes(const ChosenRig& rig) {
  const size_t text = rig_text(rig.rig).size();
  const size_t turned = rig_text(with_rows_upside_down(rig.rig)).size();
  return kHeaderEntryBytes + std::max(text, rig.from_names ? turned : 0);
}

std::string rig_section(const StreamHeader& header, const ChosenRig& rig) {
  const bool turn = rig.from_names && header.row_scale < 0;
  return rig_text(turn ? with_rows_upside_down(rig.rig) : rig.rig);
}

std::vector<uint8_t> stream_with_rig(std::span<const uint8_t> bytes, const ChosenRig& rig) {
  const std::string text = rig_section(parse_header(bytes).value(), rig);
  return with_rig(bytes, bytes_of(text)).value();
}

Result<MaybeRig> rig_in_stream(ByteSource& source, const StreamHeader& header) {
  if (!header.has(Feature::kCameraRig)) return std::nullopt;
  const auto wrong = [&](const std::string& what) {
    return tl::unexpected("section RIG at byte " + std::to_string(header.rig.offset) + ": " + what);
  };
  const ByteRange range{header.rig.offset, header.rig.size};
  const std::string excess = kRigLimits.excess(range.bytes);
  if (!excess.empty()) return MaybeRig(wrong(excess));
  FoundRig found{{}, std::string(static_cast<size_t>(range.bytes), '\0')};
  source.begin_request();
  const bool loaded = !source.is_partial() || source.load({&range, 1});
  if (loaded) std::ranges::copy(rig_of(source.bytes(), header), found.text.begin());
  source.end_request();
  if (!loaded) return fail(ErrorCode::kBusError, Section::kRig, range.offset);
  auto rig = parse_rig(bytes_of(found.text), uint64_t{header.rows} * header.cols);
  if (!rig) return MaybeRig(wrong(rig.error()));
  found.rig = std::move(*rig);
  return MaybeRig(std::move(found));
}

}  // namespace hmlfc::io
