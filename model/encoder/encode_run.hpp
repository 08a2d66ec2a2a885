// What every run of the encoder shares: parameter checks, threads, progress.
#pragma once

#include <algorithm>
#include <mutex>
#include <new>

#include <hmlfc/encoder.hpp>

#include "bits/parallel.hpp"
#include "encoder/encode_session.hpp"

namespace hmlfc {

/// Counts finished images and reports them, one thread at a time.
class ProgressCounter {
 public:
  /// `progress` may be empty and must outlive the counter.
  ProgressCounter(const Progress& progress, uint64_t total) : progress_(progress), total_(total) {}

  void add() {
    if (!progress_) return;
    const std::scoped_lock lock(mutex_);
    done_ = std::min(done_ + 1, total_);
    progress_(done_, total_);
  }

 private:
  const Progress& progress_;
  uint64_t total_;
  uint64_t done_ = 0;
  std::mutex mutex_;
};

/// Runs `body` on `threads` threads (0: all cores); running out of memory becomes an error.
template <class Body>
tl::expected<EncodedStream, EncodeError> run_encoder(int threads, const Body& body) {
  try {
    tl::expected<EncodedStream, EncodeError> encoded;
    run_on_threads(threads, [&] { encoded = body(); });
    return encoded;
  } catch (const std::bad_alloc&) {
    return tl::unexpected(
        EncodeError{"out of memory: encode fewer or smaller views, or free some memory"});
  }
}

/// header_for() with its error in words.
inline tl::expected<StreamHeader, EncodeError> checked_header(const LightFieldShape& shape,
                                                              const EncodeParams& params) {
  auto header = header_for(shape, params);
  if (header) return *header;
  return tl::unexpected(
      EncodeError{"an encoding parameter is outside its interval (see hmlfc encode --help)"});
}

/// Checks `params` before anything is done: a group that is left to the encoder counts as 1 x 1.
inline tl::expected<void, EncodeError> check_params(const LightFieldShape& shape,
                                                    const EncodeParams& params) {
  EncodeParams settled = params;
  if (params.profile == Profile::kExtended) {
    settled.ref_rows = std::max(1u, params.ref_rows);
    settled.ref_cols = std::max(1u, params.ref_cols);
    if (!(params.quality >= 0 && params.quality <= 100)) {
      return tl::unexpected(EncodeError{"the quality is outside [0, 100]"});
    }
  }
  const auto header = checked_header(shape, settled);
  if (!header) return tl::unexpected(header.error());
  return {};
}

}  // namespace hmlfc
