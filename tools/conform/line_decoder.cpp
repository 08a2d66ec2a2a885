#include "conform/line_decoder.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace hmlfc::conform {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kDigits = 4;           // of a sample
constexpr size_t kBannerBytes = 65536;  // before the answer to hello
constexpr size_t kShownBytes = 60;      // of a wrong answer
constexpr double kSecondsToEnd = 2;     // after the end of the input

Process::Time after(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

// The beginning of `text`, without control characters.
std::string shown(std::string_view text) {
  std::string beginning(text.substr(0, kShownBytes));
  for (char& c : beginning) c = c >= ' ' && c <= '~' ? c : '?';
  return fmt::format("\"{}\"{}", beginning, text.size() > kShownBytes ? "..." : "");
}

[[noreturn]] void wrong_answer(const std::string& request, const std::string& why) {
  throw DutFailure{Status::kFail, fmt::format("wrong answer to '{}': {}", request, why)};
}

// Removes `word` and the blank after it, or the end, from the front of `text`; false if they are
// not there.
bool take_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  const std::string_view rest = text.substr(word.size());
  if (!rest.empty() && rest.front() != ' ') return false;
  text = rest.substr(std::min<size_t>(1, rest.size()));
  return true;
}

// The next decimal number of `text`, removed from its front.
std::optional<uint32_t> take_number(std::string_view& text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !take_word(text, {text.data(), end})) {
    return std::nullopt;
  }
  return value;
}

// The value of a hexadecimal digit; above 15 for other characters.
unsigned digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return 16;
}

std::string place(const BlockAddress& block, int stop_level) {
  return fmt::format("{} {} {} {} {} {}", block.view.row, block.view.col,
                     static_cast<unsigned>(block.plane), block.bx, block.by, stop_level);
}

}  // namespace

LineDecoder::LineDecoder(const std::vector<std::string>& command, const ProcessLimits& limits)
    : process_(command, limits.memory_bytes, std::numeric_limits<size_t>::max() / 2),
      deadline_(after(limits.seconds)) {
  greet();
}

LineDecoder::~LineDecoder() {
  process_.close_input();
  process_.exchange({}, after(kSecondsToEnd),
                    [](const std::string& output) { return output.size() > kBannerBytes; });
}

void LineDecoder::allow(double seconds) { deadline_ = after(seconds); }

// Lines before the answer to hello are passed over: a simulator's banner, a board's messages.
void LineDecoder::greet() {
  const std::string request = fmt::format("hello {}", kLineProtocol);
  std::string sent = fmt::format("{} {}\n", asked_, request);
  for (size_t passed = 0; passed < kBannerBytes; sent.clear()) {
    const std::string answer = line(request, sent, kBannerBytes);
    std::string_view rest = answer;
    passed += answer.size() + 1;
    if (!take_word(rest, "0")) continue;
    ++asked_;
    if (!take_word(rest, "ok") || take_number(rest) != kLineProtocol) {
      wrong_answer(request, shown(answer) + ", not '0 ok 1' and what the decoder can do");
    }
    const auto says = [rest](std::string_view ability) {
      for (std::string_view words = rest; !words.empty();) {
        const std::string_view word = words.substr(0, words.find(' '));
        if (word == ability) return true;
        take_word(words, word);
      }
      return false;
    };
    abilities_ = {says("view"), says("block"), says("trace"), says("levels"), false};
    if (!abilities_.views && !abilities_.blocks) wrong_answer(request, "neither view nor block");
    return;
  }
  wrong_answer(request, "none in 64 KiB");
}

void LineDecoder::fail_to_answer(const std::string& request, bool timed_out) {
  const ProcessOutcome outcome = process_.end(timed_out);
  const bool skipped = outcome.end == ProcessEnd::kExit && outcome.value == kExitSkipped;
  if (skipped) {
    throw DutFailure{Status::kSkipped, "the decoder cannot run here" + last_words(outcome.messages),
                     outcome.messages};
  }
  const char* without = outcome.end == ProcessEnd::kExit ? " without an answer" : "";
  throw DutFailure{timed_out ? Status::kTimeout : Status::kError,
                   fmt::format("{}{} at '{}'{}", to_string(outcome), without, request,
                               last_words(outcome.messages)),
                   outcome.messages};
}

