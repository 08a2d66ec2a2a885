// Ranges of a file on a web server.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/io_error.hpp"

namespace hmlfc::remote {

/// Bytes of the file and the room for them, as long as they are.
struct RangeRequest {
  uint64_t offset = 0;
  std::span<uint8_t> room;
};

/// How long a server may take. Each range has a deadline: `base`, and a second for each
/// `least_speed` bytes of it.
struct Patience {
  std::chrono::seconds connect{10};  ///< until it is connected
  std::chrono::seconds slow{20};     ///< slower than least_speed all the time
  std::chrono::seconds base{30};
  long least_speed = 1024;  ///< bytes a second
};

/// A file at an http:// or https:// address, whose server answers range requests. Messages name the
/// address, what happened, and what to do. One thread at a time.
class RangeClient {
 public:
  /// Requests that are under way at once.
  static constexpr size_t kAtOnce = 16;

  /// Asks for the first bytes, `first_bytes` of them or all. Errors: the server cannot be reached,
  /// has no such file, does not answer ranges; the file is empty or too long for a stream.
  static io::IoResult<RangeClient> open(const std::string& address, size_t first_bytes,
                                        const Patience& patience = {});

  RangeClient(RangeClient&&) noexcept;
  RangeClient& operator=(RangeClient&&) noexcept;
  ~RangeClient();

  /// Bytes of the file.
  uint64_t size() const;

  /// The bytes that open() asked for.
  std::span<const uint8_t> first_bytes() const;

  /// Fills the room of all `requests`, several at once. What fails on the way is asked for again,
  /// kTries times in all. Errors: the server does not answer any more, or answers anything but
  /// these bytes of the file that was opened: its length, and its ETag or else its date, are
  /// compared.
  io::IoResult<void> fetch(std::span<const RangeRequest> requests);

  static constexpr int kTries = 3;

 private:
  struct State;
  explicit RangeClient(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace hmlfc::remote
