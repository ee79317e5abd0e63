// SPDX-License-Identifier: Apache-2.0
#include "tools/view/connections.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kRequestTime_ns = 5 * kSecond_ns;
constexpr std::int64_t kAnswerTime_ns = 30 * kSecond_ns;
constexpr std::int64_t kStallTime_ns = 5 * kSecond_ns;
constexpr int kBacklog = 512;
// Then the viewers have their turn again.
constexpr int kMaxRefusedAtOnce = 64;
// What waits in the kernel for a slow client is old: little of it.
constexpr int kSendBuffer_bytes = 128 * 1024;

constexpr std::string_view kRefusal =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Type: text/plain\r\nContent-Length: 29\r\nRetry-After: 5\r\n"
    "Connection: close\r\n\r\nall 64 connections are taken\n";

using AddressList = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

AddressList resolve(const std::string& address, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICHOST | AI_PASSIVE;
  addrinfo* list = nullptr;
  if (::getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &list) != 0) {
    throw host::InputError("--listen " + address + ": give a numeric address of this computer (0.0.0.0 for all)");
  }
  return {list, ::freeaddrinfo};
}

std::uint16_t port_of(int fd) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(&address)->sin6_port
                                             : reinterpret_cast<sockaddr_in*>(&address)->sin_port);
}

bool is_loopback_address(const addrinfo& info) {
  if (info.ai_family == AF_INET6) {
    return IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(info.ai_addr)->sin6_addr) != 0;
  }
  constexpr std::uint32_t kNet127 = 127U;
  return ntohl(reinterpret_cast<const sockaddr_in*>(info.ai_addr)->sin_addr.s_addr) >> 24U == kNet127;
}

}  // namespace

Connections::Connections(const std::string& address, std::uint16_t port) {
  const AddressList list = resolve(address, port);
  loopback_ = is_loopback_address(*list);
  listener_.reset(::socket(list->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  ::setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (!listener_.valid() || ::bind(listener_.get(), list->ai_addr, list->ai_addrlen) != 0 ||
      ::listen(listener_.get(), kBacklog) != 0) {
    throw host::InputError(address + " port " + std::to_string(port) + ": " + std::strerror(errno) +
                           "; give another --port (0 for any free one) or another --listen");
  }
  port_ = port_of(listener_.get());
}

std::optional<host::UniqueFd> Connections::accept() {
  for (int refused = 0; refused < kMaxRefusedAtOnce;) {
    host::UniqueFd socket(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!socket.valid()) {
      if (errno == EINTR || errno == ECONNABORTED) continue;
      return std::nullopt;
    }
    if (served_.size() < kMaxServed) {
      ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDBUF, &kSendBuffer_bytes, sizeof kSendBuffer_bytes);
      return socket;
    }
    refuse(std::move(socket));
    ++refused;
  }
  return std::nullopt;
}

void Connections::refuse(host::UniqueFd socket) {
  ++refused_;
  // An answer of this size fits into the buffer of a new socket.
  [[maybe_unused]] const ssize_t sent =
      ::send(socket.get(), kRefusal.data(), kRefusal.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  ::shutdown(socket.get(), SHUT_WR);
  lingering_[next_lingering_] = std::move(socket);
  next_lingering_ = (next_lingering_ + 1) % lingering_.size();
}

void Connections::opened(int fd, std::int64_t now_ns) { served_[fd] = {ConnectionPhase::kRequesting, now_ns}; }

void Connections::set_phase(int fd, ConnectionPhase phase, std::int64_t now_ns) {
  const auto at = served_.find(fd);
  if (at != served_.end()) at->second = {phase, now_ns};
}

void Connections::moved(int fd, std::int64_t now_ns) {
  const auto at = served_.find(fd);
  if (at != served_.end()) at->second.since_ns = now_ns;
}

void Connections::shut_late(std::int64_t now_ns) {
  for (const auto& [fd, served] : served_) {
    const std::int64_t limit_ns = served.phase == ConnectionPhase::kRequesting  ? kRequestTime_ns
                                  : served.phase == ConnectionPhase::kAnswering ? kAnswerTime_ns
                                                                                : kStallTime_ns;
    if (now_ns - served.since_ns > limit_ns) ::shutdown(fd, SHUT_RDWR);
  }
}

}  // namespace pharos::tools
