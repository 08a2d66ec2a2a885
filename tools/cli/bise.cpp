// hmlfc bise: encodes and decodes single bounded integer sequences.
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "arithmetic/bise.hpp"
#include "cli/arguments.hpp"

namespace hmlfc::cli {
namespace {

constexpr uint32_t kMaxCount = 1u << 20;

struct BiseOptions {
  Levels levels;
  uint32_t count = 0;
  std::vector<std::string> values;
  std::string hex;
};

Failure usage(const std::string& message) { return Failure(ExitCode::kUsage, message); }

std::string allowed_levels() {
  std::vector<uint32_t> counts;
  for (unsigned code = 0; code <= kMaxLevelCode; ++code)
    counts.push_back(levels_of_code(code).count);
  return fmt::format("{}", fmt::join(counts, " "));
}

CLI::Option* add_levels_of_bise(CLI::App& app, Levels& target) {
  const auto reader = [&target](const std::string& text) {
    const auto count = parse_integer<uint32_t>(text);
    for (unsigned code = 0; count && code <= kMaxLevelCode; ++code) {
      target = levels_of_code(code);
      if (target.count == *count) return true;
    }
    return false;
  };
  return add_value(app, "LEVELS", "", "Level count: 2^n, 3 * 2^n or 5 * 2^n",
                   "a level count; allowed are " + allowed_levels(), reader)
      ->required();
}

std::vector<uint8_t> bytes_of(const std::string& hex) {
  std::vector<uint8_t> bytes;
  for (size_t at = 0; at + 2 <= hex.size(); at += 2) {
    uint8_t byte = 0;
    const char* begin = hex.data() + at;
    const auto [last, error] = std::from_chars(begin, begin + 2, byte, 16);
    if (error != std::errc{} || last != begin + 2) throw usage("'" + hex + "' is not hexadecimal");
    bytes.push_back(byte);
  }
  if (hex.size() % 2 != 0) throw usage("'" + hex + "' is not a whole number of bytes");
  return bytes;
}

ExitCode run_bise_enc(const BiseOptions& options) {
  std::vector<uint32_t> values;
  for (const std::string& text : options.values) {
    const auto value = parse_integer<uint32_t>(text);
    if (!value || *value >= options.levels.count) {
      throw usage(fmt::format("'{}' is not a value in [0, {}]", text, options.levels.count - 1));
    }
    values.push_back(*value);
  }
  BitWriter writer;
  bise_put(writer, options.levels, values);
  print(fmt::format("{} {:02x}\n", writer.size(), fmt::join(writer.bytes(), "")));
  return ExitCode::kDone;
}

ExitCode run_bise_dec(const BiseOptions& options) {
  const std::vector<uint8_t> bytes = bytes_of(options.hex);
  const uint64_t bits = bise_bits(options.levels, options.count);
  const uint64_t needed = (bits + 7) / 8;
  if (bytes.size() != needed) {
    throw usage(fmt::format("{} values of {} levels take {} bits, that is {} bytes, but HEX has {}",
                            options.count, options.levels.count, bits, needed, bytes.size()));
  }
  const BitString string(bytes);
  std::vector<uint32_t> values;
  for (uint32_t i = 0; i < options.count; ++i) {
    values.push_back(bise_value(string, 0, options.levels, options.count, i));
  }
  print(fmt::format("{}\n", fmt::join(values, " ")));
  return ExitCode::kDone;
}

}  // namespace

void add_bise(CLI::App& program, Task& task) {
  CLI::App* bise = program.add_subcommand("bise", "Encode or decode a bounded integer sequence");
  bise->require_subcommand(1);
  bise->footer("Example:\n  hmlfc bise enc 12 0 11 5 7 3");

  const auto [enc, values] = add_command(
      *bise, task, "enc", "Print the bits of values", run_bise_enc,
      R"(Prints BITS HEX: the bit count, then the bytes; bit k of the sequence is bit k & 7 of byte k >> 3.

Example:
  hmlfc bise enc 12 0 11 5 7 3)");
  add_levels_of_bise(enc, values.levels);
  enc.add_option("V", values.values, "Values in [0, LEVELS - 1]")->required()->type_name("");

  const auto [dec, bits] = add_command(*bise, task, "dec", "Print the values of bits", run_bise_dec,
                                       R"(Prints the values, separated by spaces.

Example:
  hmlfc bise dec 12 5 ec5b03)");
  add_levels_of_bise(dec, bits.levels);
  add_integer(dec, "COUNT", bits.count, 1, kMaxCount, "Number of values")
      ->required()
      ->type_name("")
      ->default_str("");
  dec.add_option("HEX", bits.hex, "The bytes that bise enc printed")->type_name("");
}

}  // namespace hmlfc::cli
