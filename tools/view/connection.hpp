// One connection of the server of `hmlfc view`: a request, its answer, the next request.
#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "io/files.hpp"
#include "view/http.hpp"

namespace hmlfc::view {

/// Never waits. Holds at most kMaxHead and a buffer's bytes of what the other side sends, and has a
/// deadline for all that the other side has to do, which single bytes do not move.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// In which a request comes whole, counted from the connection or the answer before.
  static constexpr std::chrono::seconds kRequestTime{15};
  /// In which an answer is taken whole.
  static constexpr std::chrono::seconds kAnswerTime{60};
  /// In which an answer without an end ends all the same: browsers give up those that are silent.
  static constexpr std::chrono::seconds kOpenTime{60};
  /// In which the other side closes, too, so that it sees why it was refused.
  static constexpr std::chrono::seconds kCloseTime{1};

  enum class Phase : uint8_t {
    kReading,    ///< a request comes
    kAnswering,  ///< it has come; answer() follows
    kWriting,    ///< the answer goes
    kOpen,       ///< it has no end, and waits for the other side to close
    kClosing,    ///< no more is answered
    kEnded,      ///< to be destroyed
  };

  /// `socket` does not block.
  Connection(io::FileDescriptor socket, Time now);

  Phase phase() const { return phase_; }
  Time since() const { return since_; }  ///< when the phase began
  Time deadline() const;                 ///< when the connection is to be destroyed

  /// What poll() is to wait for before work() is called.
  pollfd entry() const;

  /// Reads or writes what is ready. The request that is now whole, if one is.
  std::optional<HttpRequest> work(Time now);

  /// The answer, of response_bytes(), to the request that work() gave; without one it ends. With
  /// `open` the answer has no end, and `open` lives as long as the connection.
  void answer(std::string bytes, Time now, std::shared_ptr<const void> open = nullptr);

  void end() { phase_ = Phase::kEnded; }

 private:
  void enter(Phase phase, Time now);
  void read();
  void write(Time now);
  std::optional<HttpRequest> next(Time now);

  io::FileDescriptor socket_;
  Phase phase_ = Phase::kReading;
  Time since_;
  std::string received_;
  std::string answer_;
  size_t written_ = 0;  // bytes of answer_
  size_t ignored_ = 0;  // bytes that came after the last answer
  std::shared_ptr<const void> open_;
  bool keep_ = true;  // another request may follow
};

}  // namespace hmlfc::view
