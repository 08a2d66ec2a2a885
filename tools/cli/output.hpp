// Results on standard output, numbers as people read them, and places to write to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace hmlfc::cli {

/// JSON with its keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// Writes `text` to standard output. Failure (kOutput) where it cannot be written.
void print(std::string_view text);

/// Writes `json` on indented lines.
void print_json(const Json& json);

/// Hands everything printed to the system. Failure as print().
void flush_output();

/// One line for the user on standard error.
void note(const std::string& message);

/// A PSNR for JSON: the number of dB, or the text "inf" for identical pictures, which JSON cannot
/// hold as a number.
Json psnr_json(double db);

/// "39.21 dB" or "inf".
std::string psnr_text(double db);

/// "1 234 567": digits in groups of three.
std::string grouped(uint64_t number);

/// Throws a usage failure unless a file can be written at `file`; leaves nothing there.
void check_output_file(const std::filesystem::path& file);

/// Makes `folder` and its parents where they are missing; a usage failure if that is impossible.
void make_output_folder(const std::filesystem::path& folder);

}  // namespace hmlfc::cli
