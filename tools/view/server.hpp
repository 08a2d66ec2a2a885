// HTTP on 127.0.0.1 around a Handler.
#pragma once

#include <cstdint>
#include <memory>

#include "view/handler.hpp"

namespace hmlfc::view {

/// A port of this machine alone, then the answers of a Handler on it.
class Server {
 public:
  /// Takes `port` of 127.0.0.1, 0: any that is free. Failure (kUsage): it is taken.
  explicit Server(uint16_t port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  uint16_t port() const { return port_; }

  /// Answers with `handler`, which must outlive the server, until stop().
  void start(Handler& handler);

  /// Ends connections and waits for the requests under way.
  void stop();

 private:
  struct Http;
  std::unique_ptr<Http> http_;
  uint16_t port_ = 0;
};

}  // namespace hmlfc::view
