// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pharos/wire/hello_message.hpp"

namespace pharos::tools {

/// What a serial port did while it was listened to.
struct PortFinding {
  std::string port;
  /// ok: a board greeted; no_hello: frames of Pharos without a greeting; unknown_data: bytes that are none; silent;
  /// busy, no_permission, missing, bad_speed, error: not opened.
  std::string status;
  std::optional<wire::Hello> hello;
  std::string message;  // for people: why it is not ok
};

/// Serial adaptors below `dev`, each once, under the name that lasts longest: pharos-*, serial/by-id/*, then ttyUSB*
/// and ttyACM*.
std::vector<std::string> serial_ports(const std::filesystem::path& dev = "/dev");

/// Listens to all of them at once for a greeting, which boards send once a second, and writes nothing. Ends when all
/// have greeted, at the latest after `limit`.
std::vector<PortFinding> survey_ports(const std::vector<std::string>& ports, int baud, std::chrono::milliseconds limit);

/// Words for people and configurations: version "0.2.1", serial number "0A1B2C3D" (empty: none), inputs.
std::string version_of(const wire::Hello& hello);
std::string serial_of(const wire::Hello& hello);
int sensors_of(const wire::Hello& hello);

}  // namespace pharos::tools
