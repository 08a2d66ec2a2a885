#include "conform/line_decoder.hpp"

#include <chrono>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conform/line_words.hpp"

namespace hmlfc::conform {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kBannerBytes = 65536;  // before the answer to hello
constexpr double kSecondsToEnd = 2;     // after the end of the input

Process::Time after(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
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
    abilities_ = {.views = says("view"),
                  .blocks = says("block"),
                  .traces = says("trace"),
                  .levels = says("levels"),
                  .records = says("record"),
                  .frames = says("frame"),
                  .cameras = says("camera"),
                  .maps = says("disparity"),
                  .pixels = says("pixel")};
    const Abilities& can = abilities_;
    if (!can.views && !can.blocks && !can.frames && !can.cameras && !can.maps) {
      wrong_answer(request, "neither view nor block nor frame");
    }
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

DutAnswer<RgbImage> LineDecoder::view(ViewPos view) {
  const std::string request = fmt::format("view {} {}", view.row, view.col);
  RgbImage image{geometry_.width, geometry_.height, static_cast<int>(geometry_.depth), {}};
  const size_t count = size_t{image.width} * image.height * 3;
  const auto answer = ask(request, kLineBytes + count * kSampleDigits);
  if (!answer) return tl::unexpected(answer.error());
  image.samples = pixels_of(request, *answer, count, image.depth);
  return image;
}

DutAnswer<std::vector<int32_t>> LineDecoder::block(const BlockAddress& block, int stop_level) {
  const std::string request = "block " + place(block, stop_level);
  const auto answer = ask(request);
  if (!answer) return tl::unexpected(answer.error());
  return samples_of(request, *answer, size_t{1} << (2 * geometry_.block_log2));
}

DutAnswer<std::string> LineDecoder::lines(const std::string& request, size_t most) {
  const auto answer = ask(request);
  if (!answer) return tl::unexpected(answer.error());
  std::string_view rest = *answer;
  const auto count = take_number(rest);
  if (!count || *count > most) {
    wrong_answer(request, fmt::format("{} is not a number up to {}", shown(*answer), most));
  }
  std::string text;
  for (uint32_t i = 0; i < *count; ++i) text += line(request, {}, kLineBytes) + '\n';
  return text;
}

DutAnswer<std::string> LineDecoder::trace(const BlockAddress& block, int stop_level) {
  return lines("trace " + place(block, stop_level), kTraceLines);
}

DutAnswer<std::string> LineDecoder::pixel(const vectors::FrameCase& request, uint32_t x,
                                          uint32_t y) {
  return lines(
      fmt::format("pixel {} {} {} {}", x, y, request.stop_level, fmt::join(*request.record, ",")),
      kPixelLines);
}

DutAnswer<std::vector<int32_t>> LineDecoder::record(const hmlfc_dut_camera& camera) {
  const std::string request = "record " + vectors::camera_words(camera);
  const auto answer = ask(request);
  if (!answer) return tl::unexpected(answer.error());
  std::vector<int32_t> numbers(HMLFC_DUT_RECORD_NUMBERS);
  std::string_view rest = *answer;
  for (int32_t& number : numbers) {
    const auto value = take_number<int32_t>(rest);
    if (!value) wrong_answer(request, shown(*answer) + " has not 41 numbers");
    number = *value;
  }
  if (!rest.empty()) wrong_answer(request, shown(rest) + " after 41 numbers");
  return numbers;
}

DutAnswer<DutFrame> LineDecoder::frame(const vectors::FrameCase& request) {
  const std::string text = fmt::format("frame {} {}", request.stop_level,
                                       abilities_.frames && request.record
                                           ? fmt::format("{}", fmt::join(*request.record, ","))
                                           : vectors::camera_words(*request.camera));
  const vectors::FrameSum size = request.frame.value_or(vectors::FrameSum{});
  const size_t count = size_t{size.width} * size.height * 3;
  const auto answer = ask(text, kLineBytes + count * kSampleDigits);
  if (!answer) return tl::unexpected(answer.error());
  std::string_view rest = *answer;
  DutFrame frame;
  if (size.sha256.empty()) return frame;  // an error should have come
  for (int64_t* counted : {&frame.counts.pixels_outside, &frame.counts.blocks_needed,
                           &frame.counts.disparities_looked_up}) {
    if (take_word(rest, "-")) continue;
    const auto value = take_number(rest);
    if (!value) wrong_answer(text, shown(*answer) + " does not begin with three counts");
    *counted = *value;
  }
  frame.image = {size.width, size.height, size.depth, pixels_of(text, rest, count, size.depth)};
  return frame;
}

DutAnswer<std::vector<BlockDisparity>> LineDecoder::map(ViewPos view, size_t blocks) {
  const std::string request = fmt::format("disparity {} {}", view.row, view.col);
  const auto answer = ask(request, kLineBytes + blocks * kBlockDigits);
  if (!answer) return tl::unexpected(answer.error());
  return map_of(request, *answer, blocks);
}

void LineDecoder::close() {
  const auto answer = ask("close");
  if (!answer) wrong_answer("close", "error " + answer.error());
}

}  // namespace hmlfc::conform
