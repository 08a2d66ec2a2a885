#include "cli/output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/files.hpp"
#include "io/json_text.hpp"
#include "io/view_list.hpp"
#include "terminal/shown.hpp"

namespace hmlfc::cli {

namespace {

ExitCode exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kLimitExceeded:
      return ExitCode::kInput;
    case ErrorCode::kOutOfMemory:
      return ExitCode::kOutOfMemory;
    case ErrorCode::kBadRequest:
      return ExitCode::kInternal;  // commands check what they ask for
    default:
      return ExitCode::kCorrupt;
  }
}

// What a file that is no stream is by its name, and what takes it; null: not known.
const char* other_kind(const std::filesystem::path& file) {
  const std::string extension = io::lower_case_extension(file);
  if (extension == ".y4m") return "a video; hmlfc encode makes a stream of it";
  if (io::is_other_video(file)) {
    return "a video of another kind; ffmpeg -i VIDEO OUT.y4m makes one that hmlfc encode takes";
  }
  if (extension == ".pfm") return "a map; hmlfc compare takes two of them";
  if (!io::is_picture_name("a" + extension)) return nullptr;
  return "one picture; hmlfc encode makes a stream of a folder of them, or of a quilt";
}

// A reader that has seen enough (`hmlfc vectors list | head`) needs no message.
[[noreturn]] void throw_output_failure() {
  if (errno == EPIPE) throw Failure(ExitCode::kOutput, "");
  throw Failure(ExitCode::kOutput,
                "standard output: cannot write: " + std::generic_category().message(errno));
}

// Where print() writes.
std::FILE*& results() {
  static std::FILE* file = stdout;
  return file;
}

}  // namespace

Failure stream_failure(const std::filesystem::path& file, const Error& error) {
  const bool begins = error.code != ErrorCode::kBadMagic && error.code != ErrorCode::kTruncated;
  if (const char* kind = begins ? nullptr : other_kind(file)) {
    return Failure(ExitCode::kInput, file.string() + ": not a stream, but " + kind);
  }
  return Failure(exit_code_of(error.code), file.string() + ": " + to_string(error));
}

void print(std::string_view text) {
  const std::string safe = terminal::shown(text);
  if (std::fwrite(safe.data(), 1, safe.size(), results()) != safe.size()) throw_output_failure();
}

void print_to_standard_error() { results() = stderr; }

void write_standard_output(std::span<const uint8_t> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) throw_output_failure();
}

void print_json(const Json& json) { print(io::json_text(json, 2) + "\n"); }

void print_result(bool as_json, const Json& json, std::string_view text) {
  as_json ? print_json(json) : print(text);
}

void flush_output() {
  if (std::fflush(stdout) != 0) throw_output_failure();
}

void note(const std::string& message) {
  const std::string clear = ::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "";
  std::fputs((clear + terminal::shown(message) + "\n").c_str(), stderr);
}

void tell(const io::Notes& notes) {
  for (const std::string& line : notes.lines()) note(line);
}

Json psnr_json(double db) {
  if (std::isinf(db)) return "inf";
  return db;
}

std::string psnr_text(double db) { return std::isinf(db) ? "inf" : fmt::format("{:.2f} dB", db); }

std::string grouped(uint64_t number) {
  std::string digits = std::to_string(number);
  for (size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ' ');
  return digits;
}

}  // namespace hmlfc::cli
