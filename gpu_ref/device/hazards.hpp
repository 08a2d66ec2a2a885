// Checks that the barriers of each submission are enough, and that none is idle. For tests: a
// device with DeviceOptions::check_barriers has one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hmlfc::gpu {

/// The part of the device, or the host, that does the work of a command; a set of them is a sum.
enum Work : uint8_t {
  kCompute = 1,   ///< a kernel
  kTransfer = 2,  ///< a fill or a copy
  kIndirect = 4,  ///< the size of a dispatch is read
  kHost = 8,      ///< the host reads, after the submission
};

/// Bytes [begin, end) of the buffer with device address `buffer`, as a command uses them.
struct BufferAccess {
  uint64_t buffer = 0;
  std::string name;  ///< of the buffer, for messages
  bool reads = false;
  bool writes = false;
  uint64_t begin = 0;
  uint64_t end = UINT64_MAX;
};

/// Two accesses to the same bytes, of which one writes, are a *hazard* unless a barrier between
/// them waits for the work of the first and makes the second wait. All submissions go to one queue.
/// Where the host has waited for an earlier one, a barrier must still make what it wrote visible to
/// reads, but no write has to wait for what it did.
class Hazards {
 public:
  /// Forgets what is known of an earlier buffer at the address of a new one.
  void add_buffer(uint64_t buffer);

  /// Says that buffer `part` holds the bytes from `at` on of what kernels reach through `whole`.
  void join(uint64_t part, uint64_t whole, uint64_t at) { parts_[part] = {whole, at}; }

  /// Begins a submission and returns its number.
  uint64_t begin();

  /// Says that the host has waited for submission `number`, and so for those before it.
  void finished(uint64_t number);

  /// Adds a barrier: work of `before` recorded so far ends, and is visible, before work of `after`.
  void barrier(unsigned before, unsigned after);

  /// Begins the next command, called `name` in messages.
  void command(const std::string& name);

  /// Says that the last command uses a buffer in its work `work`.
  void access(Work work, const BufferAccess& access);

  /// Ends the submission. Returns the first hazard, else the first barrier that could wait for less
  /// or be left out, else nothing. The first barrier of a submission may be idle: it is for what
  /// earlier submissions did.
  std::string end();

 private:
  struct Access {
    std::string command;
    size_t number;  ///< of the command; 0: of an earlier submission
    Work work;
    uint64_t begin, end;
    bool writes;
    size_t barriers;      ///< recorded before it in this submission
    uint64_t submission;  ///< 0: the host has waited for it
  };
  struct Barrier {
    unsigned before, after;                    ///< sums of Work
    unsigned used_before = 0, used_after = 0;  ///< by hazards that no other barrier removes
    std::string previous;                      ///< the command before it
  };

  void order(const Access& first, const Access& second, const std::string& name);

  struct Part {
    uint64_t whole, at;
  };

  std::map<uint64_t, Part> parts_;
  std::map<uint64_t, std::vector<Access>> accesses_;  ///< by buffer, since the last that wrote all
  std::vector<Barrier> barriers_;
  std::string command_;
  size_t number_ = 0;
  uint64_t submission_ = 0;
  std::string hazard_;
};

}  // namespace hmlfc::gpu
