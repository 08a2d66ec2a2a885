// What is behind the handles of hmlfc.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <hmlfc/hmlfc.h>
#include <hmlfc/decoder.hpp>

#include "bits/map_file.hpp"

namespace hmlfc::capi {

/// The bytes of a stream, of the caller or of a mapped file, and its decoder. Decoder and renderers
/// share it.
class OpenedStream {
 public:
  OpenedStream(std::span<const uint8_t> bytes, bool is_mapped)
      : bytes_(bytes), is_mapped_(is_mapped) {}
  OpenedStream(const OpenedStream&) = delete;
  OpenedStream& operator=(const OpenedStream&) = delete;
  ~OpenedStream() {
    decoder_.reset();
    if (is_mapped_) unmap_file(bytes_);
  }

  /// Errors: those of Decoder::open.
  Result<void> open(const OpenOptions& options) {
    auto opened = Decoder::open(bytes_, options);
    if (!opened) return tl::unexpected(opened.error());
    decoder_ = std::move(*opened);
    return {};
  }

  /// After open() has succeeded.
  const Decoder& decoder() const { return *decoder_; }

 private:
  std::span<const uint8_t> bytes_;
  bool is_mapped_;
  std::optional<Decoder> decoder_;
};

}  // namespace hmlfc::capi

struct hmlfc_decoder {
  std::shared_ptr<const hmlfc::capi::OpenedStream> stream;
};
