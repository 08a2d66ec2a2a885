// A partial source that keeps what it has fetched.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>

#include <hmlfc/byte_source.hpp>

#include "bits/sparse_bytes.hpp"

namespace hmlfc {

/// A file whose bytes are fetched when they are needed, in whole lines of 64. When no request of a
/// decoder is left and more than cache_bytes are kept, pages go, those used longest ago first.
/// After a failure it fetches nothing more.
class SparseSource : public ByteSource {
 public:
  /// How a file is kept.
  struct Keeping {
    uint64_t gap = 1024;  ///< ranges at most so many bytes apart are fetched as one
    uint64_t cache_bytes = uint64_t{256} << 20;  ///< kept between requests of the decoder
  };

  std::span<const uint8_t> bytes() const override { return file_.bytes(); }
  bool is_partial() const override { return true; }
  bool holds(ByteRange range) const override { return file_.holds(range); }
  bool load(std::span<const ByteRange> ranges) override;
  void begin_request() override;
  void end_request() override;
  std::string failure() const override;

  /// Whether the address space suffices for the file; else nothing may be loaded.
  bool is_reserved() const { return file_.is_reserved(); }

  /// Bytes of memory that the file takes now.
  uint64_t held_bytes() const;

 protected:
  /// Nothing is loaded of `size` bytes.
  SparseSource(uint64_t size, const Keeping& keeping) : keeping_(keeping), file_(size) {}

  /// Fetches `ranges`, ascending and disjoint, to room(). One thread calls it at a time. Returns
  /// why it cannot, a line for people; "" for success.
  virtual std::string fetch(std::span<const ByteRange> ranges) = 0;

  /// Where the bytes of `range` belong.
  std::span<uint8_t> room(ByteRange range) { return file_.room(range); }

  /// `range`, from the start of the file, has been fetched before the first request.
  void set_loaded(ByteRange range) { file_.set_loaded(range); }

  /// Held while fetch() runs.
  std::mutex& fetching() const { return fetching_; }

 private:
  const Keeping keeping_;
  SparseBytes file_;
  mutable std::mutex fetching_;
  std::string failure_;
  std::atomic<bool> failed_ = false;  // failure_ is written before
  std::mutex requests_mutex_;
  uint64_t requests_ = 0;  // of decoders
};

}  // namespace hmlfc
