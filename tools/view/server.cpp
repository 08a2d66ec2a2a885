#include "view/server.hpp"

#include <sys/socket.h>

#include <thread>

#include <fmt/format.h>
#include <httplib.h>

#include "cli/output.hpp"
#include "view/routes.hpp"

namespace hmlfc::view {

namespace {

constexpr size_t kThreads = 16;          // a connection keeps one; a browser opens six
constexpr time_t kIdleSeconds = 1;       // after which a connection ends: stop() waits as long
constexpr size_t kRequests = 1'000'000;  // on one connection

}  // namespace

struct Server::Http {
  httplib::Server server;
  std::thread thread;
};

Server::Server(uint16_t port) : http_(std::make_unique<Http>()) {
  httplib::Server& server = http_->server;
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  // Without the library's SO_REUSEPORT, with which two servers would share a port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_tcp_nodelay(true);
  server.set_keep_alive_max_count(kRequests);
  server.set_keep_alive_timeout(kIdleSeconds);
  const int taken = port == 0                                ? server.bind_to_any_port("127.0.0.1")
                    : server.bind_to_port("127.0.0.1", port) ? port
                                                             : -1;
  if (taken <= 0) {
    throw cli::Failure(cli::ExitCode::kUsage,
                       fmt::format("--port {}: taken by another program; without --port, a free "
                                   "one is found",
                                   port));
  }
  port_ = static_cast<uint16_t>(taken);
}

Server::~Server() { stop(); }

void Server::start(Handler& handler) {
  add_routes(http_->server, handler);
  http_->thread = std::thread([http = http_.get()] { http->server.listen_after_bind(); });
}

void Server::stop() {
  if (!http_->thread.joinable()) return;
  while (!http_->server.is_running()) std::this_thread::yield();
  http_->server.stop();
  http_->thread.join();
}

}  // namespace hmlfc::view
