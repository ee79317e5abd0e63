// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/serial/serial_port.hpp"
#include "tools/flash/flash_line.hpp"

namespace pharos::tools {

class SerialFlashLine final : public FlashLine {
 public:
  /// Throws host::InputError when the port cannot be opened: no such device, no permission, in use by another program.
  SerialFlashLine(const std::string& path, int baud);

  void write(std::span<const std::uint8_t> bytes) override;
  std::size_t read(std::span<std::uint8_t> out, std::int64_t deadline_ns) override;
  std::int64_t now_ns() override;

 private:
  bool wait(short events, std::int64_t deadline_ns);
  std::size_t checked(host::Transfer transfer) const;

  std::string path_;
  host::SerialPort port_;
};

}  // namespace pharos::tools
