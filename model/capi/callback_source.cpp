#include "capi/callback_source.hpp"

#include <vector>

namespace hmlfc::capi {
namespace {

SparseSource::Keeping keeping_of(const hmlfc_source& source) {
  SparseSource::Keeping keeping;
  if (source.cache_bytes != 0) keeping.cache_bytes = source.cache_bytes;
  return keeping;
}

}  // namespace

CallbackSource::CallbackSource(const hmlfc_source& source)
    : SparseSource(source.size, keeping_of(source)), source_(source) {}

std::string CallbackSource::fetch(std::span<const ByteRange> ranges) {
  std::vector<hmlfc_read> reads;
  reads.reserve(ranges.size());
  for (const ByteRange& range : ranges) {
    reads.push_back({range.offset, static_cast<size_t>(range.bytes), room(range).data()});
  }
  const int result = source_.read(source_.user, reads.data(), reads.size());
  if (result == 0) return {};
  return "bus_error: the function of the source returned " + std::to_string(result);
}

}  // namespace hmlfc::capi
