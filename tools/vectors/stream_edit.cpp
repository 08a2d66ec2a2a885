#include "vectors/stream_edit.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "decoder/key_images.hpp"
#include "syntax/header.hpp"
#include "vectors/expected.hpp"
#include "vectors/recipe.hpp"

namespace hmlfc::vectors {
namespace {

constexpr ByteField kHeaderFields[] = {
    {"magic", 0, 8},
    {"version", 8, 1},
    {"profile", 9, 1},
    {"header_bytes", 10, 2},
    {"feature_flags", 12, 4},
    {"rows", 16, 2},
    {"cols", 18, 2},
    {"width", 20, 4},
    {"height", 24, 4},
    {"depth", 28, 1},
    {"chroma_format", 29, 1},
    {"block_log2", 30, 1},
    {"window", 31, 1},
    {"cluster_rows", 32, 1},
    {"cluster_cols", 33, 1},
    {"tree_height", 34, 1},
    {"vector_precision", 35, 1},
    {"disparity_precision", 36, 1},
    {"motion_tile_log2", 37, 1},
    {"disparity_grid_log2", 38, 1},
    {"row_scale", 39, 1},
    {"reserved", 40, 4},
};

// Of FIL-2 and FIL-3, from the start of an entry.
constexpr ByteField kEntryFields[] = {
    {"ref_rows", 0, 1}, {"ref_cols", 1, 1}, {"key_references", 2, 1}, {"level_reserved", 3, 1},
    {"type", 0, 4},     {"crc", 4, 4},      {"offset", 8, 8},         {"size", 16, 8}};

const ByteField& field_of(std::span<const ByteField> fields, const std::string& name) {
  const auto found = std::ranges::find(fields, name, &ByteField::name);
  if (found == fields.end()) throw std::out_of_range(name);
  return *found;
}

constexpr size_t kAtHeaderBytes = 10;
constexpr size_t kAtFlags = 12;
constexpr size_t kAtLevels = 44;
constexpr size_t kLevelBytes = 4;
constexpr size_t kSectionBytes = 24;
constexpr size_t kTableAndCrc = 4 * kSectionBytes + 4;
constexpr uint64_t kSot = 0xFF90;  // its Psot is at byte 6

class Editor {
 public:
  // Edits of a recipe, which may be anyone's: throws where one leaves the stream.
  explicit Editor(std::vector<uint8_t>& bytes) : bytes_(bytes) {}

  void apply(const Json& json) {
    if (json.contains("header")) return edit_header(json);
    if (json.contains("section")) return edit_entry(json);
    if (json.contains("field")) return edit_field(json);
    if (json.contains("bytes")) return edit_bytes(json);
    if (json.contains("marker")) return edit_marker(json);
    if (json.contains("splice")) return splice(json);
    if (json.contains("resize")) return resize(json);
    if (json.contains("cut")) return cut(json.at("cut"));
    if (json.contains("append")) return append(json.at("append"));
    throw TextError(json.dump() + " is not an edit");
  }

  // CRCs of the sections that lie in the file, then that of the header.
  void mend(bool sections) {
    if (bytes_.size() < kAtHeaderBytes + 2) return;
    const size_t header_bytes = load(kAtHeaderBytes, 2);
    if (header_bytes < kTableAndCrc || header_bytes > bytes_.size()) return;
    const size_t others = has_rig() && header_bytes >= kTableAndCrc + kSectionBytes ? 1 : 0;
    for (size_t section = 0; sections && section < 4 + others; ++section) {
      const size_t entry = header_bytes - kTableAndCrc + (section - others) * kSectionBytes;
      const uint64_t offset = load(entry + 8, 8);
      const uint64_t size = load(entry + 16, 8);
      if (offset > bytes_.size() || size > bytes_.size() - offset) continue;
      store(entry + 4, 4,
            crc32c(
                std::span(bytes_).subspan(static_cast<size_t>(offset), static_cast<size_t>(size))));
    }
    store(header_bytes - 4, 4, crc32c(std::span(bytes_).first(header_bytes - 4)));
  }

 private:
  uint64_t load(size_t at, size_t size) const { return load_number(bytes_, at, size); }

  void store(size_t at, size_t size, uint64_t value) {
    for (size_t i = 0; i < size; ++i) bytes_.at(at + i) = static_cast<uint8_t>(value >> (8 * i));
  }

  bool has_rig() const { return (load(kAtFlags, 4) & feature_bit(Feature::kCameraRig)) != 0; }

