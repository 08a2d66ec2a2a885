#include "remote/transfer.hpp"

#include <cstring>

#include <fmt/format.h>

#include <hmlfc/version.hpp>

namespace hmlfc::remote {
namespace {

constexpr long kMostRedirections = 5;
constexpr long kConnectSeconds = 10;
constexpr long kSilentSeconds = 20;

size_t take_header(char* data, size_t, size_t bytes, void* transfer) {
  static_cast<Transfer*>(transfer)->head.take({data, bytes});
  return bytes;
}

// Takes the bytes of a range; ends the transfer at the first byte of anything else.
size_t take_bytes(char* data, size_t, size_t bytes, void* user) {
  auto& transfer = *static_cast<Transfer*>(user);
  const AnswerHead& head = transfer.head;
  if (head.status != 206 || !head.range || head.range->first != transfer.request.offset ||
      bytes > transfer.request.room.size() - transfer.received) {
    return 0;
  }
  std::memcpy(transfer.request.room.data() + transfer.received, data, bytes);
  transfer.received += bytes;
  return bytes;
}

}  // namespace

Easy make_easy(const std::string& address) {
  Easy easy(curl_easy_init());
  if (!easy) return easy;
  const char* schemes = address.starts_with("https:") ? "https" : "http,https";
  curl_easy_setopt(easy.get(), CURLOPT_URL, address.c_str());
  curl_easy_setopt(easy.get(), CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(easy.get(), CURLOPT_REDIR_PROTOCOLS_STR, schemes);
  curl_easy_setopt(easy.get(), CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(easy.get(), CURLOPT_MAXREDIRS, kMostRedirections);
  curl_easy_setopt(easy.get(), CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy.get(), CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  curl_easy_setopt(easy.get(), CURLOPT_LOW_SPEED_LIMIT, 1L);
  curl_easy_setopt(easy.get(), CURLOPT_LOW_SPEED_TIME, kSilentSeconds);
  curl_easy_setopt(easy.get(), CURLOPT_USERAGENT, "hmlfc/" HMLFC_VERSION);
  curl_easy_setopt(easy.get(), CURLOPT_HEADERFUNCTION, take_header);
  curl_easy_setopt(easy.get(), CURLOPT_WRITEFUNCTION, take_bytes);
  return easy;
}

void prepare(Transfer& transfer) {
  transfer.head = {};
  transfer.received = 0;
  transfer.reason = {};
  CURL* easy = transfer.easy.get();
  const RangeRequest& request = transfer.request;
  const std::string range =
      fmt::format("{}-{}", request.offset, request.offset + request.room.size() - 1);
  curl_easy_setopt(easy, CURLOPT_RANGE, range.c_str());
  curl_easy_setopt(easy, CURLOPT_HEADERDATA, &transfer);
  curl_easy_setopt(easy, CURLOPT_WRITEDATA, &transfer);
  curl_easy_setopt(easy, CURLOPT_PRIVATE, &transfer);
  curl_easy_setopt(easy, CURLOPT_ERRORBUFFER, transfer.reason.data());
}

}  // namespace hmlfc::remote
