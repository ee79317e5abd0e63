// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Source of hostile datagrams to a camera's stream.
enum class Attacker : std::uint8_t {
  kOtherAddress,  // 127.0.0.3
  kOtherPort,     // the camera's address
  kCamerasPort,   // its address and port: a spoofed source, as on an open network
};
inline constexpr std::array kAttackers{Attacker::kOtherAddress, Attacker::kOtherPort, Attacker::kCamerasPort};

/// Ports of this network's UDP sockets that are bound to 127.0.0.1 and are not of this process: those of the camera's
/// process.
std::vector<std::uint16_t> ports_of_others();
/// The socket from which the simulated camera of this process streams; -1 if there is none.
int socket_of_simulated_camera();

/// A UDP socket at that address of this computer.
UniqueFd bound_socket(const char* address);

/// Generates and sends datagrams that may crash a parser: the one that makes Aravis allocate 68 GB, random bytes of
/// random length, and GVSP packets of every kind with one or more invalid fields.
class HostileSender {
 public:
  explicit HostileSender(std::uint64_t seed);
  /// `count` datagrams to `port` of 127.0.0.1, kinds mixed.
  void send(Attacker attacker, std::uint16_t port, int count);
  std::int64_t sent() const { return sent_; }

 private:
  std::vector<std::uint8_t> make();
  std::vector<std::uint8_t> make_packet();
  std::uint64_t number(std::uint64_t below) { return random_() % below; }

  std::mt19937_64 random_;
  UniqueFd other_address_;
  UniqueFd other_port_;
  int cameras_ = -1;
  std::int64_t sent_ = 0;
};

}  // namespace pharos::host
