// APNG: the chunks of one PNG file a frame, put together with those that make them move.
#include "io/write_animation.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <zlib.h>

#include "io/atomic_file.hpp"
#include "io/encode_png.hpp"

namespace hmlfc::io {
namespace {

constexpr size_t kSignatureBytes = 8;
constexpr size_t kChunkHeadBytes = 8;  // length and type
constexpr size_t kCrcBytes = 4;

void append_be(std::vector<uint8_t>& out, uint32_t value, unsigned bytes) {
  for (unsigned k = bytes; k-- > 0;) out.push_back(static_cast<uint8_t>(value >> (8 * k)));
}

uint32_t load_be(std::span<const uint8_t> bytes) {
  return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

void append_chunk(std::vector<uint8_t>& out, std::string_view type, std::span<const uint8_t> data) {
  append_be(out, static_cast<uint32_t>(data.size()), 4);
  const size_t begin = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  const auto crc = crc32(0, out.data() + begin, static_cast<uInt>(out.size() - begin));
  append_be(out, static_cast<uint32_t>(crc), 4);
}

// Calls visit(type, data) for each chunk of a PNG file.
template <class Visit>
void for_each_chunk(std::span<const uint8_t> png, const Visit& visit) {
  auto left = png.subspan(kSignatureBytes);
  while (!left.empty()) {
    const size_t size = load_be(left);
    const std::string_view type(reinterpret_cast<const char*>(left.data()) + 4, 4);
    visit(type, left.subspan(kChunkHeadBytes, size));
    left = left.subspan(kChunkHeadBytes + size + kCrcBytes);
  }
}

// Builds the file frame by frame.
class Animation {
 public:
  Animation(size_t frames, unsigned rate) : frames_(frames), rate_(rate) {}

  void add(const RgbImage& image, std::span<const uint8_t> png) {
    const bool first = sequence_ == 0;
    if (first) out_.assign(png.begin(), png.begin() + kSignatureBytes);
    bool controlled = false;
    for_each_chunk(png, [&](std::string_view type, std::span<const uint8_t> data) {
      if (type == "IEND") return;
      if (type != "IDAT") {
        if (first) append_chunk(out_, type, data);
        return;
      }
      if (!controlled) {
        if (first) append_control();
        append_frame_control(image);
      }
      controlled = true;
      first ? append_chunk(out_, type, data) : append_frame_data(data);
    });
  }

  std::vector<uint8_t> finish() {
    append_chunk(out_, "IEND", {});
    return std::move(out_);
  }

 private:
  void append_control() {
    std::vector<uint8_t> data;
    append_be(data, static_cast<uint32_t>(frames_), 4);
    append_be(data, 0, 4);  // repeats without end
    append_chunk(out_, "acTL", data);
  }

  void append_frame_control(const RgbImage& image) {
    std::vector<uint8_t> data;
    append_be(data, sequence_++, 4);
    append_be(data, image.width, 4);
    append_be(data, image.height, 4);
    append_be(data, 0, 4);  // place
    append_be(data, 0, 4);
    append_be(data, 1, 2);  // seconds: 1 / rate
    append_be(data, rate_, 2);
    append_be(data, 0, 2);  // replaces the frame before
    append_chunk(out_, "fcTL", data);
  }

  void append_frame_data(std::span<const uint8_t> pixels) {
    std::vector<uint8_t> data;
    append_be(data, sequence_++, 4);
    data.insert(data.end(), pixels.begin(), pixels.end());
    append_chunk(out_, "fdAT", data);
  }

  size_t frames_;
  unsigned rate_;
  uint32_t sequence_ = 0;
  std::vector<uint8_t> out_;
};

}  // namespace

IoResult<void> write_apng(const std::filesystem::path& path, std::span<const RgbImage> frames,
                          unsigned rate) {
  Animation animation(frames.size(), rate);
  for (const RgbImage& image : frames) {
    const std::vector<uint8_t> png = encode_png(image);
    if (png.empty()) return file_error(path, "not enough memory to write a PNG picture");
    animation.add(image, png);
  }
  return write_file(path, animation.finish());
}

}  // namespace hmlfc::io
