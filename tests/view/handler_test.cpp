// The handler of `hmlfc view`, without sockets: who may ask, and what any query whatever is
// answered.
#include "view/handler.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>

#include <nlohmann/json.hpp>

#include <hmlfc/stream_info.hpp>

#include "handler_fixture.hpp"

namespace hmlfc::view {
namespace {

using nlohmann::json;

TEST(ViewHandler, FramesAreThoseOfTheRenderer) {
  Fixture fixture;
  const Response response = fixture.get("frame", {{"camera", "1.5,0"}, {"size", "20x10"}});
  ASSERT_EQ(response.status, 200) << response.body;
  const StreamHeader& header = fixture.stream.for_blocks().header();
  Camera camera;
  camera.position = WorldPoint{1.5, 0, 0};
  camera.frame_width = 20;
  camera.frame_height = 10;
  camera.geometry = suitable_geometry(header);
  Frame frame;
  const auto renderer = make_golden_renderer(fixture.stream.for_blocks().decoder());
  ASSERT_TRUE(renderer->render(frame_record(camera, header).value(), 0, frame));
  ASSERT_EQ(response.body.size(), 20u * 10 * 4);
  for (size_t pixel = 0; pixel < 200; ++pixel) {
    for (size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(static_cast<uint8_t>(response.body[4 * pixel + k]),
                frame.image.samples[3 * pixel + k] >> (header.depth - 8));
    }
    ASSERT_EQ(static_cast<uint8_t>(response.body[4 * pixel + 3]), 255);
  }
}

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

TEST(ViewHandler, StagesAreThoseOfTheDecoder) {
  Fixture fixture;
  const Decoder& decoder = fixture.stream.for_blocks().decoder();
  for (const char* levels : {"1", "2"}) {
    const Response response = fixture.get(
        "stage", {{"view", "0,4"}, {"plane", "Y"}, {"stage", "sample"}, {"levels", levels}});
    ASSERT_EQ(response.status, 200) << response.body;
    const auto plane = decoder.decode_plane({0, 4}, Plane::kY, levels[0] == '1' ? 1 : 0).value();
    ASSERT_EQ(response.body.size(), 2 * plane.size());
    EXPECT_EQ(std::memcmp(response.body.data(), plane.data(), response.body.size()), 0);
  }
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
  EXPECT_NE(refusal("frame", {{"camera", "9999,0"}}).find("position"), std::string::npos);
  EXPECT_NE(refusal("blocks", {{"view", "9,9"}, {"plane", "Y"}}).find("outside"),
            std::string::npos);
  EXPECT_NE(refusal("difference", {{"view", "0,0"}}).find("--original"), std::string::npos);
  EXPECT_EQ(fixture.get("nosuch").status, 404);
  EXPECT_EQ(fixture.get("../CMakeLists.txt").status, 404);
  EXPECT_EQ(fixture.get("").status, 200);
  EXPECT_EQ(fixture.handler.answer({"POST", "/token/frame", {}, "127.0.0.1:80", "", ""}).status,
            405);
  EXPECT_EQ(fixture.handler.answer({"GET", "/token/opened", {}, "127.0.0.1:80", "", ""}).status,
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

// Queries as a page asks them, with parts damaged: a character changed, added or left out, parts
// twice, missing or of another query, numbers of any size.
Query drawn_query(vectors::Random& random) {
  static const std::vector<std::pair<std::string, std::vector<std::string>>> kParts{
      {"camera", {"1.5,0", "0,0,-3", "4096,1e3", "nan,inf", "1,2,3,4", "-0.5,0,0"}},
      {"look-at", {"0,0,16", "1,0,-1", "1e20,0"}},
      {"size", {"8x6", "0x0", "4096x1", "99999x1"}},
      {"focus", {"1.5", "inf", "-256", "257"}},
      {"focus-at", {"3,2", "4000,1", "-1,0"}},
      {"aperture", {"0", "3", "4", "-1"}},
      {"geometry", {"plane", "stream", ""}},
      {"filter", {"nearest", "bilinear"}},
      {"levels", {"1", "2", "3", "16", "99999999999999999999"}},
      {"view", {"0,0", "0,5", "1,0", "4294967295,0"}},
      {"plane", {"Y", "Co", "Cg", "y"}},
      {"block", {"0,0", "2,3", "9,9", "4294967295,4294967295"}},
      {"stage", {"sample", "residual", "none"}},
      {"gain", {"1", "64", "0"}},
      {"page", {"1", "4294967295", "4294967296"}},
      {"path", {"orbit", "/etc/passwd"}},
      {"fov", {"40", "0.2", "126.5"}}};
  Query query;
  const auto below = [&random](size_t end) { return random.next() % end; };
  for (size_t count = below(7); query.size() < count;) {
    const auto& [name, values] = kParts[below(kParts.size())];
    std::string value = values[below(values.size())];
    if (below(4) == 0 && !value.empty()) {
      value[below(value.size())] = static_cast<char>(below(256));
    }
    if (below(8) == 0)
      value.insert(below(value.size() + 1), below(40), static_cast<char>(below(256)));
    query.emplace_back(below(20) == 0 ? value : name, value);
  }
  return query;
}

const std::vector<std::string> kPaths{"frame", "frame.png", "focus",  "picture", "difference",
                                      "stage", "blocks",    "block",  "stream",  "totals",
                                      "",      "opened",    "closed", "../frame"};

// Asks everything of `bytes`, which may be no stream at all.
void ask_anything(const test::Bytes& bytes, vectors::Random& random, int count) {
  Fixture fixture(bytes);
  for (int i = 0; i < count; ++i) {
    const std::string& path = kPaths[random.next() % kPaths.size()];
    const Query query = drawn_query(random);
    Request request{
        random.next() % 8 == 0 ? "POST" : "GET", "/token/" + path, query, "127.0.0.1:80", "", ""};
    const Response response = fixture.handler.answer(request);
    const std::set<int> known{200, 400, 404, 405, 422};
    RC_ASSERT(known.contains(response.status));
    if (response.status != 200) RC_ASSERT(json::accept(response.body));
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
    const bool thin = frame.body.find("tan_half") != std::string::npos;  // no camera fits the view
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

RC_GTEST_PROP(ViewHandler, AnswersAnyQuery, ()) {
  vectors::Random random(*rc::gen::arbitrary<uint64_t>());
  ask_anything(some_stream(), random, 20);
}

RC_GTEST_PROP(ViewHandler, AnswersForAnyStream, ()) {
  vectors::Random random(*rc::gen::arbitrary<uint64_t>());
  test::Bytes bytes =
      test::drawn_stream(test::row_of_views(static_cast<int>(random.next() % 2)), random.next());
  for (size_t count = random.next() % 6; count > 0; --count) {
    bytes[random.next() % bytes.size()] = static_cast<uint8_t>(random.next());
  }
  if (random.next() % 4 == 0) bytes.resize(random.next() % bytes.size());
  if (random.next() % 2 == 0) test::seal(bytes);
  ask_anything(bytes, random, 10);
}

}  // namespace
}  // namespace hmlfc::view
