// SPDX-License-Identifier: Apache-2.0
#include "rtl/memory/memory_rig.hpp"

#include <gtest/gtest.h>

namespace pharos::rtl {
namespace {

constexpr std::int64_t kStart_ticks = 48 * 390 + 20;  // soc_sdram.v

}  // namespace

MemoryRig::MemoryRig() : words_(kWords, 0xDEADDEAD) { power_on(); }

void MemoryRig::power_on(bool fetches) {
  withdraw();
  inputs_.fetches = false;
  awaited_fetch_.reset();
  awaited_load_.reset();
  inputs_.power_on_reset = true;
  for (int i = 0; i < 2; ++i) {
    (void)device_->show(inputs_);
    device_->tick();
  }
  inputs_.power_on_reset = false;
  sdram_.restart();
  reset();
  starting_ = true;
  for (std::int64_t i = 0; i < kStart_ticks; ++i) tick(fetches);
  starting_ = false;
}

void MemoryRig::withdraw() {
  inputs_.reads = false;
  inputs_.bytes = 0;
}

void MemoryRig::reset() {
  withdraw();
  inputs_.reset = true;
  for (int i = 0; i < 16; ++i) tick(false);
  inputs_.reset = false;
}

void MemoryRig::rest() {
  for (int i = 0; i < 20; ++i) tick(false);
}

void MemoryRig::load(std::uint32_t word) {
  inputs_.reads = true;
  inputs_.address = word % kWords;
}

void MemoryRig::store(std::uint32_t word, std::uint32_t bytes, std::uint32_t value) {
  inputs_.bytes = bytes;
  inputs_.address = word % kWords;
  inputs_.stored = value;
}

void MemoryRig::tick(bool fetches, std::optional<std::uint32_t> jump) {
  inputs_.fetches = fetches;
  inputs_.jumps = jump.has_value();
  const bool waits = device_->show(inputs_).fetch_waits;
  const bool taken = fetches && !waits;
  inputs_.next_fetch_address = jump ? *jump % kWords : (inputs_.fetch_address + (taken ? 1 : 0)) % kWords;
  const MemoryOutputs now = device_->show(inputs_);
  EXPECT_EQ(now.fetch_waits, waits) << "the wait depends on the next address";
  EXPECT_EQ(now.fetched, awaited_fetch_.value_or(now.fetched)) << "fetch " << fetched_;
  EXPECT_EQ(now.loaded, awaited_load_.value_or(now.loaded)) << "load " << loaded_;
  awaited_fetch_.reset();
  awaited_load_.reset();
  if (taken) {
    awaited_fetch_ = words_[inputs_.fetch_address];
    ++fetched_;
  }
  fetch_waits_ = fetches && waits && !jump && !starting_ ? fetch_waits_ + 1 : 0;
  EXPECT_LE(fetch_waits_, kMaxWait_ticks) << "a fetch is not taken";
  const bool data_taken = data_pending() && !now.data_waits;
  if (data_taken && inputs_.reads) {
    awaited_load_ = words_[inputs_.address];
    ++loaded_;
  }
  if (data_taken && inputs_.bytes != 0) {
    std::uint32_t lanes = 0;
    for (unsigned i = 0; i < 4; ++i) lanes |= (inputs_.bytes >> i & 1U) != 0 ? 0xFFU << 8 * i : 0;
    std::uint32_t& word = words_[inputs_.address];
    word = (word & ~lanes) | (inputs_.stored & lanes);
  }
  data_waits_ = data_pending() && !data_taken ? data_waits_ + 1 : 0;
  EXPECT_LE(data_waits_, kMaxWait_ticks) << "a load or store is not taken";
  device_->tick();
  inputs_.sdram_data = sdram_.tick(now.sdram);
  inputs_.fetch_address = inputs_.next_fetch_address;
  if (data_taken) withdraw();
}

std::int64_t MemoryRig::fetch(std::uint32_t word) {
  if (inputs_.fetch_address != word % kWords) tick(false, word);
  const std::uint64_t before = fetched_;
  std::int64_t ticks = 0;
  while (fetched_ == before && ticks < 2 * kMaxWait_ticks) {
    tick(true);
    ++ticks;
  }
  return ticks;
}

std::int64_t MemoryRig::finish_data() {
  std::int64_t ticks = 0;
  while (data_pending() && ticks < 2 * kMaxWait_ticks) {
    tick(false);
    ++ticks;
  }
  return ticks;
}

}  // namespace pharos::rtl
