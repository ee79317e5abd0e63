// SPDX-License-Identifier: Apache-2.0
// The filter as the kernel runs it: datagrams over loopback, and which of them arrive.
#include "host/gige/stream_filter.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>

#include "host/gige/stream_guard.hpp"
#include "host/gige/udp_sockets.hpp"
#include "host/support/unique_fd.hpp"
#include "support/datagram.hpp"

namespace pharos::host {
namespace {

using test::Datagram;
using test::put;

constexpr std::size_t kBlock_bytes = 1000;
constexpr std::size_t kPackets = 10;
constexpr std::uint32_t kLoopback = 0x7F000001;

StreamRule some_rule() { return {kLoopback, std::nullopt, kPackets * kBlock_bytes, kBlock_bytes + 36, std::nullopt}; }

struct Packet {
  std::uint16_t status = 0;
  bool extended = false;
  std::uint64_t block = 7;
  std::uint8_t type = 3;
  std::uint32_t number = 1;
  std::size_t data_bytes = kBlock_bytes;
  std::uint16_t payload_type = 1;
};

Datagram bytes_of(const Packet& packet) {
  Datagram bytes;
  put(bytes, packet.status, 2);
  put(bytes, packet.extended ? 0 : packet.block, 2);
  put(bytes, packet.type | (packet.extended ? 0x80 : 0), 1);
  put(bytes, packet.extended ? 0 : packet.number, 3);
  if (packet.extended) {
    put(bytes, packet.block, 8);
    put(bytes, packet.number, 4);
  }
  const std::size_t head = bytes.size();
  bytes.resize(head + packet.data_bytes);
  if (packet.data_bytes >= 4) bytes[head + 3] = static_cast<std::uint8_t>(packet.payload_type);
  return bytes;
}

class UdpEnd {
 public:
  explicit UdpEnd(const char* address = "127.0.0.1") : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    ::inet_pton(AF_INET, address, &own.sin_addr);
    socklen_t size = sizeof own;
    EXPECT_EQ(::bind(fd_.get(), reinterpret_cast<sockaddr*>(&own), size), 0);
    ::getsockname(fd_.get(), reinterpret_cast<sockaddr*>(&own), &size);
    port_ = ntohs(own.sin_port);
  }
  int fd() const { return fd_.get(); }
  std::uint16_t port() const { return port_; }
  void send(const UdpEnd& to, const Datagram& bytes) const {
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_port = htons(to.port());
    there.sin_addr.s_addr = htonl(kLoopback);
    ::sendto(fd_.get(), bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&there), sizeof there);
  }
  bool received() const {
    std::array<char, 2000> buffer{};
    return ::recv(fd_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT) >= 0;
  }

 private:
  UniqueFd fd_;
  std::uint16_t port_ = 0;
};

class StreamFilterTest : public ::testing::Test {
 protected:
  void use(const StreamRule& rule) { ASSERT_TRUE(attach_filter(host.fd(), stream_filter(rule))); }
  bool passes(const Datagram& bytes) {
    camera.send(host, bytes);
    return host.received();
  }
  bool passes(const Packet& packet) { return passes(bytes_of(packet)); }

  UdpEnd host;
  UdpEnd camera;
};

TEST_F(StreamFilterTest, LetsAWholeFramePass) {
  use(some_rule());
  EXPECT_TRUE(passes(Packet{.type = 1, .number = 0, .data_bytes = 36}));
  for (std::uint32_t number = 1; number <= kPackets; ++number) EXPECT_TRUE(passes(Packet{.number = number}));
  EXPECT_TRUE(passes(Packet{.number = kPackets, .data_bytes = 3}));
  EXPECT_TRUE(passes(Packet{.type = 2, .number = kPackets + 1, .data_bytes = 8}));
  EXPECT_TRUE(passes(Packet{.status = 0x0100})) << "sent again";
  EXPECT_TRUE(passes(Packet{.status = 0x800C, .data_bytes = 0})) << "cannot be sent again";
}

