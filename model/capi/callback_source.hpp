// A source whose bytes a function of hmlfc.h's caller fetches.
#pragma once

#include <span>
#include <string>

#include <hmlfc/hmlfc.h>

#include "bits/sparse_source.hpp"

namespace hmlfc::capi {

class CallbackSource final : public SparseSource {
 public:
  /// `source` as its checks let it pass; its function is called as hmlfc_open_source() says.
  explicit CallbackSource(const hmlfc_source& source);

 private:
  std::string fetch(std::span<const ByteRange> ranges) override;

  hmlfc_source source_;
};

}  // namespace hmlfc::capi
