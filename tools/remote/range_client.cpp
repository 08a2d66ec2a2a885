#include "remote/range_client.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "remote/transfer.hpp"

namespace hmlfc::remote {
namespace {

constexpr uint64_t kMostBytes = uint64_t{1} << 46;  // below every address space of 64-bit systems
constexpr std::array<std::chrono::milliseconds, RangeClient::kTries - 1> kPauses{
    std::chrono::milliseconds(200), std::chrono::milliseconds(1000)};

// A failed transfer: what happened and what to do, and whether asking again may help.
struct Problem {
  std::string text;
  bool passing = false;
  bool out_of_memory = false;
};

const Problem kNoHandle{"not enough memory for a request", false, true};

// What a server wrote, cut for a message.
std::string cut(std::string text) {
  constexpr size_t kMost = 80;
  if (text.size() > kMost) text.replace(kMost, std::string::npos, "...");
  return text;
}

}  // namespace

struct RangeClient::State {
  std::string address;
  Patience patience;
  Multi multi;
  std::vector<Easy> idle;
  uint64_t size = 0;  // 0 until it is known
  bool is_open = false;
  std::string version;  // of the file that is open (AnswerHead)
  std::vector<uint8_t> first;

  bool begin(Transfer& transfer);
  std::optional<Problem> run(std::vector<Transfer*>& transfers);
  std::optional<Problem> fetch(std::span<Transfer> transfers);
  std::optional<Problem> judge(const Transfer& transfer, CURLcode code) const;
  std::optional<Problem> judge_part(const Transfer& transfer, CURLcode code) const;
  void accept(const AnswerHead& head);
  std::optional<Problem> find_size();
  Problem judge_status(long status) const;
  io::IoResult<void> open(size_t first_bytes);

