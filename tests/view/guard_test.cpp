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

TEST(ViewPages, EndsAfterTheLastPage) {
  Pages pages;
  const Pages::Time begin{};
  const auto at = [begin](int seconds) { return begin + std::chrono::seconds(seconds); };
  EXPECT_FALSE(pages.all_closed(at(1000))) << "before the first page";
  pages.opened(1, at(1000));
  pages.opened(2, at(1001));
  pages.closed(1, at(1002));
  EXPECT_FALSE(pages.all_closed(at(1010))) << "one of two is open";
  pages.closed(2, at(1010));
  EXPECT_FALSE(pages.all_closed(at(1011))) << "it may be loaded again";
  pages.opened(3, at(1011));
  EXPECT_FALSE(pages.all_closed(at(1100)));
  pages.opened(2, at(1101));  // of a page that has closed, late
  EXPECT_FALSE(pages.all_closed(at(1011 + 91))) << "it has just been given up";
  EXPECT_TRUE(pages.all_closed(at(1011 + 94)));
}

TEST(ViewPages, WaitsForThePageThatWasSent) {
  Pages pages;
  const Pages::Time begin{};
  const auto at = [begin](int seconds) { return begin + std::chrono::seconds(seconds); };
  pages.sent(at(0));
  pages.opened(1, at(1));
  pages.sent(at(10));  // the page is loaded again
  pages.closed(1, at(11));
  EXPECT_FALSE(pages.all_closed(at(30))) << "a busy machine takes long to show a page";
  pages.opened(2, at(31));
  pages.closed(2, at(32));
  EXPECT_TRUE(pages.all_closed(at(35)));
  pages.sent(at(36));  // and never opens
  EXPECT_FALSE(pages.all_closed(at(36 + 90)));
  EXPECT_TRUE(pages.all_closed(at(36 + 91)));
}

}  // namespace
}  // namespace hmlfc::view
