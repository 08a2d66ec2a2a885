// What tests of the handler of `hmlfc view` share: a stream in a file, and a handler on it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "support/streams.hpp"
#include "view/handler.hpp"

namespace hmlfc::view {

/// A stream in a file of its own.
class StreamOnDisk {
 public:
  explicit StreamOnDisk(const test::Bytes& bytes) {
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  ~StreamOnDisk() { std::filesystem::remove(path_); }
  StreamOnDisk(const StreamOnDisk&) = delete;
  StreamOnDisk& operator=(const StreamOnDisk&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ = testing::TempDir() + "hmlfc-view-" + random_token() + ".hmlfc";
};

/// All bytes of an open stream.
inline test::Bytes bytes_of(const OpenStream& stream) {
  const cli::StreamFile& file = stream.for_blocks();
  test::Bytes copy;
  file.with_bytes({0, file.size()}, [&copy](std::span<const uint8_t> bytes) {
    copy.assign(bytes.begin(), bytes.end());
  });
  return copy;
}

inline test::Bytes some_stream() { return test::drawn_stream(test::row_of_views(1), 7); }

/// A handler and what it needs. Its token is "token", its port 80.
struct Fixture {
  explicit Fixture(const test::Bytes& bytes = some_stream())
      : file(bytes), stream(file.path(), {}) {}

  Response get(const std::string& path, const Query& query = {}) {
    return handler.answer({"GET", "/token/" + path, query, "127.0.0.1:80", "", ""});
  }

  StreamOnDisk file;
  OpenStream stream;
  Handler handler{{80, "token"}, stream};
};

}  // namespace hmlfc::view
