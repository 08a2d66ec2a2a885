// A stream opened from Python.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/renderer.hpp>

#include "python/object.hpp"
#include "python/raise.hpp"
#include "remote/open_source.hpp"

namespace hmlfc::python {

/// The rows and columns of views, the rows and columns of pixels in each, that are read: in any
/// order, each in the light field.
struct Part {
  std::vector<uint32_t> rows;
  std::vector<uint32_t> cols;
  std::vector<uint32_t> ys;
  std::vector<uint32_t> xs;
};

/// The bytes of a stream, its decoder and its renderer. Functions release the GIL while they
/// decode; several threads may call them, and frames are rendered one after another.
class Stream {
 public:
  static constexpr const char* kName = "hmlfc.Stream";

  /// The stream in a file, at an http:// address, of which sections are never checked, or
  /// in an object with contiguous bytes, which is kept and must not change. Raises OSError,
  /// TypeError, hmlfc.Error.
  static std::unique_ptr<Stream> from_file(const std::string& path, bool check_sections);
  static std::unique_ptr<Stream> from_buffer(PyObject* object, bool check_sections);

  const StreamHeader& header() const { return decoder_->header(); }
  bool is_remote() const { return is_remote_; }

  /// The pixels of `part`: (rows, cols, ys, xs, 3), uint8 at depth 8, else uint16. Views are
  /// decoded on all cores; Ctrl-C ends that of several.
  Object pixels(const Part& part, int stop_level) const;

  /// (B, B) int32 samples of a block; with `traced` also what was read and computed: lists of
  /// fields, vectors and stages, each a dict. Raises IndexError where there is no such block.
  Object block(const BlockAddress& block, int stop_level, bool traced) const;

  /// Disparities of the blocks of plane Y in units of 1/256 pixel a column, int16, and their
  /// confidence, uint8: each (rows of blocks, columns of blocks).
  Object disparity(ViewPos view) const;

  /// The text of section RIG (RIG-2); None without the section. Raises ValueError that names the
  /// member that is wrong.
  Object rig() const;

  /// What `hmlfc info --json` prints.
  std::string info() const;

  /// The frame of `camera`: (height, width, 3). Raises ValueError for a camera that takes none.
  Object render(const Camera& camera, int stop_level);

 private:
  Stream(std::optional<Buffer> buffer, std::unique_ptr<ByteSource> source, bool is_remote,
         bool check_sections);

  // The value of `result`; raises its error, or OSError where the file could not be read.
  template <class T>
  T value(Result<T> result) const {
    if (!result) raise_failure();
    return value_or_raise(std::move(result));
  }
  void raise_failure() const;

  std::optional<Buffer> buffer_;  // of a stream in memory
  std::unique_ptr<ByteSource> source_;
  bool is_remote_ = false;
  std::optional<Decoder> decoder_;
  std::mutex rendering_;
  std::unique_ptr<FrameRenderer> renderer_;
  Frame frame_;
};

/// Adds what reads: open_file() and open_buffer() make a stream, which the others take.
void add_stream(std::vector<PyMethodDef>& methods);

}  // namespace hmlfc::python
