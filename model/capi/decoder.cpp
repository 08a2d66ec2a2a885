// Decoding by hmlfc.h.
#include <hmlfc/decoder.hpp>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <span>
#include <string>
#include <system_error>

#include <hmlfc/hmlfc.h>

#include "bits/mapped_file.hpp"
#include "capi/callback_source.hpp"
#include "capi/handles.hpp"
#include "capi/outcome.hpp"
#include "capi/pixels.hpp"
#include "capi/structs.hpp"

namespace hmlfc::capi {
namespace {

tl::expected<OpenOptions, Refusal> read_open_options(const hmlfc_open_options* options) {
  const auto given = read_options(options, &hmlfc_open_options::reserved, "options");
  if (!given) return tl::unexpected(given.error());
  if (given->skip_sections > 1) return bad_argument("options", "has skip_sections above 1");
  if (given->reserved != 0) return bad_argument("options", "has a value in reserved");
  OpenOptions read;
  read.check_sections = given->skip_sections == 0;
  if (given->max_plane_samples != 0) read.limits.max_plane_samples = given->max_plane_samples;
  if (given->max_code_blocks != 0) read.limits.max_code_blocks = given->max_code_blocks;
  return read;
}

Outcome open_stream(std::shared_ptr<OpenedStream> stream, const OpenOptions& options,
                    hmlfc_decoder** decoder) {
  if (const auto opened = stream->open(options); !opened) return stream->refuse(opened.error());
  *decoder = new hmlfc_decoder{std::move(stream)};
  return {};
}

Outcome open_memory(const uint8_t* bytes, size_t size, const hmlfc_open_options* options,
                    hmlfc_decoder** decoder) {
  if (auto ok = check_pointer(decoder, "decoder"); !ok) return ok;
  *decoder = nullptr;
  if (bytes == nullptr && size > 0) return bad_argument("bytes", "is null");
  const auto read = read_open_options(options);
  if (!read) return tl::unexpected(read.error());
  return open_stream(
      std::make_shared<OpenedStream>(std::make_unique<MemorySource>(std::span(bytes, size))), *read,
      decoder);
}

tl::unexpected<Refusal> no_file(const char* path, const MapFailure& failure) {
  std::string text = failure.reason;
  if (failure.system_error != 0) {
    text += ": " + std::generic_category().message(failure.system_error);
  }
  const bool no_memory = failure.system_error == ENOMEM;
  return refuse(no_memory ? HMLFC_STATUS_OUT_OF_MEMORY : HMLFC_STATUS_NO_FILE, text + ": " + path);
}

Outcome open_file(const char* path, const hmlfc_open_options* options, hmlfc_decoder** decoder) {
  if (auto ok = check_pointer(decoder, "decoder"); !ok) return ok;
  *decoder = nullptr;
  if (auto ok = check_pointer(path, "path"); !ok) return ok;
  const auto read = read_open_options(options);
  if (!read) return tl::unexpected(read.error());
  auto mapped = MappedFile::open(path);
  if (!mapped) return no_file(path, mapped.error());
  auto source = std::make_unique<MappedFile>(std::move(*mapped));
  return open_stream(std::make_shared<OpenedStream>(std::move(source)), *read, decoder);
}

Outcome open_source(const hmlfc_source* source, const hmlfc_open_options* options,
                    hmlfc_decoder** decoder) {
  if (auto ok = check_pointer(decoder, "decoder"); !ok) return ok;
  *decoder = nullptr;
  const auto given = read_struct(source, &hmlfc_source::cache_bytes, "source");
  if (!given) return tl::unexpected(given.error());
  if (given->read == nullptr) return bad_argument("source", "has null as read");
  const auto read = read_open_options(options);
  if (!read) return tl::unexpected(read.error());
  auto made = std::make_unique<CallbackSource>(*given);
  if (!made->is_reserved()) {
    return refuse(HMLFC_STATUS_OUT_OF_MEMORY, "out_of_memory: no address space for the stream");
  }
  return open_stream(std::make_shared<OpenedStream>(std::move(made)), *read, decoder);
}

Outcome get_header(const hmlfc_decoder* decoder, hmlfc_header* header) {
  if (auto ok = check_pointer(decoder, "decoder"); !ok) return ok;
  if (auto ok = check_pointer(header, "header"); !ok) return ok;
  if (!reaches(header->struct_size, &hmlfc_header::feature_flags)) {
    return bad_argument("header", "has too small a struct_size");
  }
  const StreamHeader& from = decoder->stream->decoder().header();
  hmlfc_header told{};
  told.rows = from.rows;
  told.cols = from.cols;
  told.width = from.width;
  told.height = from.height;
  told.depth = static_cast<uint32_t>(from.depth);
  told.chroma_format = static_cast<uint32_t>(from.chroma_format);
  told.block_size = from.block_size();
  told.tree_height = static_cast<uint32_t>(from.tree_height);
  told.profile = static_cast<uint32_t>(from.profile);
  told.feature_flags = from.feature_flags;
  write_struct(told, *header);
  return {};
}

Outcome check_view(const StreamHeader& header, uint32_t row, uint32_t col) {
  if (row < header.rows && col < header.cols) return {};
  return refuse(HMLFC_STATUS_BAD_REQUEST, "bad_request: view " + std::to_string(row) + "," +
                                              std::to_string(col) + " does not exist: rows 0 to " +
                                              std::to_string(header.rows - 1) + ", columns 0 to " +
                                              std::to_string(header.cols - 1));
}

Outcome decode_block(const hmlfc_decoder* decoder, const hmlfc_block* block, int32_t* samples,
                     size_t count) {
  if (auto ok = check_pointer(decoder, "decoder"); !ok) return ok;
  const auto asked = read_struct(block, &hmlfc_block::stop_level, "block");
  if (!asked) return tl::unexpected(asked.error());
  if (auto ok = check_pointer(samples, "samples"); !ok) return ok;
  const Decoder& from = decoder->stream->decoder();
  const size_t side = from.header().block_size();
  if (count < side * side) return bad_argument("count", "is less than the samples of a block");
  if (auto ok = check_view(from.header(), asked->row, asked->col); !ok) return ok;
  if (asked->plane >= kPlaneCount) return refuse(Error{ErrorCode::kBadRequest});
  const BlockAddress address{
      {asked->row, asked->col}, static_cast<Plane>(asked->plane), asked->block_x, asked->block_y};
  const auto decoded =
      from.decode_block(address, {.stop_level = static_cast<int>(asked->stop_level)});
  if (!decoded) return decoder->stream->refuse(decoded.error());
  std::copy(decoded->begin(), decoded->end(), samples);
  return {};
}

// `asked` may be of any size; memory is asked for only where it lies in the view.
Outcome decode_rect(const OpenedStream& stream, const hmlfc_rect& asked,
                    const hmlfc_pixels* pixels) {
  const Decoder& from = stream.decoder();
  const StreamHeader& header = from.header();
  if (auto ok = check_view(header, asked.row, asked.col); !ok) return ok;
  const bool is_inside = asked.width >= 1 && asked.height >= 1 && asked.x < header.width &&
                         asked.y < header.height && asked.width <= header.width - asked.x &&
                         asked.height <= header.height - asked.y;
  if (!is_inside) return refuse(Error{ErrorCode::kBadRequest});
  const auto into = read_pixels(pixels, asked.width, asked.height, header.depth);
  if (!into) return tl::unexpected(into.error());
  const auto decoded =
      from.decode_rgb({asked.row, asked.col}, {asked.x, asked.y, asked.width, asked.height},
                      static_cast<int>(asked.stop_level));
  if (!decoded) return stream.refuse(decoded.error());
  store(*decoded, *into);
  return {};
}

Outcome decode_rect(const hmlfc_decoder* decoder, const hmlfc_rect* rect,
                    const hmlfc_pixels* pixels) {
  if (auto ok = check_pointer(decoder, "decoder"); !ok) return ok;
  const auto asked = read_struct(rect, &hmlfc_rect::stop_level, "rect");
  if (!asked) return tl::unexpected(asked.error());
  return decode_rect(*decoder->stream, *asked, pixels);
}

Outcome decode_view(const hmlfc_decoder* decoder, uint32_t row, uint32_t col,
                    const hmlfc_pixels* pixels) {
  if (auto ok = check_pointer(decoder, "decoder"); !ok) return ok;
  const StreamHeader& header = decoder->stream->decoder().header();
  hmlfc_rect all{};
  all.row = row, all.col = col;
  all.width = header.width, all.height = header.height;
  return decode_rect(*decoder->stream, all, pixels);
}

}  // namespace
}  // namespace hmlfc::capi

