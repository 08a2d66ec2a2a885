// The interface to which a decoder reports what it reads of a stream, and a counter.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include <hmlfc/export.hpp>

namespace hmlfc {

/// Receives what a decoder reads to answer requests; what it reads to open the stream is not
/// reported. Several threads call it at once.
class HMLFC_EXPORT ReadSink {
 public:
  virtual ~ReadSink() = default;

  /// `bytes` bytes from `offset` on, counted from the start of the file: of the index, of tile
  /// records and of key images.
  virtual void on_read(uint64_t offset, uint64_t bytes) = 0;

  /// A plane of a key image, of `samples` samples, which is decoded whole (KEY-3) and kept.
  virtual void on_key_plane(uint64_t samples) { static_cast<void>(samples); }
};

/// Counts the bytes read since the last reset(), each byte once, in whole lines of kLineBytes as
/// memory fetches them, and the samples of key images decoded. Costs one bit a line of the file.
class HMLFC_EXPORT TouchedBytes final : public ReadSink {
 public:
  static constexpr uint64_t kLineBytes = 64;  ///< bytes of a line

  /// For a file of at most `file_bytes` bytes.
  explicit TouchedBytes(uint64_t file_bytes);

  void on_read(uint64_t offset, uint64_t bytes) override;
  void on_key_plane(uint64_t samples) override { key_samples_ += samples; }

  /// Bytes of the lines read, a multiple of kLineBytes. Not while another thread decodes.
  uint64_t bytes() const;

  /// Samples of the key planes decoded.
  uint64_t key_samples() const { return key_samples_; }

  /// Starts again from 0. Not while another thread decodes.
  void reset();

 private:
  std::vector<uint64_t> lines_;  // one bit a line
  std::atomic<uint64_t> key_samples_ = 0;
};

}  // namespace hmlfc