TEST_F(StreamFilterTest, DropsTheDatagramThatMakesAravisTake68GB) {
  const Datagram bytes{0xd4, 0xaf, 0x90, 0x98, 0x82, 0x85, 0xcf, 0x7a, 0x9a, 0xf7, 0xc9, 0x3d, 0x55, 0x52,
                       0x26, 0x6a, 0xfe, 0x70, 0xe7, 0xaa, 0xe6, 0xda, 0x47, 0x62, 0x7c, 0x2e, 0x59, 0xaf};
  EXPECT_TRUE(passes(bytes)) << "without a filter";
  use(some_rule());
  EXPECT_FALSE(passes(bytes));
}

TEST_F(StreamFilterTest, DropsWhatAravisWouldCopyOrCountBeyondItsBuffers) {
  use(some_rule());
  for (const bool extended : {false, true}) {
    EXPECT_TRUE(passes(Packet{.extended = extended, .data_bytes = kBlock_bytes - 12}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .number = 0, .data_bytes = 100}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .number = kPackets + 2, .data_bytes = 100}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .number = 0xFFFFFF, .data_bytes = 100}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .data_bytes = 0}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .data_bytes = kBlock_bytes + 1}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .type = 2, .number = kPackets + 3, .data_bytes = 8}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .type = 2, .number = 0, .data_bytes = 8}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .type = 1, .number = 1, .data_bytes = 36}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .type = 1, .number = 0, .data_bytes = 35}));
    EXPECT_FALSE(passes(Packet{.extended = extended, .type = 1, .number = 0, .data_bytes = 36, .payload_type = 10}));
    EXPECT_FALSE(passes(Packet{.status = 0x800C, .extended = extended, .number = 0xFFFFFF, .data_bytes = 0}));
    EXPECT_FALSE(passes(Packet{.status = 0x4321, .extended = extended}));
    for (const std::uint8_t type : std::initializer_list<std::uint8_t>{0, 4, 5, 6, 7, 8, 127}) {
      EXPECT_FALSE(passes(Packet{.extended = extended, .type = type, .data_bytes = 100}));
    }
  }
  EXPECT_FALSE(passes(Packet{.block = 0}));
  for (std::size_t size = 0; size < 8; ++size) EXPECT_FALSE(passes(Datagram(size, 3)));
}

TEST_F(StreamFilterTest, DropsTheOtherKindOfBlockNumberWhereTheCameraSaysWhichItUses) {
  StreamRule rule = some_rule();
  for (const bool used : {false, true}) {
    rule.extended_ids = used;
    use(rule);
    EXPECT_TRUE(passes(Packet{.extended = used, .data_bytes = 100}));
    EXPECT_FALSE(passes(Packet{.extended = !used, .data_bytes = 100}));
  }
}

TEST_F(StreamFilterTest, DropsOtherAddressesAndPorts) {
  StreamRule rule = some_rule();
  rule.source_port = camera.port();
  use(rule);
  EXPECT_TRUE(passes(Packet{}));
  const UdpEnd other_port;
  other_port.send(host, bytes_of({}));
  EXPECT_FALSE(host.received());
  rule.source_port.reset();
  use(rule);
  const UdpEnd other_address("127.0.0.3");
  other_address.send(host, bytes_of({}));
  EXPECT_FALSE(host.received());
  other_port.send(host, bytes_of({}));
  EXPECT_TRUE(host.received());
}

TEST_F(StreamFilterTest, TheGuardLearnsTheCamerasPortAndCountsWhatItKeepsOut) {
  StreamGuard guard(host.port(), some_rule());
  ASSERT_TRUE(guard.is_on());
  for (std::uint32_t i = 1; i <= StreamGuard::kAgreeing; ++i) {
    EXPECT_FALSE(guard.knows_port());
    camera.send(host, bytes_of({.number = i}));
    for (int look = 0; look < 2; ++look) guard.learn(std::chrono::milliseconds(2));
    EXPECT_TRUE(host.received()) << "what was looked at is still there";
  }
  EXPECT_TRUE(guard.knows_port());
  const UdpEnd other;
  for (int i = 0; i < 5; ++i) other.send(host, bytes_of({}));
  EXPECT_FALSE(host.received());
  EXPECT_EQ(guard.discarded(), 5);
  EXPECT_TRUE(passes(Packet{}));
}

TEST_F(StreamFilterTest, TheControlChannelHearsPort3956OfTheCameraAlone) {
  ASSERT_TRUE(attach_filter(host.fd(), control_filter(kLoopback)));
  EXPECT_FALSE(passes(Packet{}));
}

}  // namespace
}  // namespace pharos::host
