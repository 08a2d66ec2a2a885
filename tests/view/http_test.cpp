// Requests as they come over a connection, whole, in parts and too long, and answers as they go.
#include "view/http.hpp"

#include <gtest/gtest.h>

namespace hmlfc::view {
namespace {

const std::string kFirst = "GET /a HTTP/1.1\r\n";

// The status with which the first request of `bytes` is refused; 200 where it is taken, 0 where it
// is not whole.
int status_of(std::string bytes) {
  const auto taken = take_request(bytes);
  if (!taken) return taken.error().status;
  return *taken ? 200 : 0;
}

std::string headers(size_t count) {
  std::string text;
  for (size_t i = 0; i < count; ++i) text += "X: y\r\n";
  return text;
}

TEST(ViewHttp, ReadsWhatABrowserAsks) {
  const std::string sent =
      "GET /token/fr%61me%2F+?camera=1.5%2C0&size=8x6&a+b=%zz&&none&last=%4&end=%4a HTTP/1.1\r\n"
      "HOST: 127.0.0.1:80\r\nOrigin:\thttp://127.0.0.1:80 \r\nAccept: */*\r\n"
      "Sec-Fetch-Site: same-origin\r\nContent-Length: 0\r\n\r\n";
  std::string received;
  for (size_t i = 0; i + 1 < sent.size(); ++i) {
    received += sent[i];
    const auto taken = take_request(received);
    ASSERT_TRUE(taken.has_value() && !*taken) << i;
  }
  received += sent.back() + kFirst + "\r\nPOST";
  auto taken = take_request(received).value();
  ASSERT_TRUE(taken.has_value());
  EXPECT_TRUE(taken->keep);
  const Request& request = taken->request;
  EXPECT_EQ(request.method, "GET");
  EXPECT_EQ(request.path, "/token/frame/+");
  const Query query{{"camera", "1.5,0"}, {"size", "8x6"}, {"a b", "%zz"}, {"", ""},
                    {"none", ""},        {"last", "%4"},  {"end", "J"}};
  EXPECT_EQ(request.query, query);
  EXPECT_EQ(request.host, "127.0.0.1:80");
  EXPECT_EQ(request.origin, "http://127.0.0.1:80");
  EXPECT_EQ(request.site, "same-origin");
  taken = take_request(received).value();  // the next one, sent with the first
  ASSERT_TRUE(taken.has_value());
  EXPECT_EQ(taken->request.path, "/a");
  EXPECT_EQ(taken->request.host, "");
  EXPECT_EQ(received, "POST");
}

TEST(ViewHttp, AConnectionIsKeptAsTheRequestSays) {
  const auto keeps = [](std::string sent) { return take_request(sent).value().value().keep; };
  EXPECT_TRUE(keeps("GET / HTTP/1.1\r\n\r\n"));
  EXPECT_FALSE(keeps("GET / HTTP/1.1\r\nConnection: Close\r\n\r\n"));
  EXPECT_FALSE(keeps("GET / HTTP/1.0\r\n\r\n"));
}

TEST(ViewHttp, RefusesWhatIsNoRequest) {
  for (const std::string& head :
       {std::string("hello"), std::string(" / HTTP/1.1"), std::string("GET /"),
        std::string("GET / HTTP/2.0"), std::string("GET /a b HTTP/1.1"),
        std::string("G(T / HTTP/1.1"), std::string("GET /\n HTTP/1.1"),
        "GET /" + std::string(1, '\0') + " HTTP/1.1", kFirst + "no header", kFirst + ": a",
        kFirst + "A : b", kFirst + "A: b\r\n folded: c", kFirst + "A: b\nHost: c",
        kFirst + "Host: a\r\nhost: b", kFirst + "Origin: a\r\nOrigin: a"}) {
    EXPECT_EQ(status_of(head + "\r\n\r\n"), 400) << head;
  }
}

TEST(ViewHttp, RefusesBodies) {
  for (const char* header :
       {"Content-Length: 1", "Content-Length: 99999999999999999999", "Content-Length: -1",
        "Transfer-Encoding: chunked", "Content-Length: 0\r\nTransfer-Encoding: chunked"}) {
    EXPECT_EQ(status_of(kFirst + header + "\r\n\r\n"), 413) << header;
  }
}

// The longest request is taken; one byte more is refused before the rest is there.
TEST(ViewHttp, RefusesWhatIsTooLongBeforeItIsWhole) {
  const auto line = [](size_t size) { return "GET /" + std::string(size - 14, 'a') + " HTTP/1.1"; };
  EXPECT_EQ(status_of(line(kMaxRequestLine) + "\r\n\r\n"), 200);
  EXPECT_EQ(status_of(line(kMaxRequestLine + 1) + "\r\n\r\n"), 414);
  EXPECT_EQ(status_of(std::string(kMaxRequestLine, 'a')), 0);
  EXPECT_EQ(status_of(std::string(kMaxRequestLine + 1, 'a')), 414);
  const std::string most = kFirst + "X: " + std::string(kMaxHead - kFirst.size() - 3, 'a');
  EXPECT_EQ(status_of(most), 0);
  EXPECT_EQ(status_of(most + "\r\n\r\n"), 200);
  EXPECT_EQ(status_of(most + "a"), 431);
  EXPECT_EQ(status_of(most + "a\r\n\r\n"), 431);
  EXPECT_EQ(status_of(kFirst + headers(kMaxHeaders) + "\r\n"), 200);
  EXPECT_EQ(status_of(kFirst + headers(kMaxHeaders + 1) + "\r\n"), 431);
  EXPECT_EQ(status_of(kFirst + headers(kMaxHead)), 431);
}

TEST(ViewHttp, AnswersAreWholeButForHead) {
  Response response;
  response.type = "text/plain";
  response.body = "abc";
  response.headers.emplace_back("Name", "value");
  const std::string head =
      "HTTP/1.1 200 OK\r\nContent-Type: text/plain\r\nConnection: keep-alive\r\n"
      "Content-Length: 3\r\nName: value\r\n\r\n";
  EXPECT_EQ(response_bytes(response, false, true), head + "abc");
  EXPECT_EQ(response_bytes(response, true, true), head);
  EXPECT_NE(response_bytes(response, false, false).find("Connection: close\r\n"), head.npos);
  response.open = std::make_shared<int>();
  EXPECT_EQ(response_bytes(response, false, true).find("Length"), head.npos);
}

}  // namespace
}  // namespace hmlfc::view
