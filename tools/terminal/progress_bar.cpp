#include "terminal/progress_bar.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace hmlfc::terminal {
namespace {

constexpr auto kRedrawEvery = std::chrono::milliseconds(100);
constexpr auto kPrintEvery = std::chrono::seconds(2);
constexpr size_t kBarWidth = 24;

// "1:02:03" or "2:03".
std::string clock_time(double seconds) {
  const auto whole = static_cast<uint64_t>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

// Of the terminal at standard error; 100 if it is none.
size_t columns() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 100;
}

}  // namespace

ProgressBar::ProgressBar(std::string label, std::string unit, OffTerminal off_terminal)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      off_terminal_(off_terminal),
      on_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::update(uint64_t done, uint64_t total) {
  const auto now = Clock::now();
  if (!on_terminal_) return print(done, total, now);
  if (done < last_done_) {
    ++attempts_;
    begin_ = now;
  }
  last_done_ = done;
  if (now < next_draw_ || total == 0) return;
  next_draw_ = now + kRedrawEvery;
  draw(line(std::chrono::duration<double>(now - begin_).count(), done, total));
}

std::function<void(uint64_t, uint64_t)> ProgressBar::callback() {
  return [this](uint64_t done, uint64_t total) { update(done, total); };
}

std::string ProgressBar::line(double seconds, uint64_t done, uint64_t total) const {
  const double share = static_cast<double>(done) / static_cast<double>(total);
  const auto full = static_cast<size_t>(share * static_cast<double>(kBarWidth));
  std::string text = label_;
  if (attempts_ > 1) text += fmt::format(", try {}", attempts_);
  text += fmt::format("  [{}{}] {:3.0f} %  {}/{} {}", std::string(full, '#'),
                      std::string(kBarWidth - full, '.'), share * 100, done, total, unit_);
  const double rate = static_cast<double>(done) / seconds;
  if (rate > 0 && seconds > 0) {
    text += fmt::format("  {:.1f}/s  {} left", rate,
                        clock_time(static_cast<double>(total - done) / rate));
  }
  return text;
}

void ProgressBar::draw(const std::string& text) {
  std::fputs(("\r\033[K" + text.substr(0, columns() - 1)).c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::print(uint64_t done, uint64_t total, Clock::time_point now) {
  if (off_terminal_ == OffTerminal::kSilent || total == 0) return;
  const uint64_t tenths = done * 10 / total;
  if (tenths == printed_tenths_ || now < begin_ + kPrintEvery) return;
  printed_tenths_ = tenths;
  begin_ = now;
  std::fputs(fmt::format("{}  {}/{} {}\n", label_, done, total, unit_).c_str(), stderr);
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace hmlfc::terminal
