// An .hmlfc file open for decoding, and the views of a light field wherever they come from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <hmlfc/decoder.hpp>
#include <hmlfc/light_field.hpp>
#include <hmlfc/view_provider.hpp>

#include "cli/output.hpp"
#include "io/image_files.hpp"
#include "io/view_list.hpp"
#include "remote/open_source.hpp"

namespace hmlfc::cli {

/// The bytes of the file or the address `path`. Failure: they cannot be read (kInput).
std::shared_ptr<const remote::OpenSource> open_source(const std::filesystem::path& path);

/// A stream in a file or at an address, with its decoder. All functions throw a Failure that names
/// it. Sections of a stream at an address are not checked: that would fetch all of it.
class StreamFile {
 public:
  /// Failures: the file cannot be read (kInput), or is not an intact stream (kCorrupt).
  explicit StreamFile(std::filesystem::path path, const OpenOptions& options = {});

  /// Decodes `source`, which is that of `path`.
  StreamFile(std::filesystem::path path, std::shared_ptr<const remote::OpenSource> source,
             const OpenOptions& options);

  const std::filesystem::path& path() const { return path_; }
  const Decoder& decoder() const { return decoder_; }
  const StreamHeader& header() const { return decoder_.header(); }
  ByteSource& source() const { return *source_->bytes; }
  uint64_t size() const { return source_->bytes->bytes().size(); }

  /// Whether it is at an address.
  bool is_remote() const { return source_->http != nullptr; }

  /// What was fetched until now; nothing of a file.
  std::optional<remote::FetchCounts> fetched() const;

  /// The value of `result`, an answer of the decoder. Failures: a corrupt stream (kCorrupt), a
  /// server that does not give the bytes (kInput), and others by the error.
  template <class T>
  T value(Result<T> result) const {
    if (!result) throw failure(result.error());
    if constexpr (!std::is_void_v<T>) return std::move(*result);
  }

  /// Failure (kInput) once the server has not given bytes: for answers in which blocks may have
  /// errors.
  void check_readable() const;

  /// Calls use(bytes of `range`), which lies in the file. Failure: it cannot be read (kInput).
  void with_bytes(ByteRange range, const std::function<void(std::span<const uint8_t>)>& use) const;

  /// Checks the crc of every section, of a file alone.
  Result<void> check_sections() const;

  /// Usage failure unless `view` is in the grid.
  void check_view(ViewPos view) const;

  /// The stop level that uses `levels` levels of the tree, counted from the top; usage failure
  /// unless `levels` lies in [1, tree_height + 1].
  int stop_level(int levels) const;

 private:
  Result<Decoder> open(OpenOptions options) const;
  Failure failure(const Error& error) const;

  std::filesystem::path path_;
  std::shared_ptr<const remote::OpenSource> source_;
  Decoder decoder_;
};

/// The views in `folder`; notes how names were understood. Failures (kInput): those of
/// io::list_views.
io::ViewList views_in(const std::filesystem::path& folder, const io::ViewNaming& naming);

/// A folder of images or an .hmlfc stream. Const functions may be called concurrently.
class ViewSource : public ViewProvider {
 public:
  /// View `view`, which lies in the grid. Failures: an image that cannot be read, or whose size or
  /// depth differs from the first (kInput); a corrupt stream (kCorrupt).
  RgbImage view(ViewPos view) const override = 0;

  /// Opens `path`; `naming` is that of a folder, `path` or `other`. Tells what reading a folder's
  /// images changes or leaves out, each kind once. Failures: nothing there, not a light field
  /// (kInput), a corrupt stream (kCorrupt), `naming` without a folder (kUsage).
  static std::unique_ptr<ViewSource> open(const std::filesystem::path& path,
                                          const io::ViewNaming& naming = {},
                                          const std::filesystem::path& other = {});

  /// The views in `files`. Notes and failures as above.
  static std::unique_ptr<ViewSource> of_files(io::ViewList files);

  /// Usage failure unless `view` is in the grid.
  void check_view(ViewPos view) const;
};

/// Usage failure unless `rect` lies in a view and is not empty.
void check_rect(const Rect& rect, const LightFieldShape& shape);

/// The shape of the light field in a stream.
LightFieldShape shape_of(const StreamHeader& header);

/// "9 x 9 views of 512 x 384 pixels, 8 bits".
std::string describe(const LightFieldShape& shape);

}  // namespace hmlfc::cli
