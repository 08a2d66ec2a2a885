// A stream's bytes by what a command line names: a file or an address.
#pragma once

#include <filesystem>
#include <memory>

#include "io/files.hpp"
#include "remote/http_source.hpp"

namespace hmlfc::remote {

/// An open file; `http` is null unless it is on a web server.
struct OpenSource {
  std::unique_ptr<ByteSource> bytes;
  const HttpSource* http = nullptr;
};

/// Maps the file `path`, or opens what is at the address `path`. Errors: those of MappedFile::open
/// and HttpSource::open.
inline io::IoResult<OpenSource> open_source(const std::filesystem::path& path) {
  if (is_address(path)) {
    auto opened = HttpSource::open(path.string());
    if (!opened) return tl::unexpected(opened.error());
    const HttpSource* http = opened->get();
    return OpenSource{std::move(*opened), http};
  }
  auto mapped = io::map_file(path);
  if (!mapped) return tl::unexpected(mapped.error());
  return OpenSource{std::make_unique<MappedFile>(std::move(*mapped))};
}

}  // namespace hmlfc::remote
