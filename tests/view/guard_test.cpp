// Who may ask `hmlfc view`, and when its last page has closed.
#include "view/guard.hpp"

#include <gtest/gtest.h>

#include <set>

#include "view/pages.hpp"

namespace hmlfc::view {
namespace {

TEST(ViewGuard, AnswersThePageAlone) {
  const Site site{8080, "secret"};
  const auto asked = [&site](const Request& request) {
    return asked_for(request, site).has_value();
  };
  const Request good{"GET", "/secret/frame", {}, "127.0.0.1:8080", "", ""};
  EXPECT_EQ(asked_for(good, site), "frame");
  Request request = good;
  for (const char* path : {"", "/", "/secret", "/secret2/frame", "/secre/frame", "secret/frame",
                           "//secret/frame", "/SECRET/frame"}) {
    request.path = path;
    EXPECT_FALSE(asked(request)) << path;
  }
  request = good;
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8080",
                           "127.0.0.1:8080.evil.example", "[::1]:8080"}) {
    request.host = host;
    EXPECT_FALSE(asked(request)) << host;
  }
  request.host = "127.0.0.1";
  EXPECT_TRUE(asked_for(request, Site{80, "secret"})) << "browsers leave out :80";
  request = good;
  request.origin = "http://127.0.0.1:8080";
  EXPECT_TRUE(asked(request));
  for (const char* origin : {"null", "https://127.0.0.1:8080", "http://localhost:8080"}) {
    request.origin = origin;
    EXPECT_FALSE(asked(request)) << origin;
  }
  request = good;
  request.site = "same-origin";
  EXPECT_TRUE(asked(request));
  request.site = "cross-site";
  EXPECT_FALSE(asked(request));
  request = good;
  request.host = "localhost:8080";
  EXPECT_TRUE(asked(request));
}

TEST(ViewGuard, TokensDiffer) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(random_token());
  EXPECT_EQ(tokens.size(), 100u);
  EXPECT_EQ(tokens.begin()->size(), 32u);
}

// Times from now on, since what ends takes its own.
Pages::Time at(int seconds) {
  static const Pages::Time begin = Pages::Clock::now();
  return begin + std::chrono::seconds(seconds);
}

TEST(ViewPages, EndsAfterTheLastPage) {
  Pages pages;
  EXPECT_FALSE(pages.all_closed(at(1000))) << "before the first page";
  auto first = pages.opened();
  auto second = pages.opened();
  first.reset();
  EXPECT_FALSE(pages.all_closed(at(1000))) << "one of two is open";
  second.reset();
  EXPECT_FALSE(pages.all_closed(at(1))) << "it may be loaded again";
  EXPECT_TRUE(pages.all_closed(at(10)));
  pages.arrived(at(11));
  EXPECT_FALSE(pages.all_closed(at(12))) << "it is about to open";
  EXPECT_TRUE(pages.all_closed(at(13)));
}

TEST(ViewPages, WaitsForThePageThatWasSent) {
  Pages pages;
  pages.sent(at(0));
  pages.arrived(at(1));
  pages.sent(at(10));  // the page is loaded again
  EXPECT_FALSE(pages.all_closed(at(30))) << "a busy machine takes long to show a page";
  pages.arrived(at(31));
  EXPECT_TRUE(pages.all_closed(at(35)));
  pages.sent(at(36));  // and never arrives
  EXPECT_FALSE(pages.all_closed(at(36 + 90)));
  EXPECT_TRUE(pages.all_closed(at(36 + 91)));
}

}  // namespace
}  // namespace hmlfc::view
