#include "conform/line_server.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <hmlfc/error.hpp>

#include "conform/line_decoder.hpp"
#include "conform/line_words.hpp"
#include "conform/pixel_trace.hpp"
#include "conform/stage_trace.hpp"
#include "io/files.hpp"

namespace hmlfc::conform {
namespace {

constexpr uint16_t kNotWritten = 0xFFFF;  // no sample has 16 bits
constexpr int kBadRequest = static_cast<int>(ErrorCode::kBadRequest);
constexpr int kRefused = -2;  // a camera

// Four hexadecimal digits; a value that needs more becomes the nearest that does not.
void add_sample(std::string& text, int32_t value) {
  constexpr char kHex[] = "0123456789abcdef";
  const auto bits = static_cast<uint32_t>(std::clamp(value, -0x8000, 0xFFFF));
  for (int shift = 12; shift >= 0; shift -= 4) text += kHex[bits >> shift & 15];
}

void add_stage(void* lines, const hmlfc_dut_stage* stage) {
  static_cast<std::vector<std::string>*>(lines)->push_back(stage_line(*stage));
}

bool is_frame_size(const std::vector<int32_t>& record) {
  return record[0] >= 1 && record[0] <= kMaxFrameSide && record[1] >= 1 &&
         record[1] <= kMaxFrameSide;
}

class LineServer {
 public:
  explicit LineServer(const DutFunctions& functions) : functions_(functions) {}

  // What follows the number of the answer to `request`; nothing where the program must end, and
  // why.
  std::optional<std::string> answer(const std::string& request) {
    std::istringstream words(request);
    std::string word;
    words >> word;
    int status = kBadRequest;
    std::string text;
    if (word == "hello") {
      return fmt::format("ok {} view block levels{}{}{}{}{}", kLineProtocol,
                         functions_.trace_block != nullptr ? " trace" : "",
                         functions_.frame_record != nullptr ? " record" : "",
                         functions_.render_frame != nullptr ? " frame" : "",
                         functions_.trace_pixel != nullptr ? " pixel" : "",
                         functions_.disparity_map != nullptr ? " disparity" : "");
    }
    if (word == "open") {
      status = open(request.substr(std::min<size_t>(5, request.size())), text);
    } else if (stream_ != nullptr) {
      status = answer_about_stream(word, words, text);
    }
    if (end != ServeEnd::kInput) return std::nullopt;
    if (status == kRefused) return "error " + text;
    return status == 0 ? "ok" + text : "error " + name_of(status);
  }

  ServeEnd end = ServeEnd::kInput;

 private:
  using Handle = std::unique_ptr<hmlfc_dut, decltype(&hmlfc_dut_close)>;

  // Each sets `text`, what follows "ok", and returns the library's status.
  int open(const std::string& path, std::string& text) {
    stream_.reset();
    auto file = io::map_file(path);
    if (!file) {
      std::fprintf(stderr, "%s\n", file.error().message.c_str());
      end = ServeEnd::kNoFile;
      return kBadRequest;
    }
    file_.emplace(std::move(*file));
    hmlfc_dut* opened = nullptr;
    const int status =
        checked(functions_.open(file_->bytes().data(), file_->bytes().size(), &opened));
    stream_ = Handle(opened, functions_.close);
    if (status != 0) {
      stream_.reset();
      return status;
    }
    const int failed = checked(functions_.get_geometry(opened, &geometry_));
    for (const GeometryField& field : kGeometryFields) {
      text += fmt::format(" {}", geometry_.*field.value);
    }
    return failed;
  }

  int answer_about_stream(const std::string& word, std::istream& words, std::string& text) {
    if (word == "close") {
      stream_.reset();
      return 0;
    }
    if (word == "record" && functions_.frame_record != nullptr) return record(words, text);
    if (word == "frame" && functions_.render_frame != nullptr) return frame(words, text);
    uint32_t row = 0;
    uint32_t col = 0;
    if (!(words >> row >> col)) return kBadRequest;
    if (word == "pixel" && functions_.trace_pixel != nullptr) return pixel(row, col, words, text);
    if (word == "disparity" && functions_.disparity_map != nullptr) return map(row, col, text);
    if (word == "view") return view(row, col, text);
    uint32_t plane = 0;
    uint32_t x = 0;
    uint32_t y = 0;
    uint32_t level = 0;
    if (!(words >> plane >> x >> y >> level)) return kBadRequest;
    if (word == "block") {
      int32_t samples[HMLFC_DUT_BLOCK_SAMPLES] = {};
      const int status =
          checked(functions_.decode_block(stream_.get(), row, col, plane, x, y, level, samples));
      text = ' ';
      for (int i = 0; i < 1 << 2 * geometry_.block_log2; ++i) add_sample(text, samples[i]);
      return status;
    }
    if (word != "trace" || functions_.trace_block == nullptr || level != 0) return kBadRequest;
    std::vector<std::string> lines;
    const int status =
        checked(functions_.trace_block(stream_.get(), row, col, plane, x, y, add_stage, &lines));
    text = fmt::format(" {}", lines.size());
    for (const std::string& line : lines) text += '\n' + line;
    return status;
  }

