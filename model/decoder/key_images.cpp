#include "decoder/key_images.hpp"

#include <algorithm>
#include <utility>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "bits/parallel.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/request_guard.hpp"

namespace hmlfc {
namespace {

struct TopEntry {
  uint64_t offset;
  uint32_t size;
  uint32_t sample_crc;
};

// Entry `entry` of `table`, the TOP section or its beginning.
TopEntry load_entry(std::span<const uint8_t> table, uint64_t entry) {
  const auto at = static_cast<size_t>(entry * kTopEntryBytes);
  return {load_le<uint64_t>(table, at), load_le<uint32_t>(table, at + 8),
          load_le<uint32_t>(table, at + 12)};
}

// The entry, whose codestream lies in TOP. Opening has checked the table, but a partial source may
// have dropped these bytes since, and fetched others.
Result<TopEntry> read_entry(const StreamView& stream, uint64_t entry) {
  const uint64_t at = entry * kTopEntryBytes;
  const auto bytes = stream.read(Section::kTop, at, kTopEntryBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  const TopEntry place = load_entry(*bytes, 0);
  const uint64_t top = stream.entry(Section::kTop).size;
  if (place.offset > top || place.size > top - place.offset) {
    return stream.error(ErrorCode::kBadTopEntry, Section::kTop, at);
  }
  return place;
}

uint64_t entry_count(const StreamView& stream) { return stream.geometry.key_count() * kPlaneCount; }

// Whether all samples lie in `range`, which holds 0. The loop has no branch, so that it vectorises.
bool is_within(std::span<const int16_t> samples, const SampleRange& range) {
  int16_t least = 0;
  int16_t most = 0;
  for (const int16_t sample : samples) {
    least = std::min(least, sample);
    most = std::max(most, sample);
  }
  return least >= range.lo && most <= range.hi;
}

}  // namespace

void clamp_samples(SamplePlane& plane, const SampleRange& range) {
  for (int16_t& sample : plane.samples) {
    sample = narrow<int16_t>(clamp(sample, range.lo, range.hi));
  }
}

Result<uint64_t> codestream_bytes(const StreamView& stream, uint64_t key, Plane plane) {
  return read_entry(stream, key * kPlaneCount + static_cast<uint64_t>(plane)).map(&TopEntry::size);
}

uint32_t sample_crc(const SamplePlane& plane) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(plane.samples.data());
  if constexpr (kLittleEndian) return crc32c({bytes, plane.samples.size() * sizeof(int16_t)});
  std::vector<uint8_t> ordered;  // as KEY-3 says
  for (const int16_t sample : plane.samples) append_le(ordered, static_cast<uint16_t>(sample));
  return crc32c(ordered);
}

Result<void> check_top_table(const StreamView& stream) {
  const uint64_t top = stream.entry(Section::kTop).size;
  const uint64_t entries = entry_count(stream);
  if (entries > top / kTopEntryBytes) {
    return stream.error(ErrorCode::kBadSectionSize, Section::kTop, 0);
  }
  const auto table = stream.read(Section::kTop, 0, entries * kTopEntryBytes);
  if (!table) return tl::unexpected(table.error());
  uint64_t expected_offset = entries * kTopEntryBytes;
  for (uint64_t i = 0; i < entries; ++i) {
    const TopEntry entry = load_entry(*table, i);
    if (entry.offset != expected_offset || entry.size > top - expected_offset) {
      return stream.error(ErrorCode::kBadTopEntry, Section::kTop, i * kTopEntryBytes);
    }
    expected_offset += entry.size;
  }
  if (expected_offset != top) {
    return stream.error(ErrorCode::kBadSectionSize, Section::kTop, expected_offset);
  }
  return {};
}

uint64_t KeyImages::entry_of(int level, ImagePos at, Plane plane) const {
  return stream_.geometry.key_number(level, at) * kPlaneCount + static_cast<uint64_t>(plane);
}

Result<std::shared_ptr<const SamplePlane>> KeyImages::plane(int level, ImagePos at,
                                                            Plane plane) const {
  return this->plane(entry_of(level, at, plane));
}

Result<std::shared_ptr<const SamplePlane>> KeyImages::plane(uint64_t entry) const {
  return planes_.get(entry, [&]() -> Result<std::shared_ptr<const SamplePlane>> {
    auto decoded = decode(entry);
    if (!decoded) return tl::unexpected(decoded.error());
    return std::make_shared<const SamplePlane>(std::move(*decoded));
  });
}

std::shared_ptr<const SamplePlane> KeyImages::plane_or_request(int level, ImagePos at, Plane plane,
                                                               KeyRequests& requests) const {
  const uint64_t entry = entry_of(level, at, plane);
  if (auto held = planes_.find(entry)) return held;
  requests.entries_.push_back(entry);
  return *zeros_.get(static_cast<uint64_t>(plane), [&]() -> Result<LazyMap<SamplePlane>::Pointer> {
    const PlaneShape& shape = stream_.geometry.plane(plane);
    return std::make_shared<const SamplePlane>(shape.width, shape.height);
  });
}

void KeyImages::load(const StreamView& stream, int level, ImagePos at, Plane plane) const {
  const uint64_t entry = entry_of(level, at, plane);
  if (planes_.find(entry)) return;
  if (const auto place = read_entry(stream, entry)) {
    static_cast<void>(stream.read(Section::kTop, place->offset, place->size));
  }
}

void KeyImages::decode(std::span<const KeyRequests> requests) const {
  std::vector<uint64_t> entries;
  for (const KeyRequests& some : requests) {
    entries.insert(entries.end(), some.entries_.begin(), some.entries_.end());
  }
  // Y, which takes longest, first.
  std::ranges::sort(entries, {},
                    [](uint64_t entry) { return std::pair(entry % kPlaneCount, entry); });
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  parallel_for(entries.size(), [&](size_t i) {
    static_cast<void>(guard_memory([&] { return plane(entries[i]); }));
  });
}

Result<SamplePlane> KeyImages::decode(uint64_t entry) const {
  const auto plane = static_cast<Plane>(entry % kPlaneCount);
  const auto place = read_entry(stream_, entry);
  if (!place) return tl::unexpected(place.error());
  const auto codestream = stream_.read(Section::kTop, place->offset, place->size);
  if (!codestream) return tl::unexpected(codestream.error());
  const PlaneShape& shape = stream_.geometry.plane(plane);
  if (stream_.reads != nullptr) stream_.reads->on_key_plane(shape.samples());
  const SamplePrecision precision = precision_of(plane, stream_.header.depth);
  if (!has_key_image_head(*codestream, shape.width, shape.height, precision)) {
    return stream_.error(ErrorCode::kBadTopImage, Section::kTop, place->offset);
  }
  if (code_blocks_of(*codestream, shape.width, shape.height) > stream_.max_code_blocks) {
    return stream_.error(ErrorCode::kLimitExceeded, Section::kTop, place->offset);
  }
  const auto bad_crc = [&] {
    return stream_.error(ErrorCode::kBadTopCrc, Section::kTop, entry * kTopEntryBytes);
  };
  auto samples = decode_jpeg2000(*codestream, shape.width, shape.height);
  if (!samples) return bad_crc();
  const SampleRange range = sample_range(plane, stream_.header.depth);
  if (stream_.header.has(Feature::kLossyKeys)) clamp_samples(*samples, range);
  if (sample_crc(*samples) != place->sample_crc) return bad_crc();
  if (!is_within(samples->samples, range)) {
    return stream_.error(ErrorCode::kTopSampleRange, Section::kTop, place->offset);
  }
  return std::move(*samples);
}

}  // namespace hmlfc