  // The byte of section entry `name` in the header. RIG is in front of the others.
  size_t entry_of(const Json& name) const {
    if (name == section_name(Section::kRig) && has_rig()) {
      return load(kAtHeaderBytes, 2) - kTableAndCrc - kSectionBytes;
    }
    for (size_t i = 0; i < 4; ++i) {
      if (name == section_name(static_cast<Section>(i + 1))) {
        return load(kAtHeaderBytes, 2) - kTableAndCrc + i * kSectionBytes;
      }
    }
    throw TextError(name.dump() + " is not a section");
  }

  void set(size_t at, size_t size, const Json& json) {
    const uint64_t value = json.contains("add")
                               ? load(at, size) + static_cast<uint64_t>(json["add"].get<int64_t>())
                               : static_cast<uint64_t>(json.at("value").get<int64_t>());
    store(at, size, value);
  }

  void edit_header(const Json& json) {
    const auto name = json["header"].get<std::string>();
    if (json.contains("level")) {
      const size_t tree_height = load(field_of(kHeaderFields, "tree_height").offset, 1);
      const ByteField field = field_of(kEntryFields, name);
      const size_t entry = tree_height - json["level"].get<size_t>();
      return set(kAtLevels + kLevelBytes * entry + field.offset, field.bytes, json);
    }
    const ByteField field = field_of(kHeaderFields, name);
    set(field.offset, field.bytes, json);
  }

  void edit_entry(const Json& json) {
    const ByteField field = field_of(kEntryFields, json.at("entry"));
    set(entry_of(json["section"]) + field.offset, field.bytes, json);
  }

  void edit_field(const Json& json) {
    const auto decoder = Decoder::open(bytes_);
    if (!decoder) throw TextError("edit: " + to_string(decoder.error()));
    BlockRecorder recorder;
    const BlockAddress block = block_of(json.at("block"));
    static_cast<void>(decoder->decode_block(block, {.trace = &recorder}));
    auto left = json.value("nth", 0);
    for (const auto& record : recorder.records) {
      const auto* field = std::get_if<RecordedField>(&record);
      if (field == nullptr || json["field"] != field->name) continue;
      if (field->site.level != json.value("level", 0) || left-- > 0) continue;
      return set_field(*field, json);
    }
    throw TextError("edit: no field " + json["field"].dump() + " is read for this block");
  }

  void set_field(const RecordedField& field, const Json& json) {
    const int64_t value = json.contains("add") ? field.value + json["add"].get<int64_t>()
                                               : json.at("value").get<int64_t>();
    for (unsigned i = 0; i < field.bits; ++i) {
      set_bit(field.bit + i, ((static_cast<uint64_t>(value) >> i) & 1u) != 0);
    }
  }

  void set_bit(uint64_t bit, bool one) {
    uint8_t& byte = bytes_.at(static_cast<size_t>(bit >> 3));
    const auto mask = static_cast<uint8_t>(1u << (bit & 7));
    byte = static_cast<uint8_t>(one ? byte | mask : byte & ~mask);
  }

  void edit_bytes(const Json& json) {
    const size_t entry = entry_of(json["bytes"]);
    const uint64_t begin = load(entry + 8, 8);
    check_range(begin, json.at("at").get<uint64_t>());
    auto at = static_cast<size_t>(begin + json.at("at").get<uint64_t>());
    for (const Json& value : json.at("value")) bytes_.at(at++) = value;
  }

  // The entry of the TOP table of the codestream that `json` names (KEY-1).
  size_t top_entry_of(const Json& json) const {
    const auto top = static_cast<size_t>(load(entry_of("TOP") + 8, 8));
    return top + json.at("codestream").get<size_t>() * kTopEntryBytes;
  }

  // The first marker of this number in a codestream (KEY-2).
  size_t marker_of(const Json& json, uint64_t marker) const {
    size_t at = load(entry_of("TOP") + 8, 8) + load(top_entry_of(json), 8);
    while (bytes_.at(at) * uint64_t{256} + bytes_.at(at + 1) != marker) ++at;
    return at;
  }

  void edit_marker(const Json& json) {
    size_t at = marker_of(json, json["marker"]) + json.at("at").get<size_t>();
    for (const Json& value : json.at("value")) bytes_.at(at++) = value;
  }

