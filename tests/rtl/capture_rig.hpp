// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "rtl/capture_device.hpp"
#include "rtl/capture_model.hpp"

namespace pharos::rtl {

/// A record as firmware reads it: the four words from STATUS on.
struct CaptureRecord {
  std::uint32_t status = 0;
  std::uint32_t stamp = 0;
  std::uint32_t changed = 0;
  std::uint32_t levels = 0;

  bool gap() const;
};

/// The Verilated block and the reference model in parallel: their read data are compared in every tick, and the first
/// difference fails the running test with its tick, request and both values.
class CaptureRig {
 public:
  CaptureRig();

  const CaptureBuild& build() const { return build_; }
  const CaptureModel& model() const { return model_; }
  std::uint32_t input_mask() const { return static_cast<std::uint32_t>((std::uint64_t{1} << build_.inputs) - 1); }

  void reset(std::uint32_t pins = 0);
  void set_ticks(std::uint64_t ticks);
  std::uint64_t ticks() const { return device_->ticks(); }
  bool interrupt() const { return device_->interrupt(); }

  /// Levels on the pins from the next tick on.
  void set_pins(std::uint32_t pins) { pins_ = pins & input_mask(); }
  std::uint32_t pins() const { return pins_; }

  void tick(const BusRequest& request = {});
  void ticks(std::uint64_t count);
  /// One tick for the request, and the read data in the tick after it; the pins are sampled in both.
  std::uint32_t read(std::uint8_t offset);
  void write(std::uint8_t offset, std::uint32_t data);

  void enable();
  /// The oldest record, if STATUS counts one.
  std::optional<CaptureRecord> read_record();
  /// Reads records until there are none.
  std::vector<CaptureRecord> drain();

  /// Both still agree (a difference is reported once; comparing then stops).
  bool agrees() const { return agrees_; }

 private:
  void compare(const BusRequest& request);

  std::unique_ptr<CaptureDevice> device_ = make_capture_device();
  CaptureBuild build_;
  CaptureModel model_{build_};
  std::uint32_t pins_ = 0;
  bool agrees_ = true;
};

}  // namespace pharos::rtl
