// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include "rtl/capture_device.hpp"

namespace pharos::rtl {

/// Parameters of a variant of the block.
struct CaptureBuild {
  unsigned inputs = 12;
  unsigned depth = 512;
  unsigned filter_width = 4;
  unsigned lost_width = 32;
};

/// Reference model of the behaviour defined in firmware/rtl/capture_registers.h, tick by tick; the Verilog is compared
/// with it. Records contain their stamp, which determines when they are visible.
class CaptureModel {
 public:
  explicit CaptureModel(const CaptureBuild& build) : build_(build) {}

  void reset(std::uint32_t pins);
  void tick(std::uint32_t pins, const BusRequest& request);

  std::uint32_t read_data() const { return read_data_; }
  bool interrupt() const { return interrupt_; }
  void set_ticks(std::uint64_t ticks);
  /// Edges that became records, and those that did not.
  std::uint64_t recorded_edges() const { return recorded_edges_; }
  std::uint64_t lost_edges() const { return lost_edges_; }

 private:
  struct Record {
    std::uint64_t age;  // ticks since it was stored
    std::uint32_t stamp;
    std::uint32_t changed;
    std::uint32_t levels;
    bool gap;
  };

  std::uint32_t input_mask() const { return static_cast<std::uint32_t>((std::uint64_t{1} << build_.inputs) - 1); }
  std::size_t readable() const;
  std::uint32_t answer(std::uint8_t offset);
  void arrive(bool cleared);
  void filter(std::uint32_t seen);
  void write(const BusRequest& request);

  CaptureBuild build_;
  std::uint64_t now_ = 0;
  std::uint64_t high_latched_ = 0;
  std::deque<Record> records_;

  // Pin levels in the synchroniser, the newest first.
  std::array<std::uint32_t, 2> underway_{};
  std::uint32_t levels_ = 0;
  std::uint32_t arriving_ = 0;
  bool glitch_ = false;
  std::array<unsigned, 32> held_{};      // ticks for which an input has differed from its level
  std::array<unsigned, 32> required_{};  // filter length for its next edge

  bool enabled_ = false;
  std::uint32_t threshold_ = 0;
  std::uint32_t input_enable_ = 0;
  std::uint32_t filter_length_ = 0;

  bool overflow_ = false;
  bool gap_ = true;
  std::uint64_t recorded_edges_ = 0;
  std::uint64_t lost_edges_ = 0;
  std::uint32_t glitches_ = 0;

  std::uint32_t read_data_ = 0;
  bool interrupt_ = false;
};

}  // namespace pharos::rtl
