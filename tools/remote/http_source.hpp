// A stream on a web server: only what is needed of it is fetched.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <hmlfc/byte_source.hpp>

#include "remote/range_client.hpp"
#include "remote/sparse_bytes.hpp"

namespace hmlfc::remote {

/// Whether `path` is an address, http:// or https://, in place of a file's name.
bool is_address(const std::filesystem::path& path);

/// What was fetched since a file was opened, that included.
struct FetchCounts {
  uint64_t requests = 0;  ///< of ranges
  uint64_t bytes = 0;     ///< of the file
  uint64_t rounds = 0;    ///< calls that fetched something: each waits for all its requests
};

/// How a file is fetched.
struct HttpOptions {
  uint64_t gap = 1024;  ///< ranges at most so many bytes apart are one request
  uint64_t cache_bytes = uint64_t{256} << 20;  ///< kept between requests of the decoder
};

/// The file at an address, as ranges of it are needed. Bytes are kept in whole lines of 64; when no
/// request of a decoder is left and more than cache_bytes are kept, pages go, those used longest
/// ago first. After a failure it loads nothing more.
class HttpSource final : public ByteSource {
 public:
  /// Errors: those of RangeClient::open; no address space for a file of this length.
  static io::IoResult<std::unique_ptr<HttpSource>> open(const std::string& address,
                                                        const HttpOptions& options = {});

  std::span<const uint8_t> bytes() const override { return file_.bytes(); }
  bool is_partial() const override { return true; }
  bool holds(ByteRange range) const override { return file_.holds(range); }
  bool load(std::span<const ByteRange> ranges) override;
  void begin_request() override;
  void end_request() override;
  std::string failure() const override;

  FetchCounts counts() const;

  /// Bytes of memory that the file takes now.
  uint64_t held_bytes() const;

 private:
  HttpSource(RangeClient client, const HttpOptions& options);

  io::IoResult<void> fetch(const std::vector<ByteRange>& ranges);
  void count(const std::vector<ByteRange>& ranges);

  const HttpOptions options_;
  RangeClient client_;
  SparseBytes file_;
  mutable std::mutex loading_;
  std::string failure_;
  std::atomic<bool> failed_ = false;  // failure_ is written before
  FetchCounts counts_;
  std::mutex requests_mutex_;
  uint64_t requests_ = 0;  // of decoders
};

}  // namespace hmlfc::remote
