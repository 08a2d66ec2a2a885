// What frames read of a stream, apart from what is decoded ahead of them.
#pragma once

#include <hmlfc/key_prefetcher.hpp>
#include <hmlfc/read_sink.hpp>

namespace hmlfc::view {

/// TouchedBytes without the reads of prefetchers. Functions of TouchedBytes that may not be called
/// while another thread decodes may be called while a prefetcher does.
class FrameReads final : public ReadSink {
 public:
  explicit FrameReads(uint64_t file_bytes) : touched_(file_bytes) {}

  void on_read(uint64_t offset, uint64_t bytes) override {
    if (!KeyPrefetcher::is_this_thread()) touched_.on_read(offset, bytes);
  }
  void on_key_plane(uint64_t samples) override {
    if (!KeyPrefetcher::is_this_thread()) touched_.on_key_plane(samples);
  }

  /// As TouchedBytes has them.
  uint64_t bytes() const { return touched_.bytes(); }
  uint64_t key_samples() const { return touched_.key_samples(); }
  void reset() { touched_.reset(); }

 private:
  TouchedBytes touched_;
};

}  // namespace hmlfc::view
