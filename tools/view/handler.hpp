// From a request to its answer.
#pragma once

#include <optional>
#include <string>

#include "view/blocks.hpp"
#include "view/exchange.hpp"
#include "view/frames.hpp"
#include "view/guard.hpp"
#include "view/open_stream.hpp"
#include "view/other_blocks.hpp"
#include "view/pages.hpp"

namespace hmlfc::view {

/// The answer {"error": `text`}, without the headers of guard.hpp.
Response refusal(int status, const std::string& text);

/// Answers every request, whatever it holds: what is asked for, or {"error": text} with status 400
/// (a wrong query), 404 (no such address, or not from the page), 405, 422 (the stream is corrupt
/// there, or the decoder under test does not answer) or 503 (not enough memory). No part of a
/// request names a file. Several threads may ask at the same time.
class Handler {
 public:
  /// `stream`, and `other`, the decoder under test if there is one, must outlive it; `ahead` as for
  /// Frames.
  Handler(Site site, OpenStream& stream, OtherDecoder* other = nullptr, bool ahead = true);

  Response answer(const Request& request);

  /// For tests: waits until nothing is decoded ahead any more.
  void finish_ahead() { frames_.finish_ahead(); }

  /// The pages that are open: they hold the answer to "open".
  Pages& pages() { return pages_; }

 private:
  Response answer_page(std::string_view path, const Request& request);
  Response answer_get(std::string_view path, const Query& query);
  Response answer_other(std::string_view path, const Query& query);

  Site site_;
  OpenStream& stream_;
  Frames frames_;
  Blocks blocks_;
  std::optional<Blocks> twin_;  // of the stream beside it
  std::string other_name_;      // empty without a decoder under test
  std::optional<OtherBlocks> other_;
  Pages pages_;
};

}  // namespace hmlfc::view
