// PNG through libpng, into memory first. As in read_png.cpp, libpng's longjmp only crosses
// functions whose locals need no destructor.
#include "io/image_files.hpp"

#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <zlib.h>

#include "io/files.hpp"

namespace hmlfc::io {

namespace {

// Level 1 with one fixed filter writes photographs about eight times as fast as libpng's defaults,
// for about a sixth more bytes.
constexpr int kCompressionLevel = 1;

struct PngOutput {
  std::vector<uint8_t> bytes;
  bool out_of_memory = false;
};

void append_bytes(png_structp png, png_bytep data, size_t count) {
  auto& output = *static_cast<PngOutput*>(png_get_io_ptr(png));
  try {
    output.bytes.insert(output.bytes.end(), data, data + count);
  } catch (const std::bad_alloc&) {
    output.out_of_memory = true;
  }
  if (output.out_of_memory) png_error(png, "out of memory");
}

[[noreturn]] void give_up(png_structp png, png_const_charp) { png_longjmp(png, 1); }

void ignore_png_warning(png_structp, png_const_charp) {}

/// A picture to write, and how.
struct PngInput {
  const RgbImage& image;
  const char* software;  ///< "": none
  bool grey;             ///< R alone
};

/// The 8 or big-endian 16 bits of each sample of one pixel row.
void pack_row(const PngInput& input, size_t y, uint8_t* out) {
  const size_t count = size_t{input.image.width} * 3;
  const uint16_t* row = input.image.samples.data() + y * count;
  const int depth = input.image.depth;
  for (size_t i = 0; i < count; i += input.grey ? 3 : 1) {
    if (depth == 8) {
      *out++ = static_cast<uint8_t>(row[i]);
      continue;
    }
    const uint32_t value = uint32_t{row[i]} << (16 - depth) | uint32_t{row[i]} >> (2 * depth - 16);
    *out++ = static_cast<uint8_t>(value >> 8);
    *out++ = static_cast<uint8_t>(value);
  }
}

void write_header(png_structp png, png_infop info, const PngInput& input) {
  const auto& [image, software, grey] = input;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_compression_level(png, kCompressionLevel);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_IHDR(png, info, image.width, image.height, image.depth == 8 ? 8 : 16,
               grey ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (image.depth > 8) {
    const auto bits = static_cast<png_byte>(image.depth);
    const png_color_8 significant = {bits, bits, bits, bits, 0};
    png_set_sBIT(png, info, &significant);
  }
  if (*software != 0) {
    char keyword[] = "Software";
    png_text text = {};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = keyword;
    text.text = const_cast<char*>(software);  // libpng only reads it
    png_set_text(png, info, &text, 1);
  }
  png_write_info(png, info);
}

/// False where libpng reported an error; `row` has room for one packed row.
bool encode(png_structp png, png_infop info, const PngInput& input, uint8_t* row) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  write_header(png, info, input);
  for (size_t y = 0; y < input.image.height; ++y) {
    pack_row(input, y, row);
    png_write_row(png, row);
  }
  png_write_end(png, nullptr);
  return true;
}

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

std::vector<uint8_t> encode_png(const RgbImage& image, const std::string& software, bool grey) {
  PngOutput output;
  std::vector<uint8_t> row(size_t{image.width} * 3 * (image.depth == 8 ? 1 : 2));
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, give_up, ignore_png_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool done = false;
  if (info != nullptr) {
    png_set_write_fn(png, &output, append_bytes, nullptr);
    done = encode(png, info, {image, software.c_str(), grey}, row.data());
  }
  png_destroy_write_struct(&png, &info);
  if (!done) output.bytes.clear();
  return std::move(output.bytes);
}

IoResult<void> write_png(const std::filesystem::path& path, const RgbImage& image,
                         const std::string& software, bool grey) {
  const std::vector<uint8_t> bytes = encode_png(image, software, grey);
  if (bytes.empty()) return memory_error(path, "to write a PNG picture");
  return write_file(path, bytes);
}

IoResult<void> write_ppm(const std::filesystem::path& path, const RgbImage& image) {
  const std::string header = "P6\n" + std::to_string(image.width) + " " +
                             std::to_string(image.height) + "\n" +
                             std::to_string((1 << image.depth) - 1) + "\n";
  std::vector<uint8_t> bytes(header.begin(), header.end());
  bytes.reserve(header.size() + image.samples.size() * (image.depth > 8 ? 2 : 1));
  for (const uint16_t sample : image.samples) {
    if (image.depth > 8) bytes.push_back(static_cast<uint8_t>(sample >> 8));
    bytes.push_back(static_cast<uint8_t>(sample));
  }
  return write_file(path, bytes);
}

IoResult<void> write_apng(const std::filesystem::path& path, std::span<const RgbImage> frames,
                          unsigned rate, const std::string& software) {
  Animation animation(frames.size(), rate);
  for (const RgbImage& image : frames) {
    const std::vector<uint8_t> png = encode_png(image, software);
    if (png.empty()) return memory_error(path, "to write a PNG picture");
    animation.add(image, png);
  }
  return write_file(path, animation.finish());
}

}  // namespace hmlfc::io
