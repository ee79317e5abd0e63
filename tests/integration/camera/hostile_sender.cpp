// SPDX-License-Identifier: Apache-2.0
#include "integration/camera/hostile_sender.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "host/gige/udp_sockets.hpp"
#include "support/datagram.hpp"

namespace pharos::host {
namespace {

using test::Datagram;
using test::put;

constexpr std::uint16_t kControlPort = 3956;
constexpr std::array<std::uint8_t, 28> kTakes68GB{0xd4, 0xaf, 0x90, 0x98, 0x82, 0x85, 0xcf, 0x7a, 0x9a, 0xf7,
                                                  0xc9, 0x3d, 0x55, 0x52, 0x26, 0x6a, 0xfe, 0x70, 0xe7, 0xaa,
                                                  0xe6, 0xda, 0x47, 0x62, 0x7c, 0x2e, 0x59, 0xaf};

sockaddr_in address_of(const char* text, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  ::inet_pton(AF_INET, text, &address.sin_addr);
  return address;
}

}  // namespace

UniqueFd bound_socket(const char* address) {
  UniqueFd fd(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const sockaddr_in own = address_of(address, 0);
  if (::bind(fd.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) fd.reset();
  return fd;
}

int socket_of_simulated_camera() {
  for (const UdpSocket& socket : udp_sockets()) {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    ::getsockname(socket.fd, reinterpret_cast<sockaddr*>(&own), &size);
    if (ntohl(own.sin_addr.s_addr) == INADDR_LOOPBACK && socket.port != kControlPort) return socket.fd;
  }
  return -1;
}

std::vector<std::uint16_t> ports_of_others() {
  std::vector<std::uint16_t> ports;
  const std::vector<UdpSocket> own = udp_sockets();
  std::ifstream table("/proc/self/net/udp");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string number;
    std::string local;
    fields >> number >> local;
    if (local.rfind("0100007F:", 0) != 0) continue;
    const auto port = static_cast<std::uint16_t>(std::stoul(local.substr(9), nullptr, 16));
    const bool is_own = std::any_of(own.begin(), own.end(), [&](const UdpSocket& one) { return one.port == port; });
    if (!is_own) ports.push_back(port);
  }
  return ports;
}

HostileSender::HostileSender(std::uint64_t seed)
    : random_(seed),
      other_address_(bound_socket("127.0.0.3")),
      other_port_(bound_socket("127.0.0.1")),
      cameras_(socket_of_simulated_camera()) {}

/// A valid packet with random changes.
Datagram HostileSender::make_packet() {
  constexpr std::array<std::uint64_t, 6> kNumbers{0, 1, 270, 2000, 0xFFFFFF, 0xFFFFFFFF};
  const bool extended = number(2) == 0;
  const std::uint64_t packet = number(2) == 0 ? number(300) : kNumbers[number(kNumbers.size())];
  const std::uint64_t block = number(2) == 0 ? number(0x10000) : random_();
  Datagram bytes;
  put(bytes, number(4) == 0 ? number(0x10000) : 0, 2);
  put(bytes, block, 2);
  put(bytes, number(9) | (extended ? 0x80 : 0), 1);
  put(bytes, packet, 3);
  if (extended) {
    put(bytes, block, 8);
    put(bytes, packet, 4);
  }
  const std::size_t head = bytes.size();
  bytes.resize(head + number(3) * number(1500));
  for (std::size_t i = head; i < std::min(bytes.size(), head + 40); ++i)
    bytes[i] = static_cast<std::uint8_t>(random_());
  return bytes;
}

Datagram HostileSender::make() {
  const std::uint64_t kind = number(8);
  if (kind == 0) return {kTakes68GB.begin(), kTakes68GB.end()};
  if (kind > 2) return make_packet();
  Datagram bytes(number(kind == 1 ? 64 : 9000));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
  return bytes;
}

void HostileSender::send(Attacker attacker, std::uint16_t port, int count) {
  const int socket = attacker == Attacker::kOtherAddress ? other_address_.get()
                     : attacker == Attacker::kOtherPort  ? other_port_.get()
                                                         : cameras_;
  const sockaddr_in there = address_of("127.0.0.1", port);
  for (int i = 0; i < count; ++i) {
    const Datagram bytes = make();
    const ssize_t size =
        ::sendto(socket, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&there), sizeof there);
    sent_ += size >= 0 ? 1 : 0;
  }
}

}  // namespace pharos::host
