// Light fields that are encoded part by part, with views read when they are needed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include <hmlfc/code_storage.hpp>
#include <hmlfc/divided_encoder.hpp>

#include "cli/encode_outcome.hpp"
#include "cli/view_source.hpp"
#include "io/scratch_file.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::cli {

/// Adds --memory, --plan, --shard and --assemble.
void add_division_options(CLI::App& app, EncodeOptions& options);

/// Usage failure where these and other options contradict each other.
void check_division(const EncodeOptions& options);

/// A nameless file beside `output`. Its functions throw a Failure (kOutput).
class StorageFile final : public CodeStorage {
 public:
  explicit StorageFile(const std::filesystem::path& output);

  uint64_t append(std::span<const uint8_t> bytes) override;
  void read(uint64_t offset, std::span<uint8_t> out) const override;

 private:
  io::ScratchFile file_;
};

/// Views that are read when they are needed, and the rig of their stream.
struct DividedInput {
  io::ViewList list;
  std::unique_ptr<ViewSource> views;
  std::optional<ChosenRig> rig;
};

/// Finds the views that `options` name. Failures: those of reading a folder (kInput).
DividedInput open_input(const EncodeOptions& options);

/// An encoder of `input`. Failure: parameters that it refuses (kInput).
DividedEncoder divided_encoder(const EncodeOptions& options, const DividedInput& input,
                               const EncodeParams& params, const Division& division,
                               StorageFile& storage);

/// Encodes parts [first, last).
void encode_parts(DividedEncoder& encoder, const EncodeOptions& options, size_t first, size_t last);

/// Writes the stream, all of whose parts are there, and compares it with the views part by part.
EncodeOutcome finish_encoding(const EncodeOptions& options, const DividedInput& input,
                              const DividedEncoder& encoder, const Clock& clock);

/// Encodes in the bounds of --memory.
EncodeOutcome encode_in_parts(const EncodeOptions& options);

}  // namespace hmlfc::cli
