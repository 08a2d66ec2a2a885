// Writes to standard output the constants of the golden model that the decode unit uses
// (hmlfc_tables.svh) or, with the argument `glsl`, those that the shaders use (hmlfc_tables.glsl).
// A test compares the files of the repository with this output.
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

#include "arithmetic/bise.hpp"
#include "arithmetic/motion.hpp"
#include "arithmetic/reconstruct.hpp"
#include "syntax/header.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kCodes = 64;  // entries of the tables by level code: all values of 6 bits

std::string upper(std::string_view name) {
  std::string text(name);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

void put_heading(const char* text) { std::printf("\n// %s\n", text); }

void put_number(const std::string& name, int64_t value) {
  std::printf("localparam integer HMLFC_%s = %lld;\n", name.c_str(), static_cast<long long>(value));
}

void put_errors() {
  put_heading("Errors (annex A).");
  for (int code = 0; code < kErrorCodeCount; ++code) {
    const std::string name = upper(error_name(static_cast<ErrorCode>(code)));
    std::printf("localparam [5:0] HMLFC_ERROR_%s = 6'd%d;\n", name.c_str(), code);
  }
}

void put_features() {
  put_heading("Bits of feature_flags (EXT-1).");
  for (unsigned bit = 0; bit < kFeatureCount; ++bit) {
    put_number("FEATURE_" + upper(feature_name(static_cast<Feature>(bit))), bit);
  }
  put_number("FEATURE_COUNT", kFeatureCount);
}

// A header with every field in use, one level of the tree and no section RIG.
StreamHeader probe_header() {
  StreamHeader header;
  header.profile = Profile::kExtended;
  header.feature_flags = ((1u << kFeatureCount) - 2) & ~feature_bit(Feature::kCameraRig);
  header.levels.resize(1);
  uint64_t offset = header_size(0);
  for (uint32_t i = 0; i < 4; ++i) {
    header.sections[i] = {i + 1, 0, offset, 16};
    offset += 16;
  }
  return header;
}

// The offset of the first byte from `from` on that `change` alters.
int64_t offset_of(const std::function<void(StreamHeader&)>& change, ptrdiff_t from = 0) {
  StreamHeader changed = probe_header();
  change(changed);
  const std::vector<uint8_t> before = write_header(probe_header());
  const std::vector<uint8_t> after = write_header(changed);
  const auto differing = std::mismatch(before.begin() + from, before.end(), after.begin() + from);
  return differing.first - before.begin();
}

// The offset of the version: the first byte whose change makes the parser reject the version. (No
// other version can be written, so offset_of does not find it.)
int64_t offset_of_version() {
  std::vector<uint8_t> bytes = write_header(probe_header());
  for (size_t at = 0; at < bytes.size(); ++at) {
    bytes[at] ^= 0xFF;
    const auto header = parse_header(bytes);
    if (!header && header.error().code == ErrorCode::kBadVersion) return static_cast<int64_t>(at);
    bytes[at] ^= 0xFF;
  }
  return -1;
}

void put_header_offsets() {
  put_heading("Offsets of the header's fields in bytes (FIL-1, EXT-2).");
  const auto put = [](const char* name, const std::function<void(StreamHeader&)>& change) {
    put_number(std::string("HEADER_") + name, offset_of(change));
  };
  // A taller tree also makes the header longer: its size is the first field that differs, the
  // height the second.
  const auto taller = [](StreamHeader& h) { ++h.tree_height; };
  put_number("HEADER_VERSION", offset_of_version());
  put("PROFILE", [](StreamHeader& h) { h.profile = Profile::kMain; });
  put("FEATURE_FLAGS", [](StreamHeader& h) { h.feature_flags ^= 1; });
  put("ROWS", [](StreamHeader& h) { ++h.rows; });
  put("COLS", [](StreamHeader& h) { ++h.cols; });
  put("WIDTH", [](StreamHeader& h) { ++h.width; });
  put("HEIGHT", [](StreamHeader& h) { ++h.height; });
  put("DEPTH", [](StreamHeader& h) { ++h.depth; });
  put("CHROMA_FORMAT", [](StreamHeader& h) { h.chroma_format = ChromaFormat::k444; });
  put("BLOCK_LOG2", [](StreamHeader& h) { ++h.block_log2; });
  put("WINDOW", [](StreamHeader& h) { ++h.window; });
  put("CLUSTER_ROWS", [](StreamHeader& h) { ++h.cluster_rows; });
  put("CLUSTER_COLS", [](StreamHeader& h) { ++h.cluster_cols; });
  put("BYTES", taller);
  put_number("HEADER_TREE_HEIGHT", offset_of(taller, offset_of(taller) + 2));
  put("VECTOR_PRECISION", [](StreamHeader& h) { ++h.vector_precision; });
  put("DISPARITY_PRECISION", [](StreamHeader& h) { ++h.disparity_precision; });
  put("MOTION_TILE_LOG2", [](StreamHeader& h) { ++h.motion_tile_log2; });
  put("DISPARITY_GRID_LOG2", [](StreamHeader& h) { ++h.disparity_grid_log2; });
  put("ROW_SCALE", [](StreamHeader& h) { ++h.row_scale; });
  put("LEVELS", [](StreamHeader& h) { ++h.levels[0].ref_rows; });
  // The section table's first field is the first section's type.
  put("SECTIONS_OF_ONE_LEVEL", [](StreamHeader& h) { ++h.sections[0].type; });
  put_number("HEADER_LEVEL_BYTES", header_size(1) - header_size(0));
  put_number("HEADER_SECTION_BYTES", offset_of([](StreamHeader& h) { ++h.sections[1].type; }) -
                                         offset_of([](StreamHeader& h) { ++h.sections[0].type; }));
  put_number("HEADER_BYTES_OF_ONE_LEVEL", header_size(0));
}

void put_limits() {
  put_heading("Limits of fields, and the magic of FIL-1 as a little-endian number.");
  const std::vector<uint8_t> header = write_header(probe_header());
  std::printf("localparam [63:0] HMLFC_MAGIC = 64'h");
  for (size_t i = 8; i-- > 0;) std::printf("%02x", header[i]);
  std::printf(";\n");
  put_number("VERSION", kVersion);
  put_number("MAX_GRID", kMaxGrid);
  put_number("MAX_SIDE", kMaxSide);
  put_number("MAX_TREE_HEIGHT", kMaxTreeHeight);
  put_number("MAX_WINDOW", kMaxWindow);
  put_number("MAX_LEVEL_CODE", kMaxLevelCode);
  put_number("MAX_STEP_CODE", kMaxStepCode);
  put_number("MAX_DISPARITY_CODE", kMaxDisparityCode);
  put_number("MAX_EXPLICIT_BITS", kMaxExplicitBits);
  put_number("MAX_PALETTE_ENTRIES", kMaxPaletteEntries);
  put_heading("Greatest level code of residuals at depth [8, 12] (TIL-8).");
  std::printf(
      "function automatic [5:0] hmlfc_max_level_code(input [3:0] depth);\n  case (depth)\n");
  for (int depth = 9; depth <= 12; ++depth) {
    std::printf("    4'd%d: hmlfc_max_level_code = 6'd%u;\n", depth,
                max_residual_level_code(depth));
  }
  std::printf("    default: hmlfc_max_level_code = 6'd%u;\n  endcase\nendfunction\n",
              max_residual_level_code(8));
}

// A table of 2^`index_bits` entries as a function; entry k starts at bit `width` * k.
void put_table(const char* comment, const char* name, const char* argument, unsigned index_bits,
               unsigned width, const std::function<uint32_t(unsigned)>& entry) {
  const unsigned count = 1u << index_bits;
  std::vector<bool> bits;
  for (unsigned k = 0; k < count; ++k) {
    for (unsigned i = 0; i < width; ++i) bits.push_back(((entry(k) >> i) & 1u) != 0);
  }
  std::string digits;
  for (size_t at = 0; at < bits.size(); at += 4) {
    unsigned digit = 0;
    for (size_t i = 0; i < 4 && at + i < bits.size(); ++i) digit |= (bits[at + i] ? 1u : 0u) << i;
    digits.insert(digits.begin(), "0123456789abcdef"[digit]);
  }
  put_heading(comment);
  std::printf("localparam [%u:0] HMLFC_%s_TABLE = {\n", width * count - 1, upper(name).c_str());
  // From the most significant digit; only the first line may be shorter than kDigits.
  constexpr size_t kDigits = 20;
  size_t at = 0;
  while (at < digits.size()) {
    const size_t rest = digits.size() - at;
    const size_t length = rest % kDigits != 0 ? rest % kDigits : kDigits;
    const size_t line_bits = std::min<size_t>(4 * length, width * count);
    std::printf("  %zu'h%s%s\n", line_bits, digits.substr(at, length).c_str(),
                rest > length ? "," : "};");
    at += length;
  }
  std::printf("function automatic [%u:0] hmlfc_%s(input [%u:0] %s);\n", width - 1, name,
              index_bits - 1, argument);
  std::printf("  hmlfc_%s = HMLFC_%s_TABLE[%u * %s +: %u];\nendfunction\n", name,
              upper(name).c_str(), width, argument, width);
}

Levels levels_or_one(unsigned code) {
  return code <= kMaxLevelCode ? levels_of_code(code) : Levels{};
}

void put_levels() {
  put_heading("Kinds of digit (BISE-2).");
  for (const auto& [name, digit] :
       {std::pair{"NONE", Digit::kNone}, {"TRIT", Digit::kTrit}, {"QUINT", Digit::kQuint}}) {
    std::printf("localparam [1:0] HMLFC_DIGIT_%s = 2'd%u;\n", name, static_cast<unsigned>(digit));
  }
  put_table(
      "The kind of digit of a level code; the level count of codes beyond 39 is 1 (BISE-1, "
      "BISE-2).",
      "digit_kind", "level_code", 6, 2,
      [](unsigned code) { return static_cast<uint32_t>(levels_or_one(code).digit); });
  put_table("The plain bits n of a level code, [0, 14] (BISE-2).", "plain_bits", "level_code", 6, 4,
            [](unsigned code) { return uint32_t{levels_or_one(code).plain_bits}; });
  put_table("The level count N of a level code, [1, 16384] (BISE-1).", "level_count", "level_code",
            6, 15, [](unsigned code) { return levels_or_one(code).count; });
  put_number("TRITS_IN_GROUP", kTritsPerGroup);
  put_number("QUINTS_IN_GROUP", kQuintsPerGroup);
  put_number("TRIT_GROUP_BITS", kTritGroupBits);
  put_number("QUINT_GROUP_BITS", kQuintGroupBits);
  put_table("The step of a step code, [1, 256] (STP-2).", "step", "step_code", 4, 9,
            [](unsigned code) { return static_cast<uint32_t>(step_of_code(code)); });
}

void put_rtl_tables() {
  std::printf(
      "// Numbers of the specification that the decode unit shares with the golden model.\n"
      "// Generated by generate_tables.cpp from the model's headers: change those, not this file.\n"
      "// Included before a module: constants HMLFC_*, functions hmlfc_* of the compilation unit.\n"
      "`ifndef HMLFC_TABLES_SVH\n"
      "`define HMLFC_TABLES_SVH\n");
  put_errors();
  put_features();
  put_header_offsets();
  put_limits();
  put_levels();
  std::printf("\n`endif\n");
}

void put_shader_number(const std::string& name, uint32_t value) {
  std::printf("const uint %s = %uu;\n", name.c_str(), value);
}

void put_shader_array(const char* comment, const char* name, unsigned count,
                      const std::function<uint32_t(unsigned)>& entry) {
  constexpr unsigned kInLine = 8;
  put_heading(comment);
  std::printf("const uint %s[%u] = uint[%u](", name, count, count);
  for (unsigned i = 0; i < count; ++i) {
    const char* separator = i == 0 ? "" : ",";
    std::printf("%s%s0x%xu", separator, i % kInLine == 0 ? "\n    " : " ", entry(i));
  }
  std::printf(");\n");
}

// Plain bits and kind of digit above the level count.
uint32_t packed_levels(unsigned code) {
  const Levels levels = levels_of_code(code);
  return levels.count | uint32_t{levels.plain_bits} << 16 |
         static_cast<uint32_t>(levels.digit) << 20;
}

void put_shader_digits() {
  put_heading("Kinds of digit, and digit groups (BISE-2, BISE-5, BISE-6).");
  put_shader_number("DIGIT_NONE", static_cast<uint32_t>(Digit::kNone));
  put_shader_number("DIGIT_TRIT", static_cast<uint32_t>(Digit::kTrit));
  put_shader_number("DIGIT_QUINT", static_cast<uint32_t>(Digit::kQuint));
  put_shader_number("TRITS_IN_GROUP", kTritsPerGroup);
  put_shader_number("QUINTS_IN_GROUP", kQuintsPerGroup);
  put_shader_number("TRIT_GROUP_BITS", kTritGroupBits);
  put_shader_number("QUINT_GROUP_BITS", kQuintGroupBits);
}

void put_shader_limits() {
  put_heading("Limits of fields (TIL-8, STP-1, MOT-3, MOT-6).");
  put_shader_number("MAX_LEVEL_CODE_OF_DEPTH_8", max_residual_level_code(8));
  put_shader_number("MAX_STEP_CODE", kMaxStepCode);
  put_shader_number("MAX_EXPLICIT_BITS", kMaxExplicitBits);
  put_shader_number("MAX_DISPARITY_CODE", kMaxDisparityCode);
  std::printf("const int MAX_DISPARITY = %d;\n", kMaxDisparity);
}

void put_shader_tables() {
  std::printf(
      "// Numbers of the specification that the shaders share with the golden model.\n"
      "// Generated by hmlfc_generate_tables from the model's headers: change those, not this "
      "file.\n");
  put_heading("Errors (annex A).");
  for (int code = 0; code < kErrorCodeCount; ++code) {
    put_shader_number("ERROR_" + upper(error_name(static_cast<ErrorCode>(code))),
                      static_cast<uint32_t>(code));
  }
  put_heading("Bits of feature_flags (EXT-1).");
  for (unsigned bit = 0; bit < kFeatureCount; ++bit) {
    put_shader_number("FEATURE_" + upper(feature_name(static_cast<Feature>(bit))), bit);
  }
  put_shader_limits();
  put_shader_digits();
  put_shader_array(
      "By level code: the level count in bits 0-15, plain bits in 16-19, kind of digit above "
      "(BISE-1, BISE-2).",
      "kLevels", kMaxLevelCode + 1, packed_levels);
  put_shader_array("The level code of indices into a palette, by palette_size (MOT-3).",
                   "kPaletteLevelCode", kMaxPaletteEntries,
                   [](unsigned size) { return level_code_for(size + 1); });
}

}  // namespace
}  // namespace hmlfc

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "glsl") {
    hmlfc::put_shader_tables();
  } else {
    hmlfc::put_rtl_tables();
  }
}
