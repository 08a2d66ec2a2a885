// The server of `hmlfc view` behind its socket: one HTTP request of anybody, about any stream.
#include <httplib.h>

#include <array>
#include <string_view>

#include "bits/crc32c.hpp"
#include "page_input.hpp"
#include "view/routes.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr size_t kMaxStream = 8192;                 // bytes of a seed
constexpr uint64_t kMaxPixels = uint64_t{1} << 20;  // of all views: more takes long
constexpr size_t kMaxSizeText = 7;                  // of a frame: 999x999
constexpr std::string_view kToken = "token";
constexpr std::string_view kHost = "127.0.0.1:80";

// A connection that has one request, and keeps the answer.
class Connection final : public httplib::Stream {
 public:
  explicit Connection(std::span<const uint8_t> request) : left_(request) {}

  const std::string& answer() const { return answer_; }

  bool is_readable() const override { return !left_.empty(); }
  bool is_writable() const override { return true; }
  ssize_t read(char* out, size_t size) override {
    const size_t count = std::min(size, left_.size());
    std::copy_n(left_.begin(), count, out);
    left_ = left_.subspan(count);
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* bytes, size_t size) override {
    answer_.append(bytes, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return INVALID_SOCKET; }

 private:
  std::span<const uint8_t> left_;
  std::string answer_;
};

// The server without its port.
class Http final : public httplib::Server {
 public:
  explicit Http(view::Handler& handler) {
    view::add_routes(*this, handler);
    set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
      if (request.get_param_value("size").size() <= kMaxSizeText) return HandlerResponse::Unhandled;
      response.status = 413;
      return HandlerResponse::Handled;
    });
  }

  void serve(Connection& connection) {
    bool closed = false;
    process_request(connection, true, closed, nullptr);
  }
};

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
  Http http(handler);
  Connection connection(page.request);
  http.serve(connection);
  const std::string& answer = connection.answer();
  demand(!answer.starts_with("HTTP/1.1 5"), "a request has an error inside the server");
  const std::string_view request(reinterpret_cast<const char*>(page.request.data()),
                                 page.request.size());
  demand(!answer.starts_with("HTTP/1.1 200") || may_come_from_the_page(request),
         "a request that does not come from the page is answered");
}

// Two requests a stream, so that all are asked about many.
std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  static constexpr std::array<std::string_view, 17> kRequests{
      "GET /token/frame?camera=0.5,0,0&size=8x6&focus=1.5&aperture=1&geometry=plane",
      "GET /token/frame?size=9x5&look-at=0,0,16&filter=bilinear&fov=40",
      "GET /token/frame.png?size=8x6&levels=1",
      "GET /token/focus?focus-at=3,2&camera=0,0",
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
      "POST /token/opened?page=7"};
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
