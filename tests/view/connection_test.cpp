// A connection of `hmlfc view` over a socket, at times that the test says.
#include "view/connection.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace hmlfc::view {
namespace {

// A connection and its other side, which never waits either.
struct Both {
  Both() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()), 0);
    connection.emplace(io::FileDescriptor(ends[0]), begin);
    other = io::FileDescriptor(ends[1]);
  }

  void send(std::string_view text) const {
    EXPECT_EQ(::send(other.get(), text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }

  // All that has come; what a closed connection gives is empty.
  std::string receive() const {
    std::string text;
    std::array<char, 4096> buffer;
    for (ssize_t count = 0; (count = ::recv(other.get(), buffer.data(), buffer.size(), 0)) > 0;) {
      text.append(buffer.data(), static_cast<size_t>(count));
    }
    return text;
  }

  const Connection::Time begin = Connection::Clock::now();
  std::optional<Connection> connection;
  io::FileDescriptor other;
};

TEST(ViewConnection, SingleBytesDoNotMoveTheDeadlineOfARequest) {
  Both both;
  Connection& connection = *both.connection;
  for (int i = 0; i < 8; ++i) {
    both.send("G");
    EXPECT_FALSE(connection.work(both.begin + std::chrono::seconds(i)));
    EXPECT_EQ(connection.deadline(), both.begin + Connection::kRequestTime);
  }
}

TEST(ViewConnection, AnAnswerBeginsANewRequest) {
  Both both;
  Connection& connection = *both.connection;
  both.send("GET /a HTTP/1.1\r\n\r\nGET /b HTTP/1.1\r\n\r\n");
  const auto first = connection.work(both.begin);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->request.path, "/a");
  EXPECT_EQ(connection.phase(), Connection::Phase::kAnswering);
  EXPECT_EQ(connection.entry().fd, -1);  // nothing is read until it is answered
  connection.answer("one", both.begin + std::chrono::seconds(100));
  EXPECT_EQ(connection.entry().events, POLLOUT);
  const auto second = connection.work(both.begin + std::chrono::seconds(101));
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->request.path, "/b");
  EXPECT_EQ(both.receive(), "one");
  connection.answer("two", both.begin + std::chrono::seconds(102));
  EXPECT_FALSE(connection.work(both.begin + std::chrono::seconds(103)));
  EXPECT_EQ(connection.deadline(),
            both.begin + std::chrono::seconds(103) + Connection::kRequestTime);
}

TEST(ViewConnection, AReaderThatTakesLittleDoesNotMoveTheDeadlineOfAnAnswer) {
  Both both;
  Connection& connection = *both.connection;
  both.send("GET /a HTTP/1.1\r\n\r\n");
  ASSERT_TRUE(connection.work(both.begin));
  connection.answer(std::string(size_t{64} << 20, 'a'), both.begin);
  for (int i = 0; i < 8; ++i) {
    EXPECT_FALSE(connection.work(both.begin + std::chrono::seconds(i)));
    EXPECT_FALSE(both.receive().empty());
    EXPECT_EQ(connection.phase(), Connection::Phase::kWriting);
    EXPECT_EQ(connection.deadline(), both.begin + Connection::kAnswerTime);
  }
}

TEST(ViewConnection, SaysWhyItRefusesAndCloses) {
  Both both;
  Connection& connection = *both.connection;
  both.send("hello\r\n\r\n");
  EXPECT_FALSE(connection.work(both.begin));
  both.send("GET /a HTTP/1.1\r\n\r\n");
  EXPECT_FALSE(connection.work(both.begin));
  EXPECT_TRUE(both.receive().starts_with("HTTP/1.1 400 "));
  EXPECT_EQ(connection.phase(), Connection::Phase::kClosing);
  EXPECT_FALSE(connection.work(both.begin + std::chrono::seconds(1)));  // what was sent behind it
  EXPECT_EQ(connection.deadline(), both.begin + Connection::kCloseTime);
  both.other = {};
  EXPECT_FALSE(connection.work(both.begin));
  EXPECT_EQ(connection.phase(), Connection::Phase::kEnded);
}

TEST(ViewConnection, DoesNotReadForEverWhatItRefuses) {
  Both both;
  Connection& connection = *both.connection;
  both.send("hello\r\n\r\n");
  EXPECT_FALSE(connection.work(both.begin));
  int rounds = 0;
  for (; connection.phase() != Connection::Phase::kEnded && rounds < 1000; ++rounds) {
    both.send(std::string(16384, 'a'));
    EXPECT_FALSE(connection.work(both.begin));
  }
  EXPECT_LT(rounds, 1000);
}

TEST(ViewConnection, AnAnswerWithoutAnEndLivesUntilTheOtherSideCloses) {
  Both both;
  both.send("GET /a HTTP/1.1\r\n\r\n");
  ASSERT_TRUE(both.connection->work(both.begin));
  both.connection->answer("head", both.begin, std::make_shared<int>());
  EXPECT_FALSE(both.connection->work(both.begin));
  EXPECT_EQ(both.connection->deadline(), both.begin + Connection::kOpenTime);
  both.other = {};
  EXPECT_FALSE(both.connection->work(both.begin));
  EXPECT_EQ(both.connection->phase(), Connection::Phase::kEnded);
}

}  // namespace
}  // namespace hmlfc::view
