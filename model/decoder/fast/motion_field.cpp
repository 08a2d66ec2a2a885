#include "decoder/fast/motion_field.hpp"

#include "decoder/fast/padded_record.hpp"

namespace hmlfc {

Result<void> read_motion_field(const StreamView& stream, const MotionTilePlace& place,
                               MotionField& field) {
  const MotionContext context = motion_context(stream, place);
  const auto found = find_motion_record(stream, place, Probe{});
  if (!found) return tl::unexpected(found.error());
  if (!*found) {
    field.head = empty_motion_head(context);
    field.usable[0] = true;
    field.indices[0] = 0;
    return {};
  }
  const PaddedRecord record((*found)->bits.bytes());
  FieldCursor cursor(record.bits(), (*found)->file_bit, Probe{});
  const auto head = read_motion_head(cursor, context);
  if (!head) return tl::unexpected(head.error());
  field.head = *head;
  for (unsigned e = 0; e < head->entries; ++e) {
    field.usable[e] = is_usable(head->palette[e], context);
  }
  bise_unpack(record.data(), head->indices_at, head->levels, static_cast<size_t>(head->blocks()),
              field.indices.data());
  return {};
}

}  // namespace hmlfc
