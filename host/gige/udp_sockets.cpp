// SPDX-License-Identifier: Apache-2.0
#include "host/gige/udp_sockets.hpp"

#include <arpa/inet.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <string>

namespace pharos::host {
namespace {

std::optional<UdpSocket> as_udp_socket(int fd) {
  int type = 0;
  socklen_t size = sizeof type;
  if (::getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return std::nullopt;
  sockaddr_in address{};
  size = sizeof address;
  if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return std::nullopt;
  if (address.sin_family != AF_INET || address.sin_port == 0) return std::nullopt;
  return UdpSocket{fd, ntohs(address.sin_port)};
}

}  // namespace

std::vector<UdpSocket> udp_sockets() {
  std::vector<UdpSocket> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const std::string name = entry.path().filename();
    int fd = -1;
    std::from_chars(name.data(), name.data() + name.size(), fd);
    if (const auto socket = as_udp_socket(fd)) found.push_back(*socket);
  }
  return found;
}

std::optional<WaitingDatagram> next_waiting(int socket, std::uint32_t address) {
  WaitingDatagram datagram;
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const ssize_t count = ::recvfrom(socket, datagram.head.data(), datagram.head.size(), MSG_PEEK | MSG_DONTWAIT,
                                   reinterpret_cast<sockaddr*>(&from), &size);
  if (count < 0 || from.sin_family != AF_INET || ntohl(from.sin_addr.s_addr) != address) return std::nullopt;
  datagram.source_port = ntohs(from.sin_port);
  return datagram;
}

std::int64_t dropped_datagrams(int socket) {
  std::array<std::uint32_t, SK_MEMINFO_VARS> about{};
  socklen_t size = sizeof about;
  if (::getsockopt(socket, SOL_SOCKET, SO_MEMINFO, about.data(), &size) != 0) return 0;
  return about[SK_MEMINFO_DROPS];
}

}  // namespace pharos::host
