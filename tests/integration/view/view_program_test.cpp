// SPDX-License-Identifier: Apache-2.0
// `pharos view` as a program: from LCM to the page's states, a log, wrong usage, its end.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <csignal>
#include <lcm/lcm-cpp.hpp>
#include <regex>

#include "host/support/unique_fd.hpp"
#include "integration/child_process.hpp"
#include "pharos/pose_t.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using Clock = std::chrono::steady_clock;

pose_t some_pose() {
  pose_t pose{};
  pose.source = "lighthouse/chaser";
  pose.target = "dock";
  pose.parent_frame = "lighthouse";
  pose.child_frame = "body";
  pose.status = "ok";
  pose.valid = 1;
  pose.position_m[2] = 2.125;
  pose.orientation_wxyz[0] = 1.0;
  return pose;
}

// The port in the address that the program printed.
std::uint16_t port_of(ChildProcess& view) {
  if (!view.wait_for("/\n")) return 0;
  std::smatch match;
  const std::string text = view.text();
  return std::regex_search(text, match, std::regex(R"(http://127\.0\.0\.1:(\d+)/)"))
             ? static_cast<std::uint16_t>(std::stoi(match[1]))
             : std::uint16_t{0};
}

UniqueFd ask(std::uint16_t port, const std::string& line, const std::string& headers = "") {
  UniqueFd client(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(client.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const std::string text = line + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n" + headers + "\r\n";
  EXPECT_EQ(::send(client.get(), text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  return client;
}

// Reads until `words` have come; `meanwhile` is done every 20 ms. What came.
template <class Meanwhile>
std::string read_until(const UniqueFd& client, const std::string& words, const Meanwhile& meanwhile) {
  std::string text;
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (text.find(words) == std::string::npos && Clock::now() < end) {
    meanwhile();
    pollfd ready{client.get(), POLLIN, 0};
    if (::poll(&ready, 1, 20) <= 0) continue;
    char buffer[65536];
    const ssize_t count = ::recv(client.get(), buffer, sizeof buffer, 0);
    if (count <= 0) break;
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return text;
}

std::string some_url() { return "udpm://239.255.76.67:" + std::to_string(20000 + ::getpid() % 10000) + "?ttl=0"; }

TEST(View, APoseOnLcmIsInThePagesStates) {
  const std::string url = some_url();
  ChildProcess view({PHAROS, "view", "--port", "0", "--url", url});
  const std::uint16_t port = port_of(view);
  ASSERT_NE(port, 0) << view.text();
  lcm::LCM lcm(url);
  ASSERT_TRUE(lcm.good());
  const pose_t pose = some_pose();
  const std::string garbage = "garbage";
  const UniqueFd viewer = ask(port, "GET /states");
  const std::string states = read_until(viewer, "\"p\":[0.0,0.0,2.125]", [&] {
    lcm.publish("PHAROS_LIGHTHOUSE_POSE", &pose);
    lcm.publish("PHAROS_LIGHTHOUSE_POSE", garbage.data(), static_cast<unsigned>(garbage.size()));
  });
  EXPECT_THAT(states, AllOf(HasSubstr("\"p\":[0.0,0.0,2.125]"), HasSubstr("\"source\":\"lighthouse/chaser\"")));
  EXPECT_THAT(read_until(viewer, "\"foreign\":", [] {}), HasSubstr("\"foreign\":")) << "skipped and counted";
  view.signal(SIGTERM);
  EXPECT_EQ(view.wait_exit(), 0) << view.text();
}

TEST(View, ServesThePageAndRefusesOtherPathsAndOrigins) {
  ChildProcess view({PHAROS, "view", "--port", "0", "--url", some_url()});
  const std::uint16_t port = port_of(view);
  ASSERT_NE(port, 0) << view.text();
  const auto answer = [port](const std::string& line, const std::string& headers = "") {
    return read_until(ask(port, line, headers + "Connection: close\r\n"), "nothing waits for this", [] {});
  };
  EXPECT_THAT(answer("GET /"), AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("<title>Pharos</title>")));
  EXPECT_THAT(answer("GET /../../../etc/passwd"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(answer("GET /states", "Origin: http://evil.example\r\n"), StartsWith("HTTP/1.1 403"));
  view.signal(SIGINT);
  EXPECT_EQ(view.wait_exit(), 1) << "no message came";
}

TEST(View, ReplaysALogAndJumpsToAnyPlace) {
  const test::TemporaryFolder folder;
  const std::string log = folder.path("poses.lcm");
  {
    lcm::LCM writer("file://" + log + "?mode=w");
    pose_t pose = some_pose();
    for (int k = 0; k < 20; ++k) writer.publish("PHAROS_LIGHTHOUSE_POSE", &pose);
  }
  ChildProcess view({PHAROS, "view", "--port", "0", "--log", log});
  const std::uint16_t port = port_of(view);
  ASSERT_NE(port, 0) << view.text();
  const UniqueFd viewer = ask(port, "GET /states");
  EXPECT_THAT(read_until(viewer, "\"replay\":", [] {}), HasSubstr("\"duration_s\":"));
  const UniqueFd control = ask(port, "POST /control?seek=0&playing=0", "Content-Length: 0\r\n");
  EXPECT_THAT(read_until(control, "\r\n\r\n", [] {}), StartsWith("HTTP/1.1 204"));
  EXPECT_THAT(read_until(viewer, "\"playing\":false", [] {}), HasSubstr("\"playing\":false"));
}

TEST(View, ElsewhereItWarnsAndAsksForATokenThatItPrints) {
  ChildProcess view({PHAROS, "view", "--port", "0", "--listen", "0.0.0.0", "--url", some_url()});
  ASSERT_TRUE(view.wait_for("warning: everyone on the network")) << view.text();
  EXPECT_TRUE(view.wait_for("/?token=")) << view.text();
}

TEST(View, WrongUsageIsRefusedWithWhatToDo) {
  const auto refusal = [](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {PHAROS, "view", "--port", "0"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ChildProcess view(arguments);
    EXPECT_EQ(view.wait_exit(), 2);
    return view.text();
  };
  EXPECT_THAT(refusal({"--log", "/nonexistent/log"}), HasSubstr("pharos view: /nonexistent/log"));
  EXPECT_THAT(refusal({"--listen", "somewhere", "--url", some_url()}), HasSubstr("give a numeric address"));
  EXPECT_THAT(refusal({"--target", "dock", "--url", some_url()}), HasSubstr("give NAME=FILE"));
  EXPECT_THAT(refusal({"--token-file", "/dev/null", "--url", some_url()}), HasSubstr("16 to 128"));
}

}  // namespace
}  // namespace pharos::host
