#include "cli/block_report.hpp"

#include <array>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"

namespace hmlfc::cli {
namespace {

constexpr size_t kValueColumns = 52;
constexpr int64_t kChoiceDisparity = 10;  // MOT-5: explicit_x is a disparity

std::string levels_meaning(int64_t code) {
  if (code < 0 || code > int64_t{kMaxLevelCode}) return "";
  const Levels levels = levels_of_code(static_cast<unsigned>(code));
  const char* digit = levels.digit == Digit::kTrit    ? "a trit and "
                      : levels.digit == Digit::kQuint ? "a quint and "
                                                      : "";
  return fmt::format("{} levels: {}{} bit{}", levels.count, digit, levels.plain_bits,
                     levels.plain_bits == 1 ? "" : "s");
}

// MOT-5.
std::string choice_meaning(int64_t choice) {
  constexpr std::array<std::string_view, 12> kWords{
      "no motion",  "own disparity", "left",       "right",       "above",          "below",
      "above left", "above right",   "below left", "below right", "this disparity", "this vector"};
  const auto at = static_cast<size_t>(choice);
  return at < kWords.size() ? std::string(kWords[at]) : "reserved";
}

unsigned step_code(const FieldRecord& field) { return static_cast<unsigned>(field.value & 15); }

// What a code stands for, or nothing.
std::string meaning(const TracedWalk& walk, const FieldRecord& field, const StreamHeader& header) {
  const auto one_of = [&field](std::array<std::string_view, 4> words) {
    return std::string(words[static_cast<size_t>(field.value & 3)]);
  };
  if (field.name == "motion_mode" || field.name == "residual_mode") {
    return one_of({"no block", "all blocks", "mask of 64", "mask by quads"});
  }
  if (field.name == "sign_mode") return one_of({"all +", "all -", "one bit a block", "reserved"});
  if (field.name == "codes_x" || field.name == "codes_y") return levels_meaning(field.value);
  if (field.name == "disparity_code") return levels_meaning(field.value);
  if (field.name == "motion_block") return fmt::format("{0} x {0} samples", 4 << field.value);
  if (field.name == "palette_size") return fmt::format("{} entries", field.value + 1);
  if (field.name == "choice") return choice_meaning(field.value);
  if (field.name == "step_base") return fmt::format("step {}", step_of_code(step_code(field)));
  if (field.name == "sign") return field.value == 0 ? "+" : "-";
  if (field.name == "place") {
    const auto place = static_cast<uint64_t>(field.value);
    return fmt::format("data {:#x}, offset_bits {}", place & 0xFFFFFFFFFFFFu, (place >> 48) & 0xFF);
  }
  return unit_of(walk, field, header);
}

std::string value_text(const FieldRecord& field) {
  const bool mask = field.name.find("mask") != std::string::npos || field.name == "place";
  if (!mask) return std::to_string(field.value);
  return fmt::format("0x{:0{}x}", static_cast<uint64_t>(field.value), (field.bits + 3) / 4);
}

// Fields of which a decoder reads many in a row.
bool is_repeated(const FieldRecord& field) {
  return field.name == "quad_blocks" || field.name == "level_delta" || field.name == "value";
}

FieldRow row_of(const TracedWalk& walk, std::span<const FieldRecord> fields,
                const StreamHeader& header) {
  const FieldRecord& first = fields.front();
  const unsigned code = walk.level_code().value_or(0);
  FieldRow row;
  row.section = section_name(first.section);
  row.first_bit = first.bit;
  row.bit_count = first.bits * fields.size();
  row.bits = std::to_string(first.bits);
  row.name = first.name;
  row.clause = first.clause;
  if (first.name == "value") {
    const auto levels = levels_of_code(code);
    row.bit_count = bise_bits(levels, fields.size());
    row.bits = std::to_string(row.bit_count);
    row.value = fmt::format("{} values of {} levels, below", fields.size(), levels.count);
    return row;
  }
  if (fields.size() > 1) row.bits = fmt::format("{} x {}", fields.size(), first.bits);
  for (const FieldRecord& field : fields) {
    if (!row.value.empty()) row.value += ' ';
    row.value += value_text(field);
  }
  std::string note =
      first.name == "level_delta" ? levels_meaning(code) : meaning(walk, first, header);
  if (first.name == "level_delta" && fields.size() > 1) note = "this block: " + note;
  if (!note.empty()) row.value += "  (" + note + ")";
  return row;
}

// `text` in lines of at most kValueColumns, broken at spaces.
std::vector<std::string> broken(const std::string& text) {
  std::vector<std::string> lines;
  size_t at = 0;
  while (text.size() - at > kValueColumns) {
    const size_t space = text.rfind(' ', at + kValueColumns);
    if (space == std::string::npos || space <= at) break;
    lines.push_back(text.substr(at, space - at));
    at = space + 1;
  }
  lines.push_back(text.substr(at));
  return lines;
}

}  // namespace

std::vector<FieldRow> field_rows(const TracedWalk& walk, const StreamHeader& header) {
  const std::span<const FieldRecord> fields(walk.fields);
  std::vector<FieldRow> rows;
  for (size_t begin = 0; begin < fields.size();) {
    size_t end = begin + 1;
    while (end < fields.size() && is_repeated(fields[begin]) &&
           fields[end].name == fields[begin].name) {
      ++end;
    }
    rows.push_back(row_of(walk, fields.subspan(begin, end - begin), header));
    begin = end;
  }
  return rows;
}

std::string FieldRow::address() const {
  return fmt::format("0x{:06x}.{}", first_bit >> 3, first_bit & 7);
}

std::string unit_of(const TracedWalk& walk, const FieldRecord& field, const StreamHeader& header) {
  const std::string_view name = field.name;
  if (name == "min_x" || name == "min_y" || name == "dx" || name == "dy") return "samples";
  bool disparity = name == "min_disparity" || name == "disparity";
  if (name == "explicit_x") {
    for (const FieldRecord* at = &field; at >= walk.fields.data(); --at) {
      if (at->name != "choice") continue;
      disparity = at->value == kChoiceDisparity;
      break;
    }
  } else if (name != "explicit_y" && !disparity) {
    return "";
  }
  const unsigned precision = disparity ? header.disparity_precision : header.vector_precision;
  const std::string unit = precision == 0 ? "samples" : fmt::format("1/{} sample", 1u << precision);
  return disparity ? unit + " per column" : unit;
}

std::string field_table(const TracedWalk& walk, const StreamHeader& header, size_t indent) {
  const std::string margin(indent, ' ');
  constexpr const char* kLine = "{}{:<7} {:<12} {:>7}  {:<13} {:<6}  {}\n";
  std::string text = fmt::format(fmt::runtime(kLine), margin, "section", "byte.bit", "bits",
                                 "field", "clause", "value");
  for (const FieldRow& row : field_rows(walk, header)) {
    const auto lines = broken(row.value);
    text += fmt::format(fmt::runtime(kLine), margin, row.section, row.address(), row.bits, row.name,
                        row.clause, lines[0]);
    for (size_t i = 1; i < lines.size(); ++i) {
      text += fmt::format(fmt::runtime(kLine), margin, "", "", "", "", "", lines[i]);
    }
  }
  return text;
}

}  // namespace hmlfc::cli
