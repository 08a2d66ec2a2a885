// What tests of the handler of `hmlfc view` share: a stream, and a handler on it.
#pragma once

#include <string>
#include <utility>

#include "support/streams.hpp"
#include "view/handler.hpp"

namespace hmlfc::view {

inline test::Bytes some_stream() { return test::drawn_stream(test::row_of_views(1), 7); }

/// A handler and what it needs. Its token is "token", its port 80.
struct Fixture {
  explicit Fixture(test::Bytes stream_bytes = some_stream()) : bytes(std::move(stream_bytes)) {}

  Response get(const std::string& path, const Query& query = {}) {
    return handler.answer({"GET", "/token/" + path, query, "127.0.0.1:80", "", ""});
  }

  test::Bytes bytes;
  OpenStream stream{"a.hmlfc", bytes};
  Handler handler{{80, "token"}, stream};
};

}  // namespace hmlfc::view
