#include "vectors/expected.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "bits/crc32c.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::vectors {

namespace {

// The checksums of a view's blocks, separated by spaces; "--------" if one does not decode.
std::string block_sums(const Decoder& decoder, ViewPos view) {
  const StreamHeader& header = decoder.header();
  const uint32_t side = header.block_size();
  std::string sums;
  for (uint32_t y = 0; y < header.height; y += side) {
    for (uint32_t x = 0; x < header.width; x += side) {
      const Rect rect{x, y, std::min(side, header.width - x), std::min(side, header.height - y)};
      const auto image = decoder.decode_rgb(view, rect);
      if (!sums.empty()) sums += ' ';
      sums += image ? fmt::format("{:08x}", crc32c(picture_bytes(*image))) : "--------";
    }
  }
  return sums;
}

// Kinds of hex records.
constexpr uint32_t kBlock = 1;
constexpr uint32_t kField = 2;
constexpr uint32_t kStage = 3;
constexpr uint32_t kEndMarker = 0xffffffff;

// Numbers of stages in hex records, in the order in which a block goes through them.
constexpr std::array<std::string_view, 5> kStages{"parent", "reference", "prediction", "residual",
                                                  "sample"};

uint32_t stage_number(std::string_view stage) {
  uint32_t number = 0;
  while (number < kStages.size() && kStages[number] != stage) ++number;
  return number;
}

// Builds a $readmemh file.
class HexText {
 public:
  // One record per line, with a comment.
  void add(const std::vector<uint32_t>& words, const std::string& comment) {
    for (const uint32_t word : words) text_ += fmt::format("{:08x} ", word);
    text_ += "// " + comment + "\n";
    count_ += words.size();
  }

  std::string text() const {
    return fmt::format("{:08x} // words that follow, without the end marker\n{}{:08x} // end\n",
                       count_, text_, kEndMarker);
  }

 private:
  std::string text_;
  size_t count_ = 0;
};

uint32_t low(uint64_t value) { return static_cast<uint32_t>(value & 0xffffffff); }
uint32_t high(uint64_t value) { return static_cast<uint32_t>(value >> 32); }

// The four words that begin a record: kind, number and count; level and plane; image; block.
std::vector<uint32_t> head_words(uint32_t kind, uint32_t number, size_t count,
                                 const BlockSite& site) {
  return {kind << 24 | number << 16 | static_cast<uint32_t>(count),
          static_cast<uint32_t>(site.level) << 8 | static_cast<uint32_t>(site.plane),
          site.image_row << 16 | site.image_col, site.by << 16 | site.bx};
}

Json site_json(const char* record, const BlockSite& site) {
  Json json;
  json["record"] = record;
  json["level"] = site.level;
  json["image"] = {site.image_row, site.image_col};
  json["plane"] = plane_name(site.plane);
  json["block"] = {site.bx, site.by};
  return json;
}

std::string place_text(const BlockSite& site) {
  return fmt::format("level {} image {},{} {} block {},{}", site.level, site.image_row,
                     site.image_col, plane_name(site.plane), site.bx, site.by);
}

class TraceWriter {
 public:
  void begin(const BlockAddress& block) {
    lines_ += Json{{"record", "block"},
                   {"view", {block.view.row, block.view.col}},
                   {"plane", plane_name(block.plane)},
                   {"block", {block.bx, block.by}}}
                  .dump() +
              "\n";
    const BlockSite site{0, block.view.row, block.view.col, block.plane, block.bx, block.by};
    hex_.add(head_words(kBlock, 0, 0, site), "decode " + place_text(site));
  }

  void operator()(const RecordedField& field) {
    Json json = site_json("field", field.site);
    json["tile"] = tile_kind_name(field.site.tile);
    json["section"] = section_name(field.section);
    json["byte"] = field.bit >> 3;
    json["bit"] = field.bit & 7;
    json["bits"] = field.bits;
    json["name"] = field.name;
    json["clause"] = field.clause;
    const auto value = static_cast<uint64_t>(field.value);
    json["value"] = value_json(field);
    lines_ += json.dump() + "\n";
    auto words = head_words(kField, static_cast<uint32_t>(field.section), 5, field.site);
    words.insert(words.end(),
                 {high(field.bit), low(field.bit), field.bits, high(value), low(value)});
    hex_.add(words, std::string(field.name) + ", " + std::string(field.clause));
  }

  void operator()(const RecordedStage& stage) {
    Json json = site_json("stage", stage.site);
    json["stage"] = stage.stage;
    json["clause"] = stage.clause;
    json["values"] = stage.values;
    lines_ += json.dump() + "\n";
    auto words = head_words(kStage, stage_number(stage.stage), stage.values.size(), stage.site);
    for (const int32_t value : stage.values) words.push_back(static_cast<uint32_t>(value));
    hex_.add(words, place_text(stage.site) + " " + stage.stage + ", " + stage.clause);
  }

  TraceText text() const { return {lines_, hex_.text()}; }

 private:
  std::string lines_;
  HexText hex_;
};

}  // namespace

ExpectedViews expected_views(const Decoder& decoder) {
  const StreamHeader& header = decoder.header();
  ExpectedViews expected;
  expected.raw.emplace();
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      expected.blocks += fmt::format("{} {}\n{}\n", row, col, block_sums(decoder, {row, col}));
      if (!expected.raw) continue;
      const auto image = decoder.decode_view({row, col});
      if (!image) {
        expected.raw.reset();
        continue;
      }
      const std::vector<uint8_t> bytes = picture_bytes(*image);
      expected.raw->insert(expected.raw->end(), bytes.begin(), bytes.end());
    }
  }
  return expected;
}

Json value_json(const RecordedField& field) {
  return field.bits == 64 ? Json(static_cast<uint64_t>(field.value)) : Json(field.value);
}

TraceText trace_text(const Decoder& decoder, std::span<const BlockAddress> blocks) {
  TraceWriter writer;
  for (const BlockAddress& block : blocks) {
    BlockRecorder recorder;
    if (!decoder.decode_block(block, {.trace = &recorder})) {
      throw TextError("a traced block does not decode");
    }
    writer.begin(block);
    for (const auto& record : recorder.records) std::visit(writer, record);
  }
  return writer.text();
}

}  // namespace hmlfc::vectors
