// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "rtl/chip/sdram_model.hpp"
#include "rtl/memory/memory_device.hpp"

namespace pharos::rtl {

/// The cache between a core that fetches and loads and stores, and the model of the SDRAM. Every word that arrives is
/// compared with a plain memory, every request must be taken in time.
class MemoryRig {
 public:
  static constexpr std::uint32_t kWords = 1U << 21;
  static constexpr std::int64_t kMaxWait_ticks = 60;  // two accesses, a refresh, and the one that is asked for

  MemoryRig();
  /// Power on, for the SDRAM too, then until it takes accesses; with a fetch that waits for that, or without.
  void power_on(bool fetches = false);

  /// What the core asks in the next ticks; it is held until it is taken.
  void fetch_from(std::uint32_t word) { inputs_.fetch_address = word % kWords; }
  void load(std::uint32_t word);
  void store(std::uint32_t word, std::uint32_t bytes, std::uint32_t value);
  bool data_pending() const { return inputs_.reads || inputs_.bytes != 0; }

  /// One tick; with a fetch or without, and from elsewhere after it.
  void tick(bool fetches, std::optional<std::uint32_t> jump = std::nullopt);
  /// Ticks until the fetch of this word is taken, 1: at once.
  std::int64_t fetch(std::uint32_t word);
  /// Ticks until the load or store is taken.
  std::int64_t finish_data();
  /// The core's reset, in whatever is on its way.
  void reset();
  /// Until the SDRAM has no access and no refresh on its way.
  void rest();

  SdramModel& sdram() { return sdram_; }
  std::uint32_t expected(std::uint32_t word) const { return words_[word % kWords]; }
  std::uint64_t fetched() const { return fetched_; }
  std::uint64_t loaded() const { return loaded_; }

 private:
  void withdraw();

  std::unique_ptr<MemoryDevice> device_ = make_memory_device();
  SdramModel sdram_;
  MemoryInputs inputs_;
  std::vector<std::uint32_t> words_;
  std::optional<std::uint32_t> awaited_fetch_;
  std::optional<std::uint32_t> awaited_load_;
  bool starting_ = false;
  std::int64_t fetch_waits_ = 0;
  std::int64_t data_waits_ = 0;
  std::uint64_t fetched_ = 0;
  std::uint64_t loaded_ = 0;
};

}  // namespace pharos::rtl
