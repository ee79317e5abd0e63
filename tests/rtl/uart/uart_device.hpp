// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

namespace pharos::rtl {

/// The bus and the pins of the UART.
struct UartInputs {
  bool reset = false;
  std::uint32_t address = 0;  // of a register
  bool reads = false;
  bool writes = false;
  std::uint8_t written = 0;
  bool receive = true;
};

struct UartOutputs {
  std::uint8_t read = 0;  // of the tick before
  bool transmit = true;
};

/// firmware/rtl/soc/soc_uart.v, Verilated.
class UartDevice {
 public:
  virtual ~UartDevice() = default;
  /// One tick with these inputs; the outputs before its end.
  virtual UartOutputs tick(const UartInputs& inputs) = 0;
};

std::unique_ptr<UartDevice> make_uart_device();

}  // namespace pharos::rtl