  int view(uint32_t row, uint32_t col, std::string& text) {
    std::vector<uint16_t> rgb(size_t{geometry_.width} * geometry_.height * 3, kNotWritten);
    const int status = checked(functions_.decode_view(stream_.get(), row, col, rgb.data()));
    text = ' ';
    if (status == 0) {
      text.reserve(1 + rgb.size() * 4);
      for (const uint16_t sample : rgb) add_sample(text, sample);
    }
    return status;
  }

  // `text` is the input of a camera that is refused.
  int record(std::istream& words, std::string& text) {
    std::string word;
    words >> word;
    hmlfc_dut_camera camera;
    try {
      camera = vectors::camera_from_words(word);
    } catch (const io::TextError&) {
      return kBadRequest;
    }
    int32_t record[HMLFC_DUT_RECORD_NUMBERS] = {};
    const char* input = nullptr;
    const int status = checked(functions_.frame_record(stream_.get(), &camera, record, &input));
    if (status == 1 && input != nullptr) {
      text = input;
      return kRefused;
    }
    text = fmt::format(" {}", fmt::join(record, " "));
    return status;
  }

  int frame(std::istream& words, std::string& text) {
    uint32_t level = 0;
    std::string word;
    words >> level >> word;
    const auto record = record_from_words(word);
    if (!record || !is_frame_size(*record)) return kBadRequest;
    const auto side = [&](size_t i) { return static_cast<size_t>((*record)[i]); };
    std::vector<uint16_t> rgb(side(0) * side(1) * 3, kNotWritten);
    hmlfc_dut_counts counts{-1, -1, -1};
    const int status =
        checked(functions_.render_frame(stream_.get(), record->data(), level, rgb.data(), &counts));
    if (status != 0) return status;
    for (const int64_t count :
         {counts.pixels_outside, counts.blocks_needed, counts.disparities_looked_up}) {
      text += count < 0 ? " -" : fmt::format(" {}", count);
    }
    text += ' ';
    for (const uint16_t sample : rgb) add_sample(text, sample);
    return 0;
  }

  int pixel(uint32_t x, uint32_t y, std::istream& words, std::string& text) {
    uint32_t level = 0;
    std::string word;
    words >> level >> word;
    const auto record = record_from_words(word);
    if (!record) return kBadRequest;
    PixelLines lines;
    const int status = checked(functions_.trace_pixel(stream_.get(), record->data(), level, x, y,
                                                      PixelLines::add, &lines));
    text = lines.text();
    return status;
  }

  int map(uint32_t row, uint32_t col, std::string& text) {
    const uint32_t side = uint32_t{1} << geometry_.block_log2;
    const auto blocks = [&](uint32_t pixels) { return size_t{(pixels + side - 1) / side}; };
    const size_t count = blocks(geometry_.width) * blocks(geometry_.height);
    std::vector<int16_t> disparities(count);
    std::vector<uint8_t> confidences(count);
    const int status = checked(
        functions_.disparity_map(stream_.get(), row, col, disparities.data(), confidences.data()));
    text = ' ';
    for (size_t i = 0; i < count; ++i) {
      add_sample(text, static_cast<uint16_t>(disparities[i]));
      text += fmt::format("{:x}", std::min<int>(confidences[i], 15));
    }
    return status;
  }

  int checked(int status) {
    if (status == HMLFC_DUT_CANNOT_RUN) end = ServeEnd::kCannotRun;
    return status;
  }

  std::string name_of(int status) const {
    const char* name = functions_.error_name != nullptr ? functions_.error_name(status) : nullptr;
    if (name != nullptr) return name;
    const bool known = status > 0 && status < kErrorCodeCount;
    return known ? std::string(error_name(static_cast<ErrorCode>(status)))
                 : fmt::format("status {}", status);
  }

  const DutFunctions& functions_;
  std::optional<MappedFile> file_;
  Handle stream_{nullptr, functions_.close};
  hmlfc_dut_geometry geometry_{};
};

}  // namespace

ServeEnd serve_lines(const DutFunctions& functions) {
  const io::FileDescriptor descriptor(::dup(STDOUT_FILENO));
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  const auto write_all = [&](std::string_view text) {
    while (!text.empty()) {
      const ssize_t count = ::write(descriptor.get(), text.data(), text.size());
      if (count <= 0) return false;
      text.remove_prefix(static_cast<size_t>(count));
    }
    return true;
  };
  LineServer server(functions);
  std::string line;
  while (std::getline(std::cin, line)) {
    if (line.ends_with('\r')) line.pop_back();
    const size_t blank = std::min(line.find(' '), line.size());
    const auto answer = server.answer(line.substr(std::min(blank + 1, line.size())));
    if (!answer) return server.end;
    if (!write_all(line.substr(0, blank) + " " + *answer + "\n")) return ServeEnd::kOutput;
  }
  return ServeEnd::kInput;
}

}  // namespace hmlfc::conform
