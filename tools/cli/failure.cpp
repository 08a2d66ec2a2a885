#include "cli/failure.hpp"

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

}  // namespace

Failure stream_failure(const std::filesystem::path& file, const Error& error) {
  return Failure(exit_code_of(error.code), file.string() + ": " + to_string(error));
}

}  // namespace hmlfc::cli
