// A file behind HTTP: what is fetched together, what is dropped, when it counts as another file.
#include "remote/http_source.hpp"

#include <gtest/gtest.h>
#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace hmlfc::remote {
namespace {

constexpr uint64_t kPageSize = SparseBytes::kPageBytes;

char byte_at(uint64_t place) { return static_cast<char>(place * 7 % 251 + place / kPageSize); }

// Serves a file of `size` bytes, under the headers that the test sets.
class FileServer {
 public:
  explicit FileServer(uint64_t size) : content_(size, '\0') {
    for (uint64_t i = 0; i < size; ++i) content_[i] = byte_at(i);
    server_.Get("/a", [this](const httplib::Request&, httplib::Response& answer) {
      wait_for_the_others();
      if (drips_) return drip(answer);
      answer.set_header(header_.load(), std::string(name_.load()));
      answer.set_content(content_, "application/octet-stream");
    });
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();
  }
  FileServer(const FileServer&) = delete;
  FileServer& operator=(const FileServer&) = delete;
  ~FileServer() {
    server_.stop();
    thread_.join();
  }

  /// The version of the file, and the header that names it.
  void name(const char* header, const char* version) {
    header_ = header;
    name_ = version;
  }

  /// From now on an answer is a byte every 50 ms.
  void drip() { drips_ = true; }

  std::string address() const { return "http://127.0.0.1:" + std::to_string(port_) + "/a"; }

  /// From now on answers wait for a while until as many requests are there.
  void wait_for(int requests) { together_ = requests; }

  /// Requests that were there at once.
  int most() const { return most_; }

  std::unique_ptr<HttpSource> open(const SparseSource::Keeping& keeping = {}) const {
    auto source = HttpSource::open(address(), keeping);
    EXPECT_TRUE(source) << source.error().message;
    return std::move(*source);
  }

 private:
  void drip(httplib::Response& answer) {
    const auto write = [this](size_t offset, size_t, httplib::DataSink& sink) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      return sink.write(&content_[offset], 1);
    };
    answer.set_content_provider(content_.size(), "application/octet-stream", write);
  }

  void wait_for_the_others() {
    most_ = std::max(most_.load(), ++there_);
    for (int tries = 0; most_ < together_ && tries < 5000; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    --there_;
  }

  std::string content_;
  std::atomic<bool> drips_ = false;
  std::atomic<int> together_ = 1;
  std::atomic<int> there_ = 0;
  std::atomic<int> most_ = 0;
  std::atomic<const char*> header_ = "ETag";
  std::atomic<const char*> name_ = "\"1\"";
  httplib::Server server_;
  int port_ = 0;
  std::thread thread_;
};

// What one load() fetches.
FetchCounts fetched(HttpSource& source, const std::vector<ByteRange>& ranges) {
  const FetchCounts before = source.counts();
  EXPECT_TRUE(source.load(ranges)) << source.failure();
  for (const ByteRange& range : ranges) {
    EXPECT_TRUE(source.holds(range));
    for (uint64_t i = range.offset; i < range.offset + range.bytes; ++i) {
      EXPECT_EQ(static_cast<char>(source.bytes()[i]), byte_at(i)) << i;
    }
  }
  const FetchCounts after = source.counts();
  return {after.requests - before.requests, after.bytes - before.bytes,
          after.rounds - before.rounds};
}

void expect_fetched(const FetchCounts& counts, uint64_t requests, uint64_t bytes, uint64_t rounds) {
  EXPECT_EQ(counts.requests, requests);
  EXPECT_EQ(counts.bytes, bytes);
  EXPECT_EQ(counts.rounds, rounds);
}

TEST(HttpSource, RangesAGapApartAreOneRequest) {
  const FileServer server(16 * kPageSize);
  const auto source = server.open({.gap = 1024});
  expect_fetched(source->counts(), 1, kPageSize, 1);
  expect_fetched(fetched(*source, {{2 * kPageSize + 1024 + 64, 5}, {2 * kPageSize, 64}}), 1,
                 1024 + 128, 1);
  expect_fetched(fetched(*source, {{4 * kPageSize, 64}, {4 * kPageSize + 1088 + 64, 64}}), 2, 128,
                 1);
  expect_fetched(fetched(*source, {{2 * kPageSize, 700}, {0, kPageSize}}), 0, 0, 0);
  expect_fetched(fetched(*source, {{16 * kPageSize - 1, 1}}), 1, 64, 1);
}

TEST(HttpSource, ServersMayNotBeSlowWithoutEnd) {
  using std::chrono::seconds;
  FileServer server(16 * kPageSize);
  server.drip();
  const Patience slow{.slow = seconds(1), .base = seconds(600)};
  const Patience late{.slow = seconds(600), .base = seconds(1), .least_speed = 8192};
  for (const Patience& patience : {slow, late}) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_FALSE(RangeClient::open(server.address(), kPageSize, patience));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(100)) << "a page drips 200 s";
  }
}

