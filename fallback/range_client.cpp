// Ranges of files on web servers without libcurl: there are none.
#include "remote/range_client.hpp"

namespace hmlfc::remote {

struct RangeClient::State {};

RangeClient::RangeClient(RangeClient&&) noexcept = default;
RangeClient& RangeClient::operator=(RangeClient&&) noexcept = default;
RangeClient::~RangeClient() = default;

io::IoResult<RangeClient> RangeClient::open(const std::string& address, size_t, const Patience&) {
  return tl::unexpected(io::IoError{
      address + ": this program was built without libcurl; fetch the file, and give its name"});
}

uint64_t RangeClient::size() const { return 0; }
std::span<const uint8_t> RangeClient::first_bytes() const { return {}; }
io::IoResult<void> RangeClient::fetch(std::span<const RangeRequest>) { return {}; }

}  // namespace hmlfc::remote
