// Fuzzes the server of `hmlfc view` without its socket: one HTTP request from anybody, about any
// stream.
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "bits/crc32c.hpp"
#include "page_input.hpp"
#include "view/handler.hpp"
#include "view/http.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr size_t kMaxStream = 8192;                 // bytes of a seed
constexpr uint64_t kMaxPixels = uint64_t{1} << 20;  // of all views: more takes long
constexpr size_t kMaxSizeText = 7;                  // of a frame: 999x999
constexpr std::string_view kToken = "token";
constexpr std::string_view kHost = "127.0.0.1:80";

// Returns what the server sends back to `sent`, as far as that is one request.
std::string answer_to(std::string sent, view::Handler& handler) {
  auto taken = view::take_request(sent);
  if (!taken) return view::response_bytes(std::move(taken.error()), false, false);
  if (!*taken) return "";
  const view::Request& request = (*taken)->request;
  for (const auto& [name, value] : request.query) {
    if (name == "size" && value.size() > kMaxSizeText) return "";
  }
  return view::response_bytes(handler.answer(request), request.method == "HEAD", (*taken)->keep);
}

bool is_small(const view::OpenStream& stream) {
  if (!stream.error().empty()) return true;
  const StreamHeader& header = stream.for_blocks().header();
  return uint64_t{header.rows} * header.cols * header.width * header.height <= kMaxPixels;
}

// Whether the request may come from the page. Percent signs can stand for anything.
bool may_come_from_the_page(std::string_view request) {
  const auto has = [request](std::string_view text) { return request.find(text) != request.npos; };
  return has("%") || (has(kToken) && (has(kHost) || has("localhost:80")));
}

}  // namespace

void run(std::span<const uint8_t> input) {
  const PageInput page = PageInput::of(input);
  view::OpenStream stream("a.hmlfc", page.stream);
  if (!is_small(stream)) return;
  view::Handler handler({80, std::string(kToken)}, stream, nullptr, false);
  const std::string_view request(reinterpret_cast<const char*>(page.request.data()),
                                 page.request.size());
  const std::string answer = answer_to(std::string(request), handler);
  demand(!answer.starts_with("HTTP/1.1 5"), "a request has an error inside the server");
  demand(!answer.starts_with("HTTP/1.1 200") || may_come_from_the_page(request),
         "a request that does not come from the page is answered");
}

// Two requests a stream, so that all are asked about many.
std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  static constexpr std::array<std::string_view, 18> kRequests{
      "GET /token/frame?camera=0.5,0,0&size=8x6&focus=1.5&aperture=1&geometry=plane",
      "GET /token/frame?size=9x5&look-at=0,0,16&filter=views&fov=40",
      "GET /token/frame.png?size=8x6&levels=1",
      "GET /token/focus?focus-at=3,2&camera=0,0",
      "GET /token/trace?trace=3,2&camera=0.5,0,0&size=8x6",
      "GET /token/picture?view=0,0",
      "GET /token/difference?view=0,0&gain=4",
      "GET /token/stage?view=0,0&plane=Y&stage=residual",
      "GET /token/stage?view=0,1&plane=Cg&stage=parent&levels=1",
      "GET /token/blocks?view=0,1&plane=Co",
      "GET /token/blocks?view=0,0&plane=Y",
      "GET /token/block?view=0,1&plane=Y&block=1,0&levels=1",
      "GET /token/block?view=0,0&plane=Cg&block=0,1",
      "GET /token/stream",
      "GET /token/totals",
      "GET /token/dut-block?view=0,0&plane=Y&block=0,0",
      "HEAD /token/look.js",
      "POST /token/arrived"};
  std::vector<Bytes> found;
  if (stream.size() > kMaxStream) return found;
  for (const unsigned which : {0u, 8u}) {
    std::string request(kRequests[(crc32c(stream) + which) % kRequests.size()]);
    request += " HTTP/1.1\r\nHost: 127.0.0.1:80\r\nOrigin: http://127.0.0.1:80\r\n";
    request += "Sec-Fetch-Site: same-origin\r\nContent-Length: 0\r\n\r\n";
    found.push_back(
        PageInput{{reinterpret_cast<const uint8_t*>(request.data()), request.size()}, stream}
            .bytes());
  }
  return found;
}

}  // namespace hmlfc::fuzz
