#include "view/connection.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <utility>

namespace hmlfc::view {

namespace {

constexpr size_t kBuffer = 16384;
constexpr size_t kIgnored = size_t{1} << 20;  // bytes behind what was refused

// Whether a call that gave -1 may give more later.
bool is_later() { return errno == EAGAIN || errno == EINTR; }

}  // namespace

Connection::Connection(io::FileDescriptor socket, Time now)
    : socket_(std::move(socket)), since_(now) {}

Connection::Time Connection::deadline() const {
  switch (phase_) {
    case Phase::kReading:
      return since_ + kRequestTime;
    case Phase::kAnswering:
      return Time::max();
    case Phase::kWriting:
      return since_ + kAnswerTime;
    case Phase::kOpen:
      return since_ + kOpenTime;
    case Phase::kClosing:
      return since_ + kCloseTime;
    case Phase::kEnded:
      break;
  }
  return since_;
}

pollfd Connection::entry() const {
  const bool writing = phase_ == Phase::kWriting;
  return {phase_ == Phase::kAnswering ? -1 : socket_.get(),
          static_cast<int16_t>(writing ? POLLOUT : POLLIN), 0};
}

std::optional<HttpRequest> Connection::work(Time now) {
  if (phase_ == Phase::kWriting) {
    write(now);
  } else {
    read();
  }
  return phase_ == Phase::kReading ? next(now) : std::nullopt;
}

void Connection::answer(std::string bytes, Time now, std::shared_ptr<const void> open) {
  if (bytes.empty()) return end();
  open_ = std::move(open);
  answer_ = std::move(bytes);
  written_ = 0;
  enter(Phase::kWriting, now);
}

void Connection::enter(Phase phase, Time now) {
  phase_ = phase;
  since_ = now;
}

void Connection::read() {
  std::array<char, kBuffer> buffer;
  const ssize_t count = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
  if (count == 0 || (count < 0 && !is_later())) return end();
  if (count < 0) return;
  if (phase_ == Phase::kReading) {
    received_.append(buffer.data(), static_cast<size_t>(count));
  } else {
    ignored_ += static_cast<size_t>(count);
    if (ignored_ > kIgnored) end();
  }
}

void Connection::write(Time now) {
  const ssize_t count =
      ::send(socket_.get(), answer_.data() + written_, answer_.size() - written_, MSG_NOSIGNAL);
  if (count < 0) {
    if (!is_later()) end();
    return;
  }
  written_ += static_cast<size_t>(count);
  if (written_ < answer_.size()) return;
  answer_ = {};
  if (open_ || keep_) {
    enter(open_ ? Phase::kOpen : Phase::kReading, now);
  } else {
    // To close at once would take back the answer where more has come than was read.
    ::shutdown(socket_.get(), SHUT_WR);
    enter(Phase::kClosing, now);
  }
}

std::optional<HttpRequest> Connection::next(Time now) {
  auto request = take_request(received_);
  if (!request) {
    keep_ = false;
    received_ = {};
    answer(response_bytes(std::move(request.error()), false, false), now);
    return std::nullopt;
  }
  if (*request) {
    keep_ = (*request)->keep;
    enter(Phase::kAnswering, now);
  }
  return std::move(*request);
}

}  // namespace hmlfc::view
