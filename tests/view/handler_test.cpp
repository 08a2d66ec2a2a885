// The handler of `hmlfc view`, without sockets; the fuzz target view asks it anything.
#include "view/handler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include <nlohmann/json.hpp>

#include <hmlfc/stream_info.hpp>

#include "handler_fixture.hpp"

namespace hmlfc::view {
namespace {

using nlohmann::json;

// What the last of three frames of a moving camera waits for; --no-ahead.
TEST(ViewHandler, KeyImagesAreDecodedAheadOfTheMotion) {
  StreamHeader header = test::row_of_views(0);
  header.cols = 24;
  const auto bytes = test::drawn_stream(header, 7);
  const auto waits = [&bytes](bool ahead) {
    OpenStream stream("a.hmlfc", bytes);
    Handler handler({80, "token"}, stream, nullptr, ahead);
    uint64_t samples = 0;
    for (const char* camera : {"12,0", "12.5,0", "15,0"}) {
      const Query query{{"camera", camera}, {"size", "8x6"}, {"geometry", "plane"}};
      const Response response =
          handler.answer({"GET", "/token/frame", query, "127.0.0.1:80", "", ""});
      EXPECT_EQ(response.status, 200) << response.body;
      handler.finish_ahead();
      for (const auto& [name, value] : response.headers) {
        if (name == "Frame") samples = json::parse(value).at("key_samples");
      }
    }
    return samples;
  };
  EXPECT_GT(waits(false), 0u);
  EXPECT_EQ(waits(true), 0u);
}

TEST(ViewHandler, RawBitsAreThoseOfTheFile) {
  Fixture fixture;
  const Response response =
      fixture.get("block", {{"view", "0,4"}, {"plane", "Y"}, {"block", "2,3"}});
  ASSERT_EQ(response.status, 200) << response.body;
  size_t rows = 0;
  const json page = json::parse(response.body);
  for (const json& level : page["levels"]) {
    for (const json& walk : level["walks"]) {
      for (const json& row : walk["rows"]) {
        const std::string address = row["address"];
        const uint64_t bit = 8 * std::stoull(address, nullptr, 16) +
                             std::stoull(address.substr(address.find('.') + 1));
        const std::string raw = row["raw"];
        if (raw.empty()) continue;
        const bool binary = raw.starts_with("0b");
        const uint64_t last = binary ? raw.size() - 3 : 0;  // the lowest digit stands last
        const uint64_t low = std::stoull(raw.substr(raw.size() - 1), nullptr, 16);
        EXPECT_EQ(low & 1, fixture.bytes[bit >> 3] >> (bit & 7) & 1u) << row;
        if (binary) {
          const uint64_t top = bit + last;
          EXPECT_EQ(raw[2] - '0', fixture.bytes[top >> 3] >> (top & 7) & 1) << row;
        }
        ++rows;
      }
    }
  }
  EXPECT_GT(rows, 8u);
}

TEST(ViewHandler, RefusalsNameWhatIsWrong) {
  Fixture fixture;
  const auto refusal = [&fixture](const std::string& path, const Query& query) {
    const Response response = fixture.get(path, query);
    EXPECT_EQ(response.status, 400) << path;
    return json::parse(response.body).at("error").get<std::string>();
  };
  EXPECT_NE(refusal("frame", {{"size", "5000x5"}}).find("[1, 4096]"), std::string::npos);
  EXPECT_NE(refusal("frame", {{"path", "/etc/passwd"}}).find("'path'"), std::string::npos);
  EXPECT_NE(refusal("frame", {{"camera", "9999,0"}}).find("--camera"), std::string::npos);
  EXPECT_NE(refusal("blocks", {{"view", "9,9"}, {"plane", "Y"}}).find("does not exist"),
            std::string::npos);
  EXPECT_NE(refusal("difference", {{"view", "0,0"}}).find("--original"), std::string::npos);
  EXPECT_EQ(fixture.get("nosuch").status, 404);
  EXPECT_EQ(fixture.get("../CMakeLists.txt").status, 404);
  EXPECT_EQ(fixture.get("").status, 200);
  EXPECT_EQ(fixture.handler.answer({"POST", "/token/frame", {}, "127.0.0.1:80", "", ""}).status,
            405);
  EXPECT_EQ(fixture.handler.answer({"GET", "/token/arrived", {}, "127.0.0.1:80", "", ""}).status,
            405);
}

TEST(ViewHandler, EveryAnswerIsSafe) {
  Fixture fixture;
  for (const char* path : {"", "stream", "nosuch", "frame"}) {
    const Response response = fixture.get(path);
    const auto has = [&response](std::string_view name, std::string_view part) {
      return std::ranges::any_of(response.headers, [&](const auto& header) {
        return header.first == name && header.second.find(part) != std::string::npos;
      });
    };
    EXPECT_TRUE(has("Content-Security-Policy", "default-src 'none'")) << path;
    EXPECT_TRUE(has("X-Content-Type-Options", "nosniff")) << path;
    EXPECT_TRUE(has("Cache-Control", "no-store")) << path;
  }
}

// The conformance suite has streams of every shape, and a damaged one for every error.
TEST(ViewHandler, ShowsEveryVectorAsFarAsItGoes) {
  size_t opened = 0;
  size_t refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(HMLFC_VECTORS)) {
    if (entry.path().extension() != ".hmlfc") continue;
    OpenStream stream(entry.path());
    Handler handler({80, "token"}, stream);
    const auto get = [&handler](const std::string& path, const Query& query) {
      return handler.answer({"GET", "/token/" + path, query, "127.0.0.1:80", "", ""});
    };
    const json facts = json::parse(get("stream", {}).body);
    const bool opens = facts["error"] == "";
    ++(opens ? opened : refused);
    const Response frame = get("frame", {{"size", "6x4"}, {"geometry", "plane"}});
    const Query plane{{"view", "0,0"}, {"plane", "Cg"}};
    const Response blocks = get("blocks", plane);
    if (!opens) {
      EXPECT_EQ(frame.status, 422) << entry.path();
      EXPECT_EQ(blocks.status, 422) << entry.path();
      continue;
    }
    const bool thin =
        frame.body.find("give --fov") != std::string::npos;  // no camera fits the view
    EXPECT_TRUE(frame.status == 200 || frame.status == 422 || thin) << entry.path() << frame.body;
    ASSERT_EQ(blocks.status, 200) << entry.path() << blocks.body;
    const Decoder& decoder = stream.for_blocks().decoder();
    const auto decoded = decoder.decode_plane({0, 0}, Plane::kCg);
    const json arrays = json::parse(blocks.body);
    EXPECT_EQ(decoded.has_value(), arrays["errors"].empty()) << entry.path();
    Query sample = plane;
    sample.emplace_back("stage", "sample");
    const Response stage = get("stage", sample);
    ASSERT_EQ(stage.status, 200) << entry.path();
    if (!decoded) continue;
    ASSERT_EQ(stage.body.size(), 2 * decoded->size()) << entry.path();
    EXPECT_EQ(std::memcmp(stage.body.data(), decoded->data(), stage.body.size()), 0)
        << entry.path();
  }
  EXPECT_GT(opened, 500u);
  EXPECT_GT(refused, 50u);
}

}  // namespace
}  // namespace hmlfc::view
