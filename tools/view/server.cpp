#include "view/server.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/output.hpp"

namespace hmlfc::view {

namespace {

constexpr int kAcceptedAtATime = 16;  // so that each is read before many others come

constexpr std::chrono::seconds kLongestWait{60};

std::system_error failure_of(const char* call) { return {errno, std::generic_category(), call}; }

int milliseconds_to(Connection::Time time) {
  const auto left = time - Connection::Clock::now();
  return static_cast<int>(
      std::max<int64_t>(0, std::chrono::ceil<std::chrono::milliseconds>(left).count()));
}

// Another program may have the port, or this user no right to it.
void bind_to(int socket, sockaddr_in& address) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const auto* const named = reinterpret_cast<const sockaddr*>(&address);
  if (::bind(socket, named, sizeof address) == 0 && ::listen(socket, SOMAXCONN) == 0) return;
  const char* const why = errno == EADDRINUSE ? "taken by another program" : std::strerror(errno);
  throw cli::Failure(cli::ExitCode::kUsage,
                     fmt::format("--port {}: {}; without --port, a free one is found",
                                 ntohs(address.sin_port), why));
}

}  // namespace

Port::Port(uint16_t port)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  if (socket_.get() < 0) throw failure_of("socket");
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  bind_to(socket_.get(), address);
  socklen_t size = sizeof address;
  ::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size);
  number_ = ntohs(address.sin_port);
}

Server::Server(const Port& port, Handler& handler)
    : port_(port), handler_(handler), wakes_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (wakes_.get() < 0) throw failure_of("eventfd");
  threads_.reserve(kThreads + 1);
  try {
    for (size_t i = 0; i < kThreads; ++i) threads_.emplace_back([this] { work_out(); });
    threads_.emplace_back([this] { serve(); });
  } catch (...) {
    end();
    throw;
  }
}

Server::~Server() { end(); }

void Server::end() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  is_asked_.notify_all();
  wake();
  for (std::thread& thread : threads_) thread.join();
}

void Server::wake() const {
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wakes_.get(), &one, sizeof one);
}

void Server::serve() {
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      if (ends_) break;
    }
    try {
      serve_once();
    } catch (const std::bad_alloc&) {
      make_room();
    }
  }
  connections_.clear();
}

void Server::serve_once() {
  Time until = Connection::Clock::now() + kLongestWait;
  for (const Connection& connection : connections_) until = std::min(until, connection.deadline());
  const bool is_room =
      connections_.size() < kConnections || longest_waiting() != connections_.end();
  std::vector<pollfd> entries{{wakes_.get(), POLLIN, 0},
                              {is_room ? port_.socket() : -1, POLLIN, 0}};
  for (const Connection& connection : connections_) entries.push_back(connection.entry());
  ::poll(entries.data(), entries.size(), milliseconds_to(until));
  const Time now = Connection::Clock::now();
  auto entry = entries.cbegin() + 2;
  for (Connection& connection : connections_) {
    if ((entry++)->revents != 0) work(connection, now);
  }
  take_answers(now);
  connections_.remove_if(
      [now](const Connection& connection) { return connection.deadline() <= now; });
  if (entries[1].revents != 0) accept(now);
}

void Server::work(Connection& connection, Time now) try {
  auto request = connection.work(now);
  if (!request) return;
  std::list<Exchange> exchange;
  exchange.push_back({&connection, std::move(*request), {}, {}});
  {
    const std::lock_guard lock(mutex_);
    asked_.splice(asked_.end(), exchange);
  }
  is_asked_.notify_one();
} catch (const std::bad_alloc&) {
  connection.end();
}

void Server::take_answers(Time now) {
  uint64_t wakes = 0;
  [[maybe_unused]] const ssize_t count = ::read(wakes_.get(), &wakes, sizeof wakes);
  std::list<Exchange> answered;
  {
    const std::lock_guard lock(mutex_);
    answered.swap(answered_);
  }
  for (Exchange& exchange : answered) {
    exchange.connection->answer(std::move(exchange.answer), now, std::move(exchange.open));
  }
}

void Server::accept(Time now) {
  for (int i = 0; i < kAcceptedAtATime; ++i) {
    io::FileDescriptor socket(
        ::accept4(port_.socket(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (socket.get() < 0) {
      if (errno == EMFILE || errno == ENFILE) make_room();
      return;
    }
    if (connections_.size() >= kConnections) make_room();
    const int yes = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    connections_.emplace_back(std::move(socket), now);
  }
}

// The connection that has waited the longest for the other side, or the end.
std::list<Connection>::iterator Server::longest_waiting() {
  auto found = connections_.end();
  for (auto at = connections_.begin(); at != connections_.end(); ++at) {
    using enum Connection::Phase;
    if (at->phase() == kAnswering || at->phase() == kOpen) continue;
    if (found == connections_.end() || at->since() < found->since()) found = at;
  }
  return found;
}

void Server::make_room() {
  const auto found = longest_waiting();
  if (found != connections_.end()) connections_.erase(found);
}

void Server::work_out() {
  std::list<Exchange> own;  // the one under way
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      is_asked_.wait(lock, [this] { return ends_ || !asked_.empty(); });
      if (ends_) return;
      own.splice(own.end(), asked_, asked_.begin());
    }
    answer(own.front());
    {
      const std::lock_guard lock(mutex_);
      answered_.splice(answered_.end(), own);
    }
    wake();
  }
}

void Server::answer(Exchange& exchange) try {
  const auto& [request, keep] = exchange.request;
  Response response = handler_.answer(request);
  exchange.open = response.open;
  exchange.answer = response_bytes(std::move(response), request.method == "HEAD", keep);
} catch (const std::bad_alloc&) {
  exchange.answer = {};
}

}  // namespace hmlfc::view
