// Progress of long work, shown on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace hmlfc::terminal {

/// What a ProgressBar does where standard error is no terminal.
enum class OffTerminal : uint8_t {
  kSilent,
  kLines,  ///< a line for each tenth of the work, but none within two seconds after another
};

/// One line on standard error with a bar, the rate and the time left:
///
///   Encoding  [##########..............]  42 %  36/85 images  3.1/s  0:16 left
///
/// On a terminal, shown if the work takes more than a second; erased by clear() or the destructor.
/// If work restarts (done falls), the line counts the attempts.
class ProgressBar {
 public:
  /// `unit` is a plural noun.
  ProgressBar(std::string label, std::string unit, OffTerminal off_terminal = OffTerminal::kSilent);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// done in [0, total]; from one thread at a time.
  void update(uint64_t done, uint64_t total);

  /// update() as a callback, which the bar must outlive.
  std::function<void(uint64_t, uint64_t)> callback();

  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string line(double seconds, uint64_t done, uint64_t total) const;
  void draw(const std::string& text);
  void print(uint64_t done, uint64_t total, Clock::time_point now);

  std::string label_;
  std::string unit_;
  OffTerminal off_terminal_;
  bool on_terminal_;
  bool drawn_ = false;
  unsigned attempts_ = 1;
  uint64_t last_done_ = 0;
  uint64_t printed_tenths_ = 0;
  Clock::time_point begin_ = Clock::now();  ///< of this attempt
  Clock::time_point next_draw_ = begin_ + std::chrono::seconds(1);
};

}  // namespace hmlfc::terminal
