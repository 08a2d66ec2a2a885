#include "remote/http_source.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace hmlfc::remote {
namespace {

// Holds the header and the TOP table of most streams.
constexpr size_t kFirstBytes = SparseBytes::kPageBytes;
// Longer ranges are several requests, which go side by side.
constexpr uint64_t kMostRequestBytes = uint64_t{4} << 20;

}  // namespace

bool is_address(const std::filesystem::path& path) {
  std::string scheme = path.string().substr(0, 8);
  for (char& c : scheme) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return scheme.starts_with("http://") || scheme == "https://";
}

HttpSource::HttpSource(RangeClient client, const HttpOptions& options)
    : options_(options), client_(std::move(client)), file_(client_.size()) {}

io::IoResult<std::unique_ptr<HttpSource>> HttpSource::open(const std::string& address,
                                                           const HttpOptions& options) {
  auto client = RangeClient::open(address, kFirstBytes);
  if (!client) return tl::unexpected(client.error());
  std::unique_ptr<HttpSource> source(new HttpSource(std::move(*client), options));
  if (!source->file_.is_reserved()) {
    return io::file_error(address, "there is no address space for a file of this length");
  }
  const auto first = source->client_.first_bytes();
  const ByteRange range{0, first.size()};
  std::ranges::copy(first, source->file_.room(range).begin());
  source->file_.set_loaded(range);
  source->count({range});
  return source;
}

bool HttpSource::load(std::span<const ByteRange> ranges) {
  const std::lock_guard lock(loading_);
  if (failed_.load(std::memory_order_relaxed)) return false;
  const auto missing = file_.missing(ranges, options_.gap);
  if (missing.empty()) return true;
  if (const auto fetched = fetch(missing); !fetched) {
    failure_ = fetched.error().message;
    failed_.store(true, std::memory_order_release);
    return false;
  }
  return true;
}

io::IoResult<void> HttpSource::fetch(const std::vector<ByteRange>& ranges) {
  std::vector<ByteRange> parts;
  for (ByteRange left : ranges) {
    for (; left.bytes > 0;) {
      const uint64_t bytes = std::min(left.bytes, kMostRequestBytes);
      parts.push_back({left.offset, bytes});
      left = {left.offset + bytes, left.bytes - bytes};
    }
  }
  std::vector<RangeRequest> requests;
  for (const ByteRange& part : parts) requests.push_back({part.offset, file_.room(part)});
  if (auto ok = client_.fetch(requests); !ok) return ok;
  for (const ByteRange& part : parts) file_.set_loaded(part);
  count(parts);
  return {};
}

void HttpSource::count(const std::vector<ByteRange>& ranges) {
  ++counts_.rounds;
  counts_.requests += ranges.size();
  for (const ByteRange& range : ranges) counts_.bytes += range.bytes;
}

void HttpSource::begin_request() {
  const std::lock_guard lock(requests_mutex_);
  ++requests_;
}

void HttpSource::end_request() {
  const std::lock_guard lock(requests_mutex_);
  if (--requests_ > 0) return;
  const std::lock_guard loading(loading_);
  file_.drop_to(options_.cache_bytes);
  file_.tick();
}

std::string HttpSource::failure() const {
  return failed_.load(std::memory_order_acquire) ? failure_ : std::string();
}

FetchCounts HttpSource::counts() const {
  const std::lock_guard lock(loading_);
  return counts_;
}

uint64_t HttpSource::held_bytes() const {
  const std::lock_guard lock(loading_);
  return file_.held_bytes();
}

}  // namespace hmlfc::remote
