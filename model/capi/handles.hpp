// Defines what the handles of hmlfc.h point to.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <hmlfc/hmlfc.h>
#include <hmlfc/byte_source.hpp>
#include <hmlfc/decoder.hpp>

#include "capi/outcome.hpp"

namespace hmlfc::capi {

/// Where the bytes of a stream come from, and its decoder. Decoder and renderers share it.
class OpenedStream {
 public:
  explicit OpenedStream(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {}

  /// Errors: those of Decoder::open.
  Result<void> open(const OpenOptions& options) {
    auto opened = Decoder::open(*source_, options);
    if (!opened) return tl::unexpected(opened.error());
    decoder_ = std::move(*opened);
    return {};
  }

  /// After open() has succeeded.
  const Decoder& decoder() const { return *decoder_; }

  /// Refuses for `error`, an answer of the decoder: of a source that failed with what it says.
  tl::unexpected<Refusal> refuse(const Error& error) const {
    const std::string failure = source_->is_partial() ? source_->failure() : "";
    return failure.empty() ? capi::refuse(error) : capi::refuse(HMLFC_STATUS_BUS_ERROR, failure);
  }

 private:
  std::unique_ptr<ByteSource> source_;
  std::optional<Decoder> decoder_;
};

}  // namespace hmlfc::capi

struct hmlfc_decoder {
  std::shared_ptr<const hmlfc::capi::OpenedStream> stream;
};
