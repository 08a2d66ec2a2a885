// The light field that a page shows, intact or not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "cli/view_source.hpp"
#include "view/frame_reads.hpp"

namespace hmlfc::view {

/// A stream opened as far as it can be, and the views that it was made of.
class OpenStream {
 public:
  /// `original` is a folder of views, named as `naming` says, or a stream, or empty. Failures: a
  /// file that cannot be read, or an original of another shape (kInput). A corrupt stream is no
  /// failure.
  OpenStream(const std::filesystem::path& file, const std::filesystem::path& original = {},
             const io::ViewNaming& naming = {});

  /// A stream in memory, which must outlive it, under a name.
  OpenStream(const std::filesystem::path& name, std::span<const uint8_t> bytes);

  const std::filesystem::path& path() const { return path_; }

  /// Why the stream does not open; empty if it does.
  const std::string& error() const { return error_; }

  /// What is wrong with sections of a stream that opens; empty if nothing is.
  const std::string& warning() const { return warning_; }

  /// For frames: what they read is counted in touched(). Failure (kCorrupt) with error().
  const cli::StreamFile& for_frames() const { return opened(for_frames_); }

  /// For everything else; at the same time as frames. Failure (kCorrupt) with error().
  const cli::StreamFile& for_blocks() const { return opened(for_blocks_); }

  FrameReads& touched() { return *touched_; }

  /// Null where there is none.
  const cli::ViewSource* original() const { return original_.get(); }

  /// The original, where it is a stream, to look into; null otherwise.
  OpenStream* twin() const { return twin_.get(); }

 private:
  const cli::StreamFile& opened(const std::unique_ptr<cli::StreamFile>& file) const;
  void open(const std::shared_ptr<const remote::OpenSource>& source);

  std::filesystem::path path_;
  std::unique_ptr<FrameReads> touched_;
  std::unique_ptr<cli::StreamFile> for_frames_;
  std::unique_ptr<cli::StreamFile> for_blocks_;
  std::unique_ptr<cli::ViewSource> original_;
  std::unique_ptr<OpenStream> twin_;
  std::string error_;
  std::string warning_;
};

}  // namespace hmlfc::view
