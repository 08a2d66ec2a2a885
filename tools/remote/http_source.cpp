#include "remote/http_source.hpp"

#include <algorithm>
#include <utility>

#include "io/files.hpp"

namespace hmlfc::remote {
namespace {

// Holds the header and the TOP table of most streams.
constexpr size_t kFirstBytes = SparseBytes::kPageBytes;
// Longer ranges are several requests, which go side by side.
constexpr uint64_t kMostRequestBytes = uint64_t{4} << 20;

}  // namespace

bool is_address(const std::filesystem::path& path) {
  const std::string scheme = io::lower_case(path.string().substr(0, 8));
  return scheme.starts_with("http://") || scheme == "https://";
}

HttpSource::HttpSource(RangeClient client, const Keeping& keeping)
    : SparseSource(client.size(), keeping), client_(std::move(client)) {}

io::IoResult<std::unique_ptr<HttpSource>> HttpSource::open(const std::string& address,
                                                           const Keeping& keeping) {
  auto client = RangeClient::open(address, kFirstBytes);
  if (!client) return tl::unexpected(client.error());
  std::unique_ptr<HttpSource> source(new HttpSource(std::move(*client), keeping));
  if (!source->is_reserved()) {
    return io::memory_error(address, "to map a file of this length");
  }
  const auto first = source->client_.first_bytes();
  const ByteRange range{0, first.size()};
  std::ranges::copy(first, source->room(range).begin());
  source->set_loaded(range);
  source->count({range});
  return source;
}

std::string HttpSource::fetch(std::span<const ByteRange> ranges) {
  std::vector<ByteRange> parts;
  for (ByteRange left : ranges) {
    for (; left.bytes > 0;) {
      const uint64_t bytes = std::min(left.bytes, kMostRequestBytes);
      parts.push_back({left.offset, bytes});
      left = {left.offset + bytes, left.bytes - bytes};
    }
  }
  std::vector<RangeRequest> requests;
  for (const ByteRange& part : parts) requests.push_back({part.offset, room(part)});
  if (const auto ok = client_.fetch(requests); !ok) return ok.error().message;
  count(parts);
  return {};
}

void HttpSource::count(const std::vector<ByteRange>& ranges) {
  ++counts_.rounds;
  counts_.requests += ranges.size();
  for (const ByteRange& range : ranges) counts_.bytes += range.bytes;
}

FetchCounts HttpSource::counts() const {
  const std::lock_guard lock(fetching());
  return counts_;
}

}  // namespace hmlfc::remote
