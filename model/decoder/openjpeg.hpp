// OpenJPEG's handles, and its stream that reads from memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>

#include <openjpeg.h>

namespace hmlfc::openjpeg {

template <auto kDestroy>
struct Deleter {
  void operator()(auto* handle) const { kDestroy(handle); }
};
using Codec = std::unique_ptr<opj_codec_t, Deleter<opj_destroy_codec>>;
using Stream = std::unique_ptr<opj_stream_t, Deleter<opj_stream_destroy>>;
using Image = std::unique_ptr<opj_image_t, Deleter<opj_image_destroy>>;

/// Bytes and the place at which they are read next.
struct Source {
  std::span<const uint8_t> bytes;
  size_t at = 0;
};

inline OPJ_SIZE_T read_source(void* buffer, OPJ_SIZE_T count, void* user) {
  auto& source = *static_cast<Source*>(user);
  const size_t there = std::min<size_t>(count, source.bytes.size() - source.at);
  if (there == 0) return static_cast<OPJ_SIZE_T>(-1);
  std::memcpy(buffer, source.bytes.data() + source.at, there);
  source.at += there;
  return there;
}

inline OPJ_OFF_T skip_source(OPJ_OFF_T count, void* user) {
  auto& source = *static_cast<Source*>(user);
  if (count < 0 || static_cast<size_t>(count) > source.bytes.size() - source.at) return -1;
  source.at += static_cast<size_t>(count);
  return count;
}

inline OPJ_BOOL seek_source(OPJ_OFF_T position, void* user) {
  auto& source = *static_cast<Source*>(user);
  if (position < 0 || static_cast<size_t>(position) > source.bytes.size()) return OPJ_FALSE;
  source.at = static_cast<size_t>(position);
  return OPJ_TRUE;
}

/// A stream that reads `source`, which must outlive it; null where memory runs out. Its buffer
/// holds all bytes: OpenJPEG reads them at once, and seeks before it reads again.
inline Stream open_source(Source& source) {
  Stream stream(opj_stream_create(source.bytes.size(), OPJ_TRUE));
  if (!stream) return stream;
  opj_stream_set_user_data(stream.get(), &source, nullptr);
  opj_stream_set_user_data_length(stream.get(), source.bytes.size());
  opj_stream_set_read_function(stream.get(), read_source);
  opj_stream_set_skip_function(stream.get(), skip_source);
  opj_stream_set_seek_function(stream.get(), seek_source);
  return stream;
}

/// Suppresses OpenJPEG's messages: failures reach the caller as return values.
inline void silence(opj_codec_t* codec) {
  const auto ignore = [](const char*, void*) {};
  opj_set_info_handler(codec, ignore, nullptr);
  opj_set_warning_handler(codec, ignore, nullptr);
  opj_set_error_handler(codec, ignore, nullptr);
}

}  // namespace hmlfc::openjpeg
