#include "view/handler.hpp"

#include <new>
#include <utility>

#include <nlohmann/json.hpp>

#include "view/assets.hpp"
#include "view/stream_facts.hpp"

namespace hmlfc::view {

using cli::ExitCode;
using cli::Failure;
using cli::Json;

namespace {

// With text of any bytes.
Response json_answer(const Json& json, int status = 200) {
  return {.status = status, .body = json.dump(-1, ' ', true, Json::error_handler_t::replace)};
}

int status_of(ExitCode code) {
  switch (code) {
    case ExitCode::kUsage:
    case ExitCode::kInput:
      return 400;
    case ExitCode::kCorrupt:
      return 422;
    case ExitCode::kOutOfMemory:
      return 503;
    default:
      return 500;
  }
}

}  // namespace

Response refusal(int status, const std::string& text) {
  return json_answer({{"error", text}}, status);
}

Handler::Handler(Site site, OpenStream& stream, OtherDecoder* other, bool ahead)
    : site_(std::move(site)), stream_(stream), frames_(stream, ahead), blocks_(stream) {
  if (stream.twin() != nullptr) twin_.emplace(*stream.twin());
  if (other == nullptr) return;
  other_name_ = other->name();
  other_.emplace(stream, *other);
}

Response Handler::answer(const Request& request) {
  Response response;
  const auto path = asked_for(request, site_);
  if (!path) {
    response = refusal(404, "Nothing here. Use the address that hmlfc view printed");
  } else {
    try {
      response = answer_page(*path, request);
    } catch (const Failure& failure) {
      response = refusal(status_of(failure.code()), failure.what());
    } catch (const std::bad_alloc&) {
      response = refusal(503, "Not enough memory");
    } catch (const std::exception& error) {
      response = refusal(500, std::string("Internal error: ") + error.what());
    }
  }
  add_safety_headers(response);
  return response;
}

Response Handler::answer_page(std::string_view path, const Request& request) {
  if (path == "arrived") {
    if (request.method != "POST") return refusal(405, "POST alone");
    pages_.arrived(std::chrono::steady_clock::now());
    return {.body = "{}"};
  }
  if (request.method != "GET" && request.method != "HEAD") return refusal(405, "GET alone");
  return answer_get(path, request.query);
}

Response Handler::answer_get(std::string_view path, const Query& query) {
  if (path == "open") return {.open = pages_.opened()};
  if (path == "frame") return frames_.frame(query);
  if (path == "frame.png") return frames_.png(query);
  if (path == "focus") return frames_.focus(query);
  if (path == "trace") return frames_.trace(query);
  const bool beside = twin_ && path.starts_with("twin-");
  Blocks& blocks = beside ? *twin_ : blocks_;
  if (beside) path.remove_prefix(5);
  if (path == "picture") return blocks.picture(query);
  if (path == "original" || path == "difference") {
    return blocks.original(query, path == "difference");
  }
  if (path == "stage") return blocks.stage(query);
  if (path == "blocks") return blocks.blocks(query);
  if (path == "block") return blocks.block(query);
  if (path.starts_with("dut-")) return answer_other(path, query);
  if (path == "stream") {
    Json facts = stream_facts(stream_);
    facts["dut"] = other_name_;
    return json_answer(facts);
  }
  if (path == "totals") return json_answer(stream_totals(stream_));
  if (path.empty()) pages_.sent(std::chrono::steady_clock::now());
  const Asset* asset = find_asset(path.empty() ? "index.html" : path);
  if (asset == nullptr) return refusal(404, "No such address");
  return {.type = std::string(asset->type), .body = std::string(asset->content)};
}

Response Handler::answer_other(std::string_view path, const Query& query) {
  if (!other_) {
    return refusal(400, "there is no decoder under test; start with --dut DUT");
  }
  if (path == "dut-picture") return other_->picture(query, false);
  if (path == "dut-difference") return other_->picture(query, true);
  if (path == "dut-blocks") return other_->blocks(query);
  if (path == "dut-block") return other_->block(query);
  return refusal(404, "No such address");
}

}  // namespace hmlfc::view