TEST(HttpSource, LongRangesAreRequestsSideBySide) {
  constexpr uint64_t kMebi = uint64_t{1} << 20;
  FileServer server(9 * kMebi);
  const auto source = server.open();
  server.wait_for(3);
  EXPECT_TRUE(source->load(std::vector<ByteRange>{{0, 9 * kMebi}}));
  expect_fetched(source->counts(), 4, 9 * kMebi, 2);
  EXPECT_EQ(server.most(), 3);
  EXPECT_EQ(static_cast<char>(source->bytes()[9 * kMebi - 1]), byte_at(9 * kMebi - 1));
}

TEST(HttpSource, BytesStayDuringRequestsAndTheCacheIsBoundedAfterThem) {
  const FileServer server(40 * kPageSize);
  const auto source = server.open({.gap = 0, .cache_bytes = 8 * kPageSize});
  source->begin_request();
  fetched(*source, {{0, 20 * kPageSize}});
  source->begin_request();
  source->end_request();
  EXPECT_EQ(source->held_bytes(), 20 * kPageSize) << "a request is under way";
  source->end_request();
  EXPECT_EQ(source->held_bytes(), 8 * kPageSize);
  source->begin_request();
  fetched(*source, {{30 * kPageSize, 6 * kPageSize}});
  source->end_request();
  EXPECT_EQ(source->held_bytes(), 8 * kPageSize);
  expect_fetched(fetched(*source, {{30 * kPageSize, 6 * kPageSize}}), 0, 0, 0);  // used last
  source->begin_request();
  const FetchCounts again = fetched(*source, {{0, 20 * kPageSize}});
  EXPECT_EQ(again.bytes, 18 * kPageSize);  // two of the first pages were left
  source->end_request();
  EXPECT_EQ(source->held_bytes(), 8 * kPageSize);
}

TEST(HttpSource, AFileOfAnotherVersionIsNoneOfThisOne) {
  for (const char* header : {"ETag", "Last-Modified"}) {
    FileServer server(8 * kPageSize);
    server.name(header, "\"1\"");
    const auto source = server.open();
    expect_fetched(fetched(*source, {{2 * kPageSize, 64}}), 1, 64, 1);
    server.name(header, "\"2\"");
    EXPECT_FALSE(source->load(std::vector<ByteRange>{{4 * kPageSize, 64}}));
    EXPECT_NE(source->failure().find("its version was \"1\" and is \"2\""), std::string::npos)
        << source->failure();
    EXPECT_FALSE(source->holds({4 * kPageSize, 64}));
    server.name(header, "\"1\"");
    EXPECT_FALSE(source->load(std::vector<ByteRange>{{6 * kPageSize, 64}}))
        << "once false, it stays so";
    EXPECT_EQ(source->counts().bytes, kPageSize + 64);
  }
}

}  // namespace
}  // namespace hmlfc::remote
