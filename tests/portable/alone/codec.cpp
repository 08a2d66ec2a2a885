// The library's three parts in one program:
//   codec FILE FOLDER                      all views, to FOLDER/views.raw
//   codec FILE RECORD STOP_LEVEL FOLDER    the frame of a record, to FOLDER/frame.raw
//   codec FILE PROFILE STREAM              the views, encoded in main or extended
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/dut.hpp>
#include <hmlfc/encoder.hpp>
#include <hmlfc/renderer.hpp>

namespace {

template <class Expected>
auto value_of(Expected result) {
  if (!result) std::exit(1);
  return *std::move(result);
}

void write_samples(std::ofstream& file, const hmlfc::RgbImage& image) {
  for (const uint16_t sample : image.samples) {
    file.put(static_cast<char>(sample & 0xFF));
    if (image.depth > 8) file.put(static_cast<char>(sample >> 8));
  }
}

hmlfc::RgbImage frame_of(const hmlfc::Decoder& decoder, char* numbers, const char* stop_level) {
  int32_t record[HMLFC_DUT_RECORD_NUMBERS] = {};
  for (int32_t& number : record) {
    number = static_cast<int32_t>(std::strtol(numbers, &numbers, 10));
    if (*numbers != 0) ++numbers;
  }
  hmlfc::Frame frame;
  const auto renderer = hmlfc::make_cpu_renderer(decoder);
  if (!renderer->render(hmlfc::frame_record_of(record), std::atoi(stop_level), frame)) std::exit(1);
  return frame.image;
}

}  // namespace

int main(int count, char** arguments) {
  std::ifstream input(arguments[1], std::ios::binary);
  const std::vector<uint8_t> bytes(std::istreambuf_iterator<char>(input), {});
  const auto decoder = value_of(hmlfc::Decoder::open(bytes));
  const auto& header = decoder.header();
  const char* name = count == 3 ? "/views.raw" : count == 5 ? "/frame.raw" : "";
  std::ofstream file(std::string(arguments[count - 1]) + name, std::ios::binary);
  if (count == 5) return write_samples(file, frame_of(decoder, arguments[2], arguments[3])), 0;
  hmlfc::LightField views({header.rows, header.cols, header.width, header.height, header.depth});
  for (uint32_t i = 0; i < header.rows * header.cols; ++i) {
    const hmlfc::ViewPos at{i / header.cols, i % header.cols};
    views.set_view(at.row, at.col, value_of(decoder.decode_view(at)));
    if (count == 3) write_samples(file, views.view(at.row, at.col));
  }
  if (count == 3) return 0;
  const auto profile = *arguments[2] == 'm' ? hmlfc::Profile::kMain : hmlfc::Profile::kExtended;
  for (const uint8_t byte : value_of(hmlfc::encode(views, {.profile = profile})).bytes) {
    file.put(static_cast<char>(byte));
  }
}
