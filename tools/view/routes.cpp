#include "view/routes.hpp"

#include <httplib.h>

namespace hmlfc::view {

namespace {

constexpr size_t kMaxBody = 1024;  // bytes

Request request_of(const httplib::Request& http) {
  Request request;
  request.method = http.method;
  request.path = http.path;
  request.query.assign(http.params.begin(), http.params.end());
  request.host = http.get_header_value("Host");
  request.origin = http.get_header_value("Origin");
  request.site = http.get_header_value("Sec-Fetch-Site");
  return request;
}

}  // namespace

void add_routes(httplib::Server& server, Handler& handler) {
  const auto answer = [&handler](const httplib::Request& http, httplib::Response& out) {
    Response response = handler.answer(request_of(http));
    out.status = response.status;
    for (const auto& [name, value] : response.headers) out.set_header(name, value);
    out.body = std::move(response.body);
    out.set_header("Content-Type", response.type);
  };
  server.set_payload_max_length(kMaxBody);
  server.Get(".*", answer);
  server.Post(".*", answer);
}

}  // namespace hmlfc::view
