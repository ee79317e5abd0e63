// SPDX-License-Identifier: Apache-2.0
#include "tools/view/http_server.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <random>
#include <vector>

#include "host/runtime/event_loop.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A server and its loop, turned by the test itself.
class Server : public ::testing::Test {
 protected:
  Server() { start({}); }

  void start(const HttpServer::Settings& settings) {
    server_.reset();
    loop_ = std::make_unique<host::EventLoop>();
    server_ = std::make_unique<HttpServer>(
        settings, [this](const ControlRequest& request) { control_ = request; },
        [this](std::size_t number) { return number == 3 ? picture_ : nullptr; });
    loop_->watch(server_->listen_fd(), [this] { server_->accept(); });
    loop_->watch(server_->work_fd(), [this] { server_->work(); });
  }

  host::UniqueFd connect() {
    host::UniqueFd client(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(server_->port());
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::connect(client.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
    turn();
    return client;
  }
  void send(const host::UniqueFd& client, const std::string& text) {
    ::send(client.get(), text.data(), text.size(), MSG_NOSIGNAL);
    turn();
  }
  // Lets the server work until nothing is left to do.
  void turn() {
    for (int i = 0; i < 20; ++i) loop_->turn(i == 0 ? 1 : 0);
  }
  // What arrived; `ended` tells whether the server has ended the connection.
  std::string receive(const host::UniqueFd& client, bool* ended = nullptr) {
    std::string text;
    for (int quiet = 0; quiet < 3;) {
      char buffer[65536];
      const ssize_t count = ::recv(client.get(), buffer, sizeof buffer, MSG_DONTWAIT);
      if (count > 0) {
        text.append(buffer, static_cast<std::size_t>(count));
        quiet = 0;
      } else if (count == 0 || errno != EAGAIN) {
        if (ended != nullptr) *ended = true;
        return text;
      } else {
        ++quiet;
      }
      turn();
    }
    return text;
  }
  std::string host() const { return "127.0.0.1:" + std::to_string(server_->port()); }
  std::string get(const std::string& path, const std::string& headers = "") {
    const host::UniqueFd client = connect();
    send(client, request(path, headers));
    return receive(client);
  }
  std::string request(const std::string& path, const std::string& headers = "",
                      const std::string& method = "GET") const {
    return method + ' ' + path + " HTTP/1.1\r\nHost: " + host() + "\r\n" + headers + "\r\n";
  }
  host::UniqueFd viewer() {
    host::UniqueFd client = connect();
    send(client, request("/states"));
    return client;
  }

  std::unique_ptr<host::EventLoop> loop_;
  std::unique_ptr<HttpServer> server_;
  std::optional<ControlRequest> control_;
  HttpServer::Picture picture_ = std::make_shared<const std::vector<std::uint8_t>>(
      std::initializer_list<std::uint8_t>{0xFF, 0xD8, 'j', 0xFF, 0xD9});
};

TEST_F(Server, APictureIsAnsweredAndAMissingOneIsNot) {
  EXPECT_THAT(get("/preview/3?v=17"), AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("Content-Type: image/jpeg"),
                                            HasSubstr("nosniff"), HasSubstr("\xFF\xD8j\xFF\xD9")));
  EXPECT_THAT(get("/preview/4"), StartsWith("HTTP/1.1 404"));
  EXPECT_EQ(server_->refused(), 1);
}

TEST_F(Server, ServesThePageWithHeadersThatKeepItToItself) {
  EXPECT_THAT(get("/"),
              AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("<title>Pharos</title>"),
                    HasSubstr("Content-Security-Policy: default-src 'none'"), HasSubstr("frame-ancestors 'none'"),
                    HasSubstr("Referrer-Policy: no-referrer"), Not(HasSubstr("Access-Control-Allow-Origin"))));
  EXPECT_THAT(get("/three.min.js"), HasSubstr("WebGLRenderer"));
}

TEST_F(Server, AViewerReceivesEachStateAsOneEvent) {
  const host::UniqueFd client = viewer();
  EXPECT_EQ(server_->viewers(), 1);
  server_->publish(R"({"a":1})");
  EXPECT_THAT(receive(client), AllOf(HasSubstr("text/event-stream"), HasSubstr("data: {\"a\":1}\n\n")));
  server_->publish(R"({"a":2})");
  EXPECT_THAT(receive(client), HasSubstr("data: {\"a\":2}\n\n"));
}

TEST_F(Server, AViewerThatComesLateReceivesTheNewestStateAtOnce) {
  server_->publish("old");
  server_->publish("new");
  const host::UniqueFd client = viewer();
  EXPECT_THAT(receive(client), AllOf(HasSubstr("data: new\n\n"), Not(HasSubstr("old"))));
}

