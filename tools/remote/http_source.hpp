// A stream on a web server: only what is needed of it is fetched.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bits/sparse_source.hpp"
#include "remote/range_client.hpp"

namespace hmlfc::remote {

/// Whether `path` is an address, http:// or https://, in place of a file's name.
bool is_address(const std::filesystem::path& path);

/// What was fetched since a file was opened, that included.
struct FetchCounts {
  uint64_t requests = 0;  ///< of ranges
  uint64_t bytes = 0;     ///< of the file
  uint64_t rounds = 0;    ///< calls that fetched something: each waits for all its requests
};

/// The file at an address, as ranges of it are needed.
class HttpSource final : public SparseSource {
 public:
  /// Errors: those of RangeClient::open; no address space for a file of this length.
  static io::IoResult<std::unique_ptr<HttpSource>> open(const std::string& address,
                                                        const Keeping& keeping = {});

  FetchCounts counts() const;

 private:
  HttpSource(RangeClient client, const Keeping& keeping);

  std::string fetch(std::span<const ByteRange> ranges) override;
  void count(const std::vector<ByteRange>& ranges);

  RangeClient client_;
  FetchCounts counts_;
};

}  // namespace hmlfc::remote