namespace capi = hmlfc::capi;

int hmlfc_open_memory(const uint8_t* bytes, size_t size, const hmlfc_open_options* options,
                      hmlfc_decoder** decoder, hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::open_memory(bytes, size, options, decoder); });
}

int hmlfc_open_file(const char* path, const hmlfc_open_options* options, hmlfc_decoder** decoder,
                    hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::open_file(path, options, decoder); });
}

int hmlfc_open_source(const hmlfc_source* source, const hmlfc_open_options* options,
                      hmlfc_decoder** decoder, hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::open_source(source, options, decoder); });
}

void hmlfc_close(hmlfc_decoder* decoder) { delete decoder; }

int hmlfc_get_header(const hmlfc_decoder* decoder, hmlfc_header* header, hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::get_header(decoder, header); });
}

int hmlfc_decode_block(const hmlfc_decoder* decoder, const hmlfc_block* block, int32_t* samples,
                       size_t count, hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::decode_block(decoder, block, samples, count); });
}

int hmlfc_decode_rect(const hmlfc_decoder* decoder, const hmlfc_rect* rect,
                      const hmlfc_pixels* pixels, hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::decode_rect(decoder, rect, pixels); });
}

int hmlfc_decode_view(const hmlfc_decoder* decoder, uint32_t row, uint32_t col,
                      const hmlfc_pixels* pixels, hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::decode_view(decoder, row, col, pixels); });
}