  void splice(const Json& json) {
    const size_t at = marker_of(json, json["splice"]) + json.at("at").get<size_t>();
    const auto removed = json.value("remove", size_t{0});
    const auto inserted = json.at("insert").get<std::vector<uint8_t>>();
    check_range(at, removed);
    const auto by = static_cast<int64_t>(inserted.size()) - static_cast<int64_t>(removed);
    const size_t tile_part_bytes = marker_of(json, kSot) + 6;
    if (at > tile_part_bytes && load_big_endian(tile_part_bytes) != 0) {
      store_big_endian(tile_part_bytes, load_big_endian(tile_part_bytes) + by);
    }
    const auto place = bytes_.begin() + static_cast<ptrdiff_t>(at);
    const auto gap = bytes_.erase(place, place + static_cast<ptrdiff_t>(removed));
    bytes_.insert(gap, inserted.begin(), inserted.end());
    grow(entry_of("TOP"), by);
    const size_t entry = top_entry_of(json);
    store(entry + 8, 4, load(entry + 8, 4) + static_cast<uint64_t>(by));
    const auto top = static_cast<size_t>(load(entry_of("TOP") + 8, 8));
    const size_t table_end = top + load(top, 8);
    for (size_t next = entry + kTopEntryBytes; next < table_end; next += kTopEntryBytes) {
      store(next, 8, load(next, 8) + static_cast<uint64_t>(by));
    }
  }

  int64_t load_big_endian(size_t at) const {
    int64_t value = 0;
    for (size_t i = 0; i < 4; ++i) value = value << 8 | bytes_.at(at + i);
    return value;
  }

  void store_big_endian(size_t at, int64_t value) {
    for (size_t i = 0; i < 4; ++i) bytes_.at(at + i) = static_cast<uint8_t>(value >> (24 - 8 * i));
  }

  void resize(const Json& json) {
    const size_t entry = entry_of(json["resize"]);
    const auto by = json.at("by").get<int64_t>();
    const uint64_t end = load(entry + 8, 8) + load(entry + 16, 8);
    check_range(end, 0);
    const auto place = bytes_.begin() + static_cast<ptrdiff_t>(end);
    if (by > 0) {
      bytes_.insert(place, checked_size(by), 0);
    } else {
      const uint64_t removed = -static_cast<uint64_t>(by);
      if (removed > end) throw std::out_of_range("resize: more than there is");
      bytes_.erase(place - static_cast<ptrdiff_t>(removed), place);
    }
    grow(entry, by);
  }

  void check_range(uint64_t at, uint64_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) throw std::out_of_range("edit: no bytes");
  }

  static size_t checked_size(int64_t size) {
    constexpr int64_t kMost = int64_t{1} << 28;
    if (size < 0 || size > kMost) throw std::out_of_range("edit: a size outside [0, 2^28]");
    return static_cast<size_t>(size);
  }

  // In the header: section entry `entry` is larger `by` bytes, and those after it lie further back.
  void grow(size_t entry, int64_t by) {
    store(entry + 16, 8, load(entry + 16, 8) + static_cast<uint64_t>(by));
    const size_t table_end = load(kAtHeaderBytes, 2) - 4;
    for (size_t next = entry + kSectionBytes; next < table_end; next += kSectionBytes) {
      store(next + 8, 8, load(next + 8, 8) + static_cast<uint64_t>(by));
    }
  }

  void cut(int64_t length) {
    const int64_t kept = length < 0 ? static_cast<int64_t>(bytes_.size()) + length : length;
    bytes_.resize(checked_size(kept));
  }

  void append(const Json& values) {
    for (const Json& value : values) bytes_.push_back(value);
  }

  std::vector<uint8_t>& bytes_;
};

}  // namespace

std::span<const ByteField> header_fields() { return kHeaderFields; }

uint64_t load_number(std::span<const uint8_t> bytes, uint64_t at, size_t size) {
  if (at > bytes.size() || size > bytes.size() - at) throw std::out_of_range("load_number");
  uint64_t value = 0;
  for (size_t i = size; i > 0; --i) value = value << 8 | bytes[static_cast<size_t>(at) + i - 1];
  return value;
}

void edit_stream(std::vector<uint8_t>& bytes, const Json& json) {
  Editor editor(bytes);
  try {
    editor.apply(json);
  } catch (const std::out_of_range&) {
    throw TextError(json.dump() + " names a place that is not there");
  }
  const Json mend = json.value("mend", Json(true));
  if (mend != false) editor.mend(mend != "header");
}

}  // namespace hmlfc::vectors
