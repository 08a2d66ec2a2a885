// The server of the page: HTTP on a port of 127.0.0.1.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "io/files.hpp"
#include "view/connection.hpp"
#include "view/handler.hpp"

namespace hmlfc::view {

/// A port on which nothing is answered yet.
class Port {
 public:
  /// Takes `port` of 127.0.0.1, or a free one for 0. Failure (kUsage): it cannot be had.
  explicit Port(uint16_t port);

  uint16_t number() const { return number_; }
  int socket() const { return socket_.get(); }

 private:
  io::FileDescriptor socket_;
  uint16_t number_ = 0;
};

/// Answers what comes to a port until it is destroyed. One thread has all connections, so that
/// those that send or take little keep nobody waiting; others work out the answers. Where
/// kConnections are open, a new one takes the place of the one that has waited the longest for its
/// request, or for its answer to be taken.
class Server {
 public:
  static constexpr size_t kConnections = 64;  ///< open at a time
  static constexpr size_t kThreads = 16;      ///< answers worked out at a time

  /// Both must outlive it.
  Server(const Port& port, Handler& handler);
  /// Closes all connections, then waits for the answers that are worked out.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

 private:
  using Time = Connection::Time;

  struct Exchange {
    Connection* connection = nullptr;  // stays where it is until it has its answer
    HttpRequest request;
    std::string answer;                // empty for want of memory
    std::shared_ptr<const void> open;  // as in Response
  };

  void serve();
  void serve_once();
  void work(Connection& connection, Time now);
  void take_answers(Time now);
  void accept(Time now);
  std::list<Connection>::iterator longest_waiting();
  void make_room();
  void work_out();
  void answer(Exchange& exchange);
  void wake() const;
  void end();

  const Port& port_;
  Handler& handler_;
  io::FileDescriptor wakes_;           // an eventfd: an answer is there, or the end
  std::list<Connection> connections_;  // of the thread that serves
  std::mutex mutex_;
  std::condition_variable is_asked_;
  std::list<Exchange> asked_;
  std::list<Exchange> answered_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace hmlfc::view
