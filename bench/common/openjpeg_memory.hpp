// OpenJPEG on memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include <openjpeg.h>

namespace hmlfc::bench {

using OpjStream = std::unique_ptr<opj_stream_t, decltype(&opj_stream_destroy)>;
using OpjCodec = std::unique_ptr<opj_codec_t, decltype(&opj_destroy_codec)>;
using OpjImage = std::unique_ptr<opj_image_t, decltype(&opj_image_destroy)>;

/// Bytes that OpenJPEG writes to or reads from.
struct OpjMemory {
  std::vector<uint8_t> bytes;
  size_t at = 0;
};

/// A stream that reads or writes `memory`, which must outlive it.
inline OpjStream opj_stream_on(OpjMemory& memory, bool reads) {
  OpjStream stream(opj_stream_default_create(reads ? OPJ_TRUE : OPJ_FALSE), &opj_stream_destroy);
  opj_stream_set_user_data(stream.get(), &memory, nullptr);
  opj_stream_set_user_data_length(stream.get(), memory.bytes.size());
  opj_stream_set_write_function(stream.get(),
                                [](void* data, OPJ_SIZE_T size, void* user) -> OPJ_SIZE_T {
                                  auto& to = *static_cast<OpjMemory*>(user);
                                  to.bytes.resize(std::max(to.bytes.size(), to.at + size));
                                  std::memcpy(to.bytes.data() + to.at, data, size);
                                  to.at += size;
                                  return size;
                                });
  opj_stream_set_read_function(
      stream.get(), [](void* data, OPJ_SIZE_T size, void* user) -> OPJ_SIZE_T {
        auto& from = *static_cast<OpjMemory*>(user);
        const size_t part = std::min<size_t>(size, from.bytes.size() - from.at);
        if (part == 0) return static_cast<OPJ_SIZE_T>(-1);
        std::memcpy(data, from.bytes.data() + from.at, part);
        from.at += part;
        return part;
      });
  opj_stream_set_skip_function(stream.get(), [](OPJ_OFF_T size, void* user) -> OPJ_OFF_T {
    auto& from = *static_cast<OpjMemory*>(user);
    if (size < 0 || static_cast<size_t>(size) > from.bytes.size() - from.at) return -1;
    from.at += static_cast<size_t>(size);
    return size;
  });
  opj_stream_set_seek_function(stream.get(), [](OPJ_OFF_T at, void* user) -> OPJ_BOOL {
    static_cast<OpjMemory*>(user)->at = static_cast<size_t>(at);
    return OPJ_TRUE;
  });
  return stream;
}

}  // namespace hmlfc::bench
