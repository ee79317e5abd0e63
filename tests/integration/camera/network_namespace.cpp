// SPDX-License-Identifier: Apache-2.0
#include "integration/camera/network_namespace.hpp"

#include <arpa/inet.h>
#include <net/if.h>
#include <net/route.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cstring>

#include "host/support/unique_fd.hpp"

namespace pharos::host {
namespace {

sockaddr internet_address(const char* text) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  ::inet_pton(AF_INET, text, &address.sin_addr);
  sockaddr plain{};
  std::memcpy(&plain, &address, sizeof plain);
  return plain;
}

bool bring_loopback_up(int socket) {
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  request.ifr_flags = IFF_UP | IFF_LOOPBACK | IFF_RUNNING;
  return ::ioctl(socket, SIOCSIFFLAGS, &request) == 0;
}

// For a second camera: each needs its own address.
bool add_second_address(int socket) {
  ifreq request{};
  std::strcpy(request.ifr_name, "lo:2");
  request.ifr_addr = internet_address("127.0.0.2");
  if (::ioctl(socket, SIOCSIFADDR, &request) != 0) return false;
  request.ifr_netmask = internet_address("255.0.0.0");
  return ::ioctl(socket, SIOCSIFNETMASK, &request) == 0;
}

bool route_multicast(int socket) {
  char device[] = "lo";
  rtentry route{};
  route.rt_dst = internet_address("224.0.0.0");
  route.rt_genmask = internet_address("240.0.0.0");
  route.rt_flags = RTF_UP;
  route.rt_dev = device;
  return ::ioctl(socket, SIOCADDRT, &route) == 0;
}

}  // namespace

void NetworkNamespace::SetUp() {
  if (::unshare(CLONE_NEWNET) != 0 && ::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return;
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ASSERT_TRUE(socket.valid());
  ASSERT_TRUE(bring_loopback_up(socket.get()));
  ASSERT_TRUE(add_second_address(socket.get()));
  ASSERT_TRUE(route_multicast(socket.get()));
}

}  // namespace pharos::host
