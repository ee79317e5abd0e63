// SPDX-License-Identifier: Apache-2.0
#include "rtl/edges_player.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "firmware/rtl/capture_registers.h"
#include "rtl/capture_device.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint8_t kSensors = 32;
// Latency from a pin's change until its record is counted in STATUS, doubled as a margin.
constexpr std::uint64_t kSettle_ticks = 2 * (PHAROS_CAPTURE_LATENCY_TICKS + PHAROS_CAPTURE_VISIBLE_AFTER_TICKS);
constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

struct PinEdge {
  std::int64_t tick;
  std::uint32_t bit;
};

std::vector<PinEdge> pin_edges(std::span<const lighthouse::RawPulse> pulses, std::size_t& left_out) {
  std::vector<lighthouse::RawPulse> ordered(pulses.begin(), pulses.end());
  std::ranges::stable_sort(ordered, {}, &lighthouse::RawPulse::rise_ticks);
  std::array<std::optional<std::int64_t>, kSensors> dark_since;
  std::vector<PinEdge> edges;
  for (const lighthouse::RawPulse& pulse : ordered) {
    if (pulse.sensor >= kSensors || pulse.fall_ticks <= pulse.rise_ticks ||
        (dark_since[pulse.sensor] && pulse.rise_ticks <= *dark_since[pulse.sensor])) {
      ++left_out;
      continue;
    }
    dark_since[pulse.sensor] = pulse.fall_ticks;
    edges.push_back({pulse.rise_ticks, std::uint32_t{1} << pulse.sensor});
    edges.push_back({pulse.fall_ticks, std::uint32_t{1} << pulse.sensor});
  }
  std::ranges::sort(edges, {}, &PinEdge::tick);
  return edges;
}

class Player {
 public:
  Player(std::vector<PinEdge> edges, const PlayOptions& options, PlayedEdges& played)
      : edges_(std::move(edges)), options_(options), played_(played) {
    device_->reset(0);
    start_ = edges_.front().tick - PHAROS_CAPTURE_LATENCY_TICKS - static_cast<std::int64_t>(kSettle_ticks);
    device_->set_ticks(static_cast<std::uint64_t>(start_));
    tick({BusRequest::Kind::kWrite, PHAROS_CAPTURE_CONTROL_OFFSET, PHAROS_CAPTURE_CONTROL_ENABLE});
  }

  void run() {
    while (true) {
      if (now_ < next_look_) {
        tick({});
        continue;
      }
      next_look_ = now_ + options_.service_ticks;
      const std::uint64_t looked_at = now_;
      if (take_record()) continue;
      if (looked_at < last_edge_ + kSettle_ticks) continue;
      const std::uint64_t edge = next_edge();
      if (edge == kNever) break;
      if (options_.skip_idle && edge > now_) jump(edge);
    }
    played_.lost_edges = read(PHAROS_CAPTURE_LOST_OFFSET);
  }

 private:
  // Ticks since start_ at which the next pin changes.
  std::uint64_t next_edge() const {
    return next_ < edges_.size()
               ? static_cast<std::uint64_t>(edges_[next_].tick - PHAROS_CAPTURE_LATENCY_TICKS - start_)
               : kNever;
  }

  void tick(const BusRequest& request) {
    for (; next_edge() == now_; ++next_) {
      pins_ ^= edges_[next_].bit;
      last_edge_ = now_;
    }
    device_->tick(pins_, request);
    ++now_;
    ++played_.simulated_ticks;
  }

  std::uint32_t read(std::uint8_t offset) {
    tick({BusRequest::Kind::kRead, offset, 0});
    return device_->read_data();
  }

  bool take_record() {
    RecordWords words;
    words.status = read(PHAROS_CAPTURE_STATUS_OFFSET);
    const std::uint32_t count = words.status & PHAROS_CAPTURE_STATUS_COUNT_MASK;
    if (count == 0) return false;
    played_.worst_fill = std::max(played_.worst_fill, count);
    words.time = read(PHAROS_CAPTURE_FIFO_TIME_OFFSET);
    words.changed = read(PHAROS_CAPTURE_FIFO_CHANGED_OFFSET);
    words.levels = read(PHAROS_CAPTURE_FIFO_LEVELS_OFFSET);
    played_.records.push_back(words);
    return true;
  }

  // The block is idle and its FIFO empty: only the counter would change until `tick`. The reader's phase continues.
  void jump(std::uint64_t tick) {
    const std::uint64_t beats = (tick > next_look_) ? (tick - next_look_ - 1) / options_.service_ticks + 1 : 0;
    next_look_ += beats * options_.service_ticks;
    now_ = tick;
    device_->set_ticks(static_cast<std::uint64_t>(start_) + now_);
  }

  std::vector<PinEdge> edges_;
  PlayOptions options_;
  PlayedEdges& played_;
  std::unique_ptr<CaptureDevice> device_ = make_capture_device();
  std::int64_t start_ = 0;
  std::uint64_t now_ = 0;  // ticks since start_
  std::uint64_t next_look_ = 0;
  std::uint64_t last_edge_ = 0;
  std::size_t next_ = 0;
  std::uint32_t pins_ = 0;
};

}  // namespace

PlayedEdges play_edges(std::span<const lighthouse::RawPulse> pulses, const PlayOptions& options) {
  PlayedEdges played;
  auto edges = pin_edges(pulses, played.pulses_left_out);
  if (!edges.empty()) Player(std::move(edges), options, played).run();
  return played;
}

}  // namespace pharos::rtl
