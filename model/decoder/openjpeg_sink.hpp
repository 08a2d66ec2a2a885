// OpenJPEG's stream that writes to memory.
#pragma once

#include <new>
#include <vector>

#include "decoder/openjpeg.hpp"

namespace hmlfc::openjpeg {

/// Bytes, and the position of the next write.
struct Sink {
  std::vector<uint8_t> bytes;
  size_t at = 0;

  /// Whether there is memory for it: no exception passes through C.
  bool reserve_to(size_t end) {
    if (bytes.size() >= end) return true;
    try {
      bytes.resize(end);
      return true;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }
};

inline OPJ_SIZE_T write_sink(void* buffer, OPJ_SIZE_T count, void* user) {
  auto& sink = *static_cast<Sink*>(user);
  if (!sink.reserve_to(sink.at + count)) return static_cast<OPJ_SIZE_T>(-1);
  std::memcpy(sink.bytes.data() + sink.at, buffer, count);
  sink.at += count;
  return count;
}

inline OPJ_OFF_T skip_sink(OPJ_OFF_T count, void* user) {
  auto& sink = *static_cast<Sink*>(user);
  if (count < 0) return -1;
  sink.at += static_cast<size_t>(count);
  return sink.reserve_to(sink.at) ? count : -1;
}

inline OPJ_BOOL seek_sink(OPJ_OFF_T position, void* user) {
  auto& sink = *static_cast<Sink*>(user);
  if (position < 0) return OPJ_FALSE;
  sink.at = static_cast<size_t>(position);
  return sink.reserve_to(sink.at) ? OPJ_TRUE : OPJ_FALSE;
}

/// A stream that writes to `sink`, which must outlive it; null if memory runs out.
inline Stream open_sink(Sink& sink) {
  Stream stream(opj_stream_create(OPJ_J2K_STREAM_CHUNK_SIZE, OPJ_FALSE));
  if (!stream) return stream;
  opj_stream_set_user_data(stream.get(), &sink, nullptr);
  opj_stream_set_write_function(stream.get(), write_sink);
  opj_stream_set_skip_function(stream.get(), skip_sink);
  opj_stream_set_seek_function(stream.get(), seek_sink);
  return stream;
}

}  // namespace hmlfc::openjpeg
