// One range on its way from a web server, by libcurl.
#pragma once

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remote/answer.hpp"
#include "remote/range_client.hpp"

namespace hmlfc::remote {

struct EasyCleaner {
  void operator()(CURL* easy) const { curl_easy_cleanup(easy); }
};
struct MultiCleaner {
  void operator()(CURLM* multi) const { curl_multi_cleanup(multi); }
};
using Easy = std::unique_ptr<CURL, EasyCleaner>;
using Multi = std::unique_ptr<CURLM, MultiCleaner>;

/// What a server is asked.
enum class Ask : uint8_t {
  kRange,
  kEnd,   ///< the last byte, for its number: only the headers are read
  kHead,  ///< the method HEAD, for the length
};

/// A range that is asked for. It stays at its place: libcurl has its address. An answer may bring
/// less than was asked for (RFC 9110, section 15.3.7); then the rest is asked for.
struct Transfer {
  Easy easy;
  Ask ask = Ask::kRange;
  RangeRequest request;
  bool whole = true;  ///< the range lies in the file; else its beginning may
  AnswerHead head;
  size_t head_bytes = 0;  ///< of all answers, with what follows the last chunk
  size_t done = 0;        ///< bytes of the range that whole answers have brought
  size_t received = 0;    ///< those of this answer, which come next
  std::optional<std::chrono::steady_clock::time_point> deadline;  ///< of all answers
  std::string place;          ///< host and port that answered first, as numbers
  bool leads_inside = false;  ///< it was redirected where it must not go
  std::array<char, CURL_ERROR_SIZE> reason{};

  /// The bytes that the answer brings by its headers; 0 where they are not the next of the range,
  /// as they are in the file.
  size_t promised() const;

  /// The bytes of the range that are in the file, as far as `head` tells.
  size_t wanted() const {
    const uint64_t most = whole || !head.range ? UINT64_MAX : head.range->total.value_or(done);
    return static_cast<size_t>(std::min<uint64_t>(request.room.size(), most));
  }
};

/// Bytes of headers and trailers that one request may bring, those of redirections included.
inline constexpr size_t kMostHeadBytes = size_t{1} << 16;

/// A handle for requests to `address`: http and https alone, few redirections, no waiting without
/// end. A redirection may lead to any public address; to one of this machine or of a private
/// network only where that is the host and port that answered first. Certificates are checked as
/// libcurl does by itself. Null: want of memory. CURLOPT_PIPEWAIT stays off: with it libcurl 7.88
/// waits without end for a connection that failed before its first answer.
Easy make_easy(const std::string& address, const Patience& patience);

/// Makes the handle of `transfer` ask for what is left of its range and report to it. Sets the
/// deadline if there is none.
void prepare(Transfer& transfer, const Patience& patience);

/// Whether `address`, of IPv4 or IPv6, is one of this machine, of its link or of a private network;
/// anything that is no address counts as one.
bool is_inside(const std::string& address);

/// The transfers that libcurl runs at this time.
class UnderWay {
 public:
  explicit UnderWay(CURLM* multi) : multi_(multi) {}
  UnderWay(const UnderWay&) = delete;
  UnderWay& operator=(const UnderWay&) = delete;
  ~UnderWay() {
    for (const Transfer* transfer : transfers_) {
      curl_multi_remove_handle(multi_, transfer->easy.get());
    }
  }

  size_t count() const { return transfers_.size(); }
  void add(Transfer& transfer) { transfers_.push_back(&transfer); }

  /// Waits for the next events; calls `end(transfer, code)` for each that has ended.
  template <class End>
  void wait(const End& end) {
    int running = 0;
    curl_multi_perform(multi_, &running);
    if (running == static_cast<int>(count())) curl_multi_poll(multi_, nullptr, 0, 1000, nullptr);
    int left = 0;
    while (const CURLMsg* message = curl_multi_info_read(multi_, &left)) {
      if (message->msg != CURLMSG_DONE) continue;
      const CURLcode code = message->data.result;
      Transfer* transfer = nullptr;
      curl_easy_getinfo(message->easy_handle, CURLINFO_PRIVATE, &transfer);
      curl_multi_remove_handle(multi_, message->easy_handle);
      std::erase(transfers_, transfer);
      end(*transfer, code);
    }
  }

 private:
  CURLM* multi_;
  std::vector<Transfer*> transfers_;
};

}  // namespace hmlfc::remote
