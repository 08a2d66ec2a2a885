#include "vectors/examine.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <hmlfc/decoder.hpp>

#include "decoder/key_images.hpp"
#include "syntax/geometry.hpp"
#include "syntax/header.hpp"
#include "vectors/expected.hpp"
#include "vectors/stream_edit.hpp"

namespace hmlfc::vectors {
namespace {

constexpr size_t kBytesShown = 12;

struct Note {
  uint64_t bits = 0;
  std::string text;
  std::string clause;
};

constexpr size_t kAtProfile = 9;
constexpr size_t kFirstExtended = 35;
constexpr size_t kReservedBytes = 9;  // of profile main, from kFirstExtended on

class Dump {
 public:
  explicit Dump(std::span<const uint8_t> file) : file_(file) {}

  std::string run() {
    note_fixed_fields();
    const auto header = parse_header(file_);
    if (!header) return text() + to_string(header.error()) + "\n";
    note_header(*header);
    const auto decoder = Decoder::open(file_, {.check_sections = false});
    if (!decoder) return text() + to_string(decoder.error()) + "\n";
    note_keys(*header);
    for_each_block(*decoder, [&](const BlockAddress& block) { note_block(*decoder, block); });
    return text() + errors_;
  }

 private:
  uint64_t load(uint64_t at, size_t bytes) const { return load_number(file_, at, bytes); }

  void add(uint64_t bit, uint64_t bits, std::string note, std::string clause) {
    notes_.emplace(bit, Note{bits, std::move(note), std::move(clause)});
  }

  void add_bytes(uint64_t at, size_t bytes, const std::string& name, const std::string& clause) {
    if (at + bytes > file_.size()) return;
    add(at * 8, bytes * 8, fmt::format("{} = {}", name, load(at, bytes)), clause);
  }

  void note_fixed_fields() {
    const bool main = file_.size() > kAtProfile && file_[kAtProfile] == 0;
    for (const ByteField& field : header_fields()) {
      if (field.offset < kFirstExtended) {
        add_bytes(field.offset, field.bytes, std::string(field.name), "FIL-1");
      } else if (!main) {
        add_bytes(field.offset, field.bytes, std::string(field.name), "EXT-2");
      }
    }
    if (main) add(kFirstExtended * 8, kReservedBytes * 8, "reserved", "FIL-1");
  }

  void note_header(const StreamHeader& header) {
    uint64_t at = 44;
    for (size_t end = header.levels.size(); end > 0; --end, at += 4) {
      const size_t level = end - 1;
      add_bytes(at, 1, fmt::format("level {} ref_rows", level), "FIL-2");
      add_bytes(at + 1, 1, fmt::format("level {} ref_cols", level), "FIL-2");
      add_bytes(at + 2, 1, fmt::format("level {} key_references", level), "EXT-4");
      add_bytes(at + 3, 1, "reserved", "FIL-2");
    }
    for (const SectionEntry* entry : section_entries(header)) {
      const std::string name(section_name(static_cast<Section>(entry->type)));
      add_bytes(at, 4, name + " type", "FIL-3");
      add_bytes(at + 4, 4, name + " crc", "FIL-3");
      add_bytes(at + 8, 8, name + " offset", "FIL-3");
      add_bytes(at + 16, 8, name + " size", "FIL-3");
      at += 24;
    }
    add_bytes(at, 4, "header_crc", "FIL-5");
    if (header.rig.size > 0) add(header.rig.offset * 8, header.rig.size * 8, "rig", "RIG-2");
  }

  void note_keys(const StreamHeader& header) {
    const uint64_t top = header.sections[0].offset;
    const uint64_t entries = Geometry(header).key_count() * kPlaneCount;
    for (uint64_t i = 0; i < entries; ++i) {
      const uint64_t at = top + i * kTopEntryBytes;
      const std::string name = fmt::format("key image {} {}", i / kPlaneCount,
                                           plane_name(static_cast<Plane>(i % kPlaneCount)));
      add_bytes(at, 8, name + " offset", "KEY-1");
      add_bytes(at + 8, 4, name + " size", "KEY-1");
      add_bytes(at + 12, 4, name + " sample_crc", "KEY-3");
      add((top + load(at, 8)) * 8, load(at + 8, 4) * 8, name + ": codestream", "KEY-2");
    }
  }

  void note_block(const Decoder& decoder, const BlockAddress& block) {
    BlockRecorder recorder;
    const auto samples = decoder.decode_block(block, {.trace = &recorder});
    for (const auto& record : recorder.records) {
      if (const auto* field = std::get_if<RecordedField>(&record)) note_field(*field);
    }
    if (samples) return;
    errors_ += fmt::format("view {},{} {} block {},{}: {}\n", block.view.row, block.view.col,
                           plane_name(block.plane), block.bx, block.by, to_string(samples.error()));
  }

  void note_field(const RecordedField& field) {
    const std::string value = field.bits == 64
                                  ? fmt::format("{:#018x}", static_cast<uint64_t>(field.value))
                                  : std::to_string(field.value);
    add(field.bit, field.bits, fmt::format("{} = {}", field.name, value),
        std::string(field.clause));
  }

  // Bytes [begin, end), at most kBytesShown of them.
  std::string hex(uint64_t begin, uint64_t end) const {
    std::string shown;
    for (uint64_t at = begin; at < std::min(end, begin + kBytesShown); ++at) {
      shown += fmt::format("{:02x} ", file_[static_cast<size_t>(at)]);
    }
    return end - begin > kBytesShown ? shown + ".." : shown;
  }

  void append_line(std::string& out, uint64_t bit, uint64_t bits, const std::string& note,
                   const std::string& clause) const {
    const uint64_t end = std::min<uint64_t>((bit + bits + 7) / 8, file_.size());
    out += fmt::format("{:08x}.{} {:4} bits  {:38} {:7} {}\n", bit / 8, bit % 8, bits,
                       hex(bit / 8, std::max(end, bit / 8)), clause, note);
  }

  std::string text() const {
    std::string out;
    uint64_t done = 0;
    for (const auto& [bit, note] : notes_) {
      if (bit > done) append_line(out, done, bit - done, "(no field: values, padding, unread)", "");
      append_line(out, bit, note.bits, note.text, note.clause);
      done = std::max(done, bit + note.bits);
    }
    const uint64_t end = uint64_t{file_.size()} * 8;
    if (end > done) append_line(out, done, end - done, "(no field: values, padding, unread)", "");
    return out;
  }

  std::span<const uint8_t> file_;
  std::map<uint64_t, Note> notes_;
  std::string errors_;
};

}  // namespace

std::string annotated_dump(std::span<const uint8_t> file) { return Dump(file).run(); }

}  // namespace hmlfc::vectors