  tl::unexpected<io::IoError> error(const Problem& problem) const {
    return tl::unexpected(io::IoError{address + ": " + problem.text, problem.out_of_memory});
  }
};

// Sends the request.
bool RangeClient::State::begin(Transfer& transfer) {
  if (!transfer.easy && !idle.empty()) {
    transfer.easy = std::move(idle.back());
    idle.pop_back();
  }
  if (!transfer.easy) transfer.easy = make_easy(address, patience);
  if (!transfer.easy) return false;
  prepare(transfer, patience);
  return curl_multi_add_handle(multi.get(), transfer.easy.get()) == CURLM_OK;
}

Problem RangeClient::State::judge_status(long status) const {
  switch (status) {
    case 200:
      return {
          "the server does not send parts of files (status 200 in place of 206); "
          "download the file and open that"};
    case 401:
    case 403:
      return Problem{fmt::format("the server refuses it (status {})", status)};
    case 404:
    case 410:
      return Problem{fmt::format("there is no such file (status {}); check the address", status)};
    case 416:
      return Problem{is_open ? "the file has become shorter (status 416); open it again"
                             : "the file is empty, or the server refuses a range that ends after "
                               "the file (status 416); download the file and open that"};
    default:
      return Problem{fmt::format("the server answers with status {}", status),
                     status == 429 || status >= 500};
  }
}

std::optional<Problem> RangeClient::State::judge(const Transfer& transfer, CURLcode code) const {
  const AnswerHead& head = transfer.head;
  if (transfer.leads_inside) {
    return Problem{
        "the server redirects to an address of this machine or its network; "
        "if that is meant, open that address itself"};
  }
  if (transfer.head_bytes > kMostHeadBytes) {
    return Problem{fmt::format("the server sends more than {} bytes of headers", kMostHeadBytes)};
  }
  if (code == CURLE_OUT_OF_MEMORY) {  // also of a line of 100 kB, which libcurl does not take
    return Problem{"not enough memory for the answer, or a header of it does not end", false, true};
  }
  if (code != CURLE_OK && code != CURLE_WRITE_ERROR && code != CURLE_PARTIAL_FILE) {
    const char* reason =
        transfer.reason[0] != 0 ? transfer.reason.data() : curl_easy_strerror(code);
    return Problem{fmt::format("{}; is the server there?", reason), true};
  }
  if (transfer.ask == Ask::kHead) {
    const bool tells = head.status == 200 && head.encoding.empty() && head.version() == version;
    if (tells && head.length) return std::nullopt;
    return Problem{"the server does not tell how long the file is (* in Content-Range)"};
  }
  if (head.status != 206) return judge_status(head.status);
  if (!head.encoding.empty()) {
    return Problem{
        fmt::format("the server sends other bytes than those of the file, compressed "
                    "(Content-Encoding: {}), although identity was asked for; download "
                    "the file and open that",
                    cut(head.encoding))};
  }
  return judge_part(transfer, code);
}

// An answer of status 206.
std::optional<Problem> RangeClient::State::judge_part(const Transfer& transfer,
                                                      CURLcode code) const {
  const AnswerHead& head = transfer.head;
  if (!head.range || (transfer.ask == Ask::kRange && transfer.promised() == 0)) {
    return Problem{
        fmt::format("the server sends other bytes than those asked for, or does not say "
                    "which ({})",
                    head.is_multipart ? "multipart/byteranges" : "Content-Range")};
  }
  if (size != 0 && head.range->total.value_or(size) != size) {
    return Problem{fmt::format("the file has changed: it had {} bytes and has {}; open it again",
                               size, *head.range->total)};
  }
  if (is_open && head.version() != version) {
    return Problem{fmt::format("the file has changed: its version was {} and is {}; open it again",
                               cut(version), cut(head.version()))};
  }
  if (transfer.ask == Ask::kEnd) return std::nullopt;
  if (code == CURLE_WRITE_ERROR) {
    return Problem{fmt::format("the answer has more than the {} bytes of its Content-Range",
                               transfer.promised()),
                   true};
  }
  if (code != CURLE_OK || transfer.received != transfer.promised()) {
    return Problem{fmt::format("the answer has {} bytes in place of {}", transfer.received,
                               transfer.promised()),
                   true};
  }
  return std::nullopt;
}

// Runs the transfers, kAtOnce at a time; what an answer leaves of a range is asked for again.
// Leaves those that may be tried again; returns the problem of one of them, or the one that made
// the others pointless.
std::optional<Problem> RangeClient::State::run(std::vector<Transfer*>& transfers) {
  std::optional<Problem> problem;
  std::vector<Transfer*> again;
  for (Transfer* transfer : transfers) transfer->deadline.reset();
  UnderWay under_way(multi.get());
  const auto is_hopeless = [&] { return problem && !problem->passing; };
  const auto end = [&](Transfer& transfer, CURLcode code) {
    auto found = judge(transfer, code);
    idle.push_back(std::move(transfer.easy));
    if (!found) {
      accept(transfer.head);
      transfer.done += transfer.received;
      if (transfer.done < transfer.wanted()) transfers.push_back(&transfer);
      return;
    }
    if (found->passing) again.push_back(&transfer);
    if (!is_hopeless()) problem = std::move(found);
  };
  size_t begun = 0;
  while (!is_hopeless() && (begun < transfers.size() || under_way.count() > 0)) {
    while (begun < transfers.size() && under_way.count() < kAtOnce) {
      Transfer& next = *transfers[begun++];
      if (!begin(next)) return kNoHandle;
      under_way.add(next);
    }
    under_way.wait(end);
  }
  transfers = std::move(again);
  return problem;
}

std::optional<Problem> RangeClient::State::fetch(std::span<Transfer> transfers) {
  std::vector<Transfer*> left;
  for (Transfer& transfer : transfers) left.push_back(&transfer);
  for (size_t tries = 0;; ++tries) {
    auto problem = run(left);
    if (!problem || !problem->passing || tries == kPauses.size()) return problem;
    std::this_thread::sleep_for(kPauses[tries]);
  }
}

// Notes which file it is, by the first good answer.
void RangeClient::State::accept(const AnswerHead& head) {
  if (is_open) return;
  is_open = true;
  version = head.version();
  size = head.range->total.value_or(0);
}

// For a server that sends * as total: the last byte has the number size - 1.
std::optional<Problem> RangeClient::State::find_size() {
  std::array<Transfer, 2> asked;
  asked[0].ask = Ask::kEnd;
  asked[1].ask = Ask::kHead;
  if (!fetch({&asked[0], 1})) {
    const ContentRange& range = *asked[0].head.range;
    size = range.total.value_or(range.last + 1);
    return std::nullopt;
  }
  auto problem = fetch({&asked[1], 1});
  if (!problem) size = *asked[1].head.length;
  return problem;
}

io::IoResult<void> RangeClient::State::open(size_t first_bytes) {
  static std::once_flag once;
  std::call_once(once, [] { curl_global_init(CURL_GLOBAL_DEFAULT); });
  multi.reset(curl_multi_init());
  if (!multi) return error(kNoHandle);
  first.resize(first_bytes);
  std::array<Transfer, 1> transfers;
  Transfer& transfer = transfers.front();
  transfer.request = {0, first};
  transfer.whole = false;
  if (const auto problem = fetch(transfers)) return error(*problem);
  if (size == 0) {
    if (const auto problem = find_size()) return error(*problem);
    first.resize(std::min<uint64_t>(first_bytes, std::max<uint64_t>(size, transfer.done)));
    transfer.request.room = first;
    transfer.whole = true;
    if (first.size() > transfer.done) {
      if (const auto problem = fetch(transfers)) return error(*problem);
    }
  }
  if (size > kMostBytes) return error({"the file is too long for a stream"});
  if (size < transfer.done) return error({"the server tells two lengths of the file"});
  first.resize(transfer.done);
  return {};
}

RangeClient::RangeClient(std::unique_ptr<State> state) : state_(std::move(state)) {}
RangeClient::RangeClient(RangeClient&&) noexcept = default;
RangeClient& RangeClient::operator=(RangeClient&&) noexcept = default;
RangeClient::~RangeClient() = default;

io::IoResult<RangeClient> RangeClient::open(const std::string& address, size_t first_bytes,
                                            const Patience& patience) {
  auto state = std::make_unique<State>();
  state->address = address;
  state->patience = patience;
  if (auto ok = state->open(first_bytes); !ok) return tl::unexpected(ok.error());
  return RangeClient(std::move(state));
}

uint64_t RangeClient::size() const { return state_->size; }

std::span<const uint8_t> RangeClient::first_bytes() const { return state_->first; }

io::IoResult<void> RangeClient::fetch(std::span<const RangeRequest> requests) {
  std::vector<Transfer> transfers(requests.size());
  for (size_t i = 0; i < requests.size(); ++i) transfers[i].request = requests[i];
  const auto problem = state_->fetch(transfers);
  if (problem) return state_->error(*problem);
  return {};
}

}  // namespace hmlfc::remote