// It takes nothing while a thousand states of 10 kB come, more than all buffers hold; then it catches up with few.
TEST_F(Server, ASlowViewerMissesStatesButNotTheNewest) {
  const host::UniqueFd client = viewer();
  for (int k = 0; k < 1000; ++k) {
    server_->publish("<" + std::to_string(k) + ">" + std::string(10'000, 'x'));
    turn();
  }
  const std::string text = receive(client);
  EXPECT_THAT(text, HasSubstr("data: <999>"));
  EXPECT_LT(text.size(), 8'000'000u);
}

TEST_F(Server, AViewerThatGoesIsForgotten) {
  {
    const host::UniqueFd client = viewer();
    EXPECT_EQ(server_->viewers(), 1);
  }
  for (int k = 0; k < 3; ++k) {
    server_->publish("state");
    turn();
  }
  EXPECT_EQ(server_->viewers(), 0);
}

TEST_F(Server, TheSixtyFifthConnectionIsRefusedWith503AndTheOthersGoOn) {
  std::vector<host::UniqueFd> viewers;
  for (std::size_t k = 0; k < Connections::kMaxServed; ++k) viewers.push_back(viewer());
  EXPECT_EQ(server_->viewers(), 64);
  for (int k = 0; k < 20; ++k) {
    const host::UniqueFd late = connect();
    bool ended = false;
    EXPECT_THAT(receive(late, &ended), StartsWith("HTTP/1.1 503"));
    EXPECT_TRUE(ended);
  }
  server_->publish("state");
  for (const host::UniqueFd& client : viewers) EXPECT_THAT(receive(client), HasSubstr("data: state"));
  viewers.pop_back();
  server_->publish("state");
  turn();
  server_->publish("state");
  turn();
  EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 200")) << "a place is free again";
}

TEST_F(Server, RefusesWhatItsRoutesRefuse) {
  EXPECT_THAT(get("/../../etc/passwd"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(get("/%2e%2e/%2e%2e/etc/passwd"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(get("/states", "Origin: http://evil.example\r\n"), StartsWith("HTTP/1.1 403"));
  const host::UniqueFd client = connect();
  send(client, "GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
  EXPECT_THAT(receive(client), StartsWith("HTTP/1.1 421"));
  EXPECT_GE(server_->refused(), 4);
}

TEST_F(Server, ATokenIsAskedForAndBecomesACookie) {
  HttpServer::Settings settings;
  settings.token = "0123456789abcdef";
  start(settings);
  EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(get("/?token=0123456789abcdee"), StartsWith("HTTP/1.1 401"));
  const std::string cookie = "pharos_view_" + std::to_string(server_->port()) + "=0123456789abcdef";
  EXPECT_THAT(get("/?token=0123456789abcdef"),
              AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("Set-Cookie: " + cookie), HasSubstr("HttpOnly")));
  EXPECT_THAT(get("/view.js", "Cookie: " + cookie + "\r\n"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(get("/view.js", "Cookie: other=0123456789abcdef\r\n"), StartsWith("HTTP/1.1 401"));
}

TEST_F(Server, AReplayIsControlled) {
  HttpServer::Settings settings;
  settings.has_controls = true;
  start(settings);
  host::UniqueFd client = connect();
  send(client, request("/control?seek=12.5&playing=0", "Content-Length: 0\r\n", "POST"));
  EXPECT_THAT(receive(client), StartsWith("HTTP/1.1 204"));
  ASSERT_TRUE(control_);
  EXPECT_EQ(control_->seek_s, 12.5);
  EXPECT_EQ(control_->playing, false);
  client = connect();
  send(client, request("/control?seek=nan", "Content-Length: 0\r\n", "POST"));
  EXPECT_THAT(receive(client), StartsWith("HTTP/1.1 400"));
}

TEST_F(Server, HostileBytesEndTheirConnectionAlone) {
  const host::UniqueFd client = viewer();
  std::mt19937 random(5);
  const std::string good = request("/view.css", "X: y\r\n");
  for (int trial = 0; trial < 60; ++trial) {
    const host::UniqueFd hostile = connect();
    std::string bytes = trial % 3 == 0 ? std::string(random() % 4000, static_cast<char>(random())) : good;
    for (int k = 0; k < trial % 7; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (trial % 5 == 0) bytes.resize(random() % bytes.size());
    send(hostile, bytes);
    receive(hostile);
  }
  const host::UniqueFd endless = connect();
  send(endless, "GET / HTTP/1.1\r\n");
  for (int k = 0; k < 100; ++k) send(endless, "X-" + std::to_string(k) + ": " + std::string(2000, 'x') + "\r\n");
  server_->publish("state");
  EXPECT_THAT(receive(client), HasSubstr("data: state"));
  EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 200"));
}

// Time is that of the test: six seconds later.
TEST(ConnectionTimes, AHalfRequestEndsAndAStreamThatMovesDoesNot) {
  Connections connections("127.0.0.1", 0);
  int pair[2];
  int other[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, other), 0);
  const host::UniqueFd half(pair[0]), half_client(pair[1]), stream(other[0]), stream_client(other[1]);
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  connections.opened(half.get(), kSecond_ns);
  connections.opened(stream.get(), kSecond_ns);
  connections.set_phase(stream.get(), ConnectionPhase::kStreaming, kSecond_ns);
  connections.moved(stream.get(), 5 * kSecond_ns);
  connections.shut_late(7 * kSecond_ns);
  char byte = 0;
  EXPECT_EQ(::recv(half_client.get(), &byte, 1, MSG_DONTWAIT), 0) << "its end";
  EXPECT_EQ(::recv(stream_client.get(), &byte, 1, MSG_DONTWAIT), -1) << "still open";
  connections.shut_late(11 * kSecond_ns);
  EXPECT_EQ(::recv(stream_client.get(), &byte, 1, MSG_DONTWAIT), 0) << "it stopped moving";
}

TEST(ConnectionTimes, AnAddressThatIsNoneIsRefusedWithWhatToDo) {
  EXPECT_THROW(Connections("not.an.address", 0), std::exception);
  EXPECT_THROW(Connections("203.0.113.77", 0), std::exception) << "not of this computer";
  EXPECT_TRUE(Connections("127.0.0.1", 0).is_loopback());
  EXPECT_FALSE(Connections("0.0.0.0", 0).is_loopback());
}

}  // namespace
}  // namespace pharos::tools
