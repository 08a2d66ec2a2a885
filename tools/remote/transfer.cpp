#include "remote/transfer.hpp"

#include <arpa/inet.h>
#include <strings.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include <fmt/format.h>

#include <hmlfc/version.hpp>

namespace hmlfc::remote {
namespace {

constexpr long kMostRedirections = 5;

long seconds(std::chrono::seconds time) { return static_cast<long>(time.count()); }

size_t take_header(char* data, size_t, size_t bytes, void* user) {
  auto& transfer = *static_cast<Transfer*>(user);
  transfer.head_bytes += bytes;
  if (transfer.head_bytes > kMostHeadBytes) return 0;
  transfer.head.take({data, bytes});
  return bytes;
}

// Takes the bytes of a range; ends the transfer at the first byte of anything else.
size_t take_bytes(char* data, size_t, size_t bytes, void* user) {
  auto& transfer = *static_cast<Transfer*>(user);
  const size_t promised = transfer.promised();
  if (transfer.received > promised || bytes > promised - transfer.received) return 0;
  std::memcpy(transfer.request.room.data() + transfer.done + transfer.received, data, bytes);
  transfer.received += bytes;
  return bytes;
}

// Before a request is sent, the first or one after a redirection: libcurl has connected.
int check_place(void* user, char* remote, char*, int port, int) {
  auto& transfer = *static_cast<Transfer*>(user);
  const std::string place = fmt::format("{} {}", remote, port);
  long redirections = 0;
  curl_easy_getinfo(transfer.easy.get(), CURLINFO_REDIRECT_COUNT, &redirections);
  if (redirections == 0) {
    transfer.place = place;
  } else if (place != transfer.place && is_inside(remote)) {
    transfer.leads_inside = true;
    return CURL_PREREQFUNC_ABORT;
  }
  return CURL_PREREQFUNC_OK;
}

// Whether the first `bits` bits of an address are those of `prefix`.
template <size_t N>
bool begins(const std::array<uint8_t, N>& address, std::array<uint8_t, 2> prefix, unsigned bits) {
  const unsigned first = static_cast<unsigned>(address[0] << 8 | address[1]);
  const unsigned wanted = static_cast<unsigned>(prefix[0] << 8 | prefix[1]);
  return (first ^ wanted) >> (16 - bits) == 0;
}

// Of this network, private, shared by a carrier, of the machine, of the link (RFC 6890).
bool is_inside4(const std::array<uint8_t, 4>& a) {
  return begins(a, {0, 0}, 8) || begins(a, {10, 0}, 8) || begins(a, {100, 64}, 10) ||
         begins(a, {127, 0}, 8) || begins(a, {169, 254}, 16) || begins(a, {172, 16}, 12) ||
         begins(a, {192, 168}, 16);
}

}  // namespace

bool is_inside(const std::string& address) {
  std::array<uint8_t, 4> four;
  std::array<uint8_t, 16> six;
  if (inet_pton(AF_INET, address.c_str(), four.data()) == 1) return is_inside4(four);
  const std::string bare = address.substr(0, address.find('%'));
  if (inet_pton(AF_INET6, bare.c_str(), six.data()) != 1) return true;
  if (std::all_of(six.begin(), six.begin() + 10, [](uint8_t byte) { return byte == 0; })) {
    // ::, ::1 and addresses of IPv4 inside those of IPv6
    std::copy(six.begin() + 12, six.end(), four.begin());
    return is_inside4(four);
  }
  return begins(six, {0xFC, 0}, 7) || begins(six, {0xFE, 0x80}, 10);
}

size_t Transfer::promised() const {
  const uint64_t left = request.room.size() - done;
  const bool next = ask == Ask::kRange && head.status == 206 && head.encoding.empty() &&
                    head.range && head.range->first == request.offset + done &&
                    head.range->last - head.range->first < left;
  return next ? static_cast<size_t>(head.range->last - head.range->first + 1) : 0;
}

Easy make_easy(const std::string& address, const Patience& patience) {
  Easy easy(curl_easy_init());
  if (!easy) return easy;
  static curl_slist* const headers = curl_slist_append(nullptr, "Accept-Encoding: identity");
  const bool is_safe = strncasecmp(address.c_str(), "https:", 6) == 0;
  curl_easy_setopt(easy.get(), CURLOPT_URL, address.c_str());
  curl_easy_setopt(easy.get(), CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(easy.get(), CURLOPT_REDIR_PROTOCOLS_STR, is_safe ? "https" : "http,https");
  curl_easy_setopt(easy.get(), CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(easy.get(), CURLOPT_MAXREDIRS, kMostRedirections);
  curl_easy_setopt(easy.get(), CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy.get(), CURLOPT_CONNECTTIMEOUT, seconds(patience.connect));
  curl_easy_setopt(easy.get(), CURLOPT_LOW_SPEED_LIMIT, patience.least_speed);
  curl_easy_setopt(easy.get(), CURLOPT_LOW_SPEED_TIME, seconds(patience.slow));
  curl_easy_setopt(easy.get(), CURLOPT_PREREQFUNCTION, check_place);
  curl_easy_setopt(easy.get(), CURLOPT_USERAGENT, "hmlfc/" HMLFC_VERSION);
  curl_easy_setopt(easy.get(), CURLOPT_HTTPHEADER, headers);
  curl_easy_setopt(easy.get(), CURLOPT_HEADERFUNCTION, take_header);
  curl_easy_setopt(easy.get(), CURLOPT_WRITEFUNCTION, take_bytes);
  return easy;
}

void prepare(Transfer& transfer, const Patience& patience) {
  transfer.head = {};
  transfer.head_bytes = 0;
  transfer.received = 0;
  transfer.reason = {};
  transfer.leads_inside = false;
  CURL* easy = transfer.easy.get();
  const RangeRequest& request = transfer.request;
  const uint64_t end = request.offset + request.room.size();
  const std::string range = transfer.ask == Ask::kEnd
                                ? "-1"
                                : fmt::format("{}-{}", request.offset + transfer.done, end - 1);
  using Clock = std::chrono::steady_clock;
  if (!transfer.deadline) {
    transfer.deadline =
        Clock::now() + patience.base +
        std::chrono::seconds(request.room.size() / static_cast<size_t>(patience.least_speed));
  }
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(*transfer.deadline - Clock::now());
  curl_easy_setopt(easy, CURLOPT_TIMEOUT_MS, static_cast<long>(std::max(left.count(), int64_t{1})));
  curl_easy_setopt(easy, CURLOPT_NOBODY, transfer.ask == Ask::kHead ? 1L : 0L);
  curl_easy_setopt(easy, CURLOPT_PREREQDATA, &transfer);
  curl_easy_setopt(easy, CURLOPT_RANGE, transfer.ask == Ask::kHead ? nullptr : range.c_str());
  curl_easy_setopt(easy, CURLOPT_HEADERDATA, &transfer);
  curl_easy_setopt(easy, CURLOPT_WRITEDATA, &transfer);
  curl_easy_setopt(easy, CURLOPT_PRIVATE, &transfer);
  curl_easy_setopt(easy, CURLOPT_ERRORBUFFER, transfer.reason.data());
}

}  // namespace hmlfc::remote