// Sends `sent` and returns the next line, without its end and a carriage return, of less than
// `bytes` bytes.
std::string LineDecoder::line(const std::string& request, std::string_view sent, size_t bytes) {
  size_t searched = 0;
  size_t end = std::string::npos;
  const auto stop = process_.exchange(sent, deadline_, [&](const std::string& output) {
    end = output.find('\n', searched);
    searched = output.size();
    return end != std::string::npos || output.size() >= bytes;
  });
  if (stop != Process::Stop::kSuffices) fail_to_answer(request, stop == Process::Stop::kTimeout);
  std::string& output = process_.output();
  if (end == std::string::npos || end >= bytes) {
    wrong_answer(request, fmt::format("a line of more than {} bytes: {}", bytes, shown(output)));
  }
  std::string text = output.substr(0, end);
  output.erase(0, end + 1);
  if (text.ends_with('\r')) text.pop_back();
  return text;
}

DutAnswer<std::string> LineDecoder::ask(const std::string& request, size_t bytes) {
  if (!process_.output().empty()) {
    wrong_answer(request, "more than one line to the request before: " + shown(process_.output()));
  }
  const std::string number = std::to_string(asked_++);
  std::string answer = line(request, fmt::format("{} {}\n", number, request), bytes);
  std::string_view rest = answer;
  if (take_word(rest, number)) {
    if (take_word(rest, "ok")) return std::string(rest);
    if (take_word(rest, "error") && !rest.empty()) return tl::unexpected(std::string(rest));
  }
  wrong_answer(request,
               fmt::format("{}, not '{} ok' or '{} error'", shown(answer), number, number));
}

DutAnswer<hmlfc_dut_geometry> LineDecoder::open(const std::filesystem::path& file) {
  const std::string request = "open " + file.string();
  if (request.find('\n') != std::string::npos) {
    throw DutFailure{Status::kError, "the stream's path has a line break"};
  }
  const auto answer = ask(request);
  if (!answer) return tl::unexpected(answer.error());
  std::string_view rest = *answer;
  for (const GeometryField& field : kGeometryFields) {
    const auto value = take_number(rest);
    if (!value) wrong_answer(request, shown(*answer) + " has not eight numbers");
    geometry_.*field.value = *value;
  }
  return geometry_;
}

DutAnswer<std::vector<int32_t>> LineDecoder::samples(const std::string& request, size_t count) {
  const auto answer = ask(request, kLineBytes + count * kDigits);
  if (!answer) return tl::unexpected(answer.error());
  if (answer->size() != count * kDigits) {
    wrong_answer(request, fmt::format("{} characters instead of {} samples of {} digits",
                                      answer->size(), count, kDigits));
  }
  std::vector<int32_t> values(count);
  const char* at = answer->data();
  for (int32_t& value : values) {
    unsigned bits = 0;
    for (size_t i = 0; i < kDigits; ++i, ++at) {
      const unsigned next = digit(*at);
      if (next > 15) wrong_answer(request, shown({at, 1}) + " is not a hexadecimal digit");
      bits = bits << 4 | next;
    }
    value = static_cast<int16_t>(bits);
  }
  return values;
}

DutAnswer<RgbImage> LineDecoder::view(ViewPos view) {
  const std::string request = fmt::format("view {} {}", view.row, view.col);
  RgbImage image{geometry_.width, geometry_.height, static_cast<int>(geometry_.depth), {}};
  const auto values = samples(request, size_t{image.width} * image.height * 3);
  if (!values) return tl::unexpected(values.error());
  image.samples.reserve(values->size());
  for (const int32_t value : *values) {
    if (value < 0 || value >> image.depth != 0) {
      wrong_answer(request, fmt::format("sample {} is {}, not of {} bits", image.samples.size(),
                                        value, image.depth));
    }
    image.samples.push_back(static_cast<uint16_t>(value));
  }
  return image;
}

DutAnswer<std::vector<int32_t>> LineDecoder::block(const BlockAddress& block, int stop_level) {
  return samples("block " + place(block, stop_level), size_t{1} << (2 * geometry_.block_log2));
}

DutAnswer<std::string> LineDecoder::trace(const BlockAddress& block, int stop_level) {
  const std::string request = "trace " + place(block, stop_level);
  const auto answer = ask(request);
  if (!answer) return tl::unexpected(answer.error());
  std::string_view rest = *answer;
  const auto count = take_number(rest);
  if (!count || *count > kTraceLines) {
    wrong_answer(request, fmt::format("{} is not a number up to {}", shown(*answer), kTraceLines));
  }
  std::string lines;
  for (uint32_t i = 0; i < *count; ++i) lines += line(request, {}, kLineBytes) + '\n';
  return lines;
}

void LineDecoder::close() {
  const auto answer = ask("close");
  if (!answer) wrong_answer("close", "error " + answer.error());
}

}  // namespace hmlfc::conform
