// An .hmlfc file, open for decoding.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include <hmlfc/decoder.hpp>

#include "io/files.hpp"

namespace hmlfc::cli {

/// A mapped stream with its decoder. All functions throw a Failure that names the file.
class StreamFile {
 public:
  /// Failures: the file cannot be read (kInput), or is not an intact stream (kCorrupt).
  explicit StreamFile(std::filesystem::path path, const OpenOptions& options = {});

  const std::filesystem::path& path() const { return path_; }
  const Decoder& decoder() const { return decoder_; }
  const StreamHeader& header() const { return decoder_.header(); }
  std::span<const uint8_t> bytes() const { return file_.bytes(); }
  uint64_t size() const { return file_.bytes().size(); }

  /// Usage failure unless `view` is in the grid.
  void check_view(ViewPos view) const;

  /// The stop level that uses `levels` levels of the tree, counted from the top; usage failure
  /// unless `levels` lies in [1, tree_height + 1].
  int stop_level(int levels) const;

 private:
  std::filesystem::path path_;
  io::MappedFile file_;
  Decoder decoder_;
};

}  // namespace hmlfc::cli
