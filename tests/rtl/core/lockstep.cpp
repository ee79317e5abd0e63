// SPDX-License-Identifier: Apache-2.0
#include "rtl/core/lockstep.hpp"

#include <algorithm>
#include <cstdio>

namespace pharos::rtl {
namespace {

constexpr std::uint64_t kEpisode = 500;  // instructions of a random program
/// No instruction takes longer, with the waits that are drawn here.
constexpr std::uint32_t kMaxTicksOfInstruction = 400;

std::uint32_t lanes_of(std::uint8_t bytes) {
  std::uint32_t lanes = 0;
  for (unsigned i = 0; i < 4; ++i) lanes |= (bytes >> i & 1U) != 0 ? 0xFFU << 8 * i : 0;
  return lanes;
}

std::string hex(std::uint32_t value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%08x", value);
  return text.data();
}

}  // namespace

void RepeatedMemory::store(const DataAccess& access) {
  const std::uint32_t lanes = lanes_of(access.bytes);
  std::uint32_t& word = data(access.address);
  word = (word & ~lanes) | (access.value & lanes);
}

class Lockstep::Bus final : public ModelBus {
 public:
  explicit Bus(Lockstep& bench) : bench_(bench) {}
  std::optional<std::uint32_t> fetch(std::uint32_t address) override {
    if (RepeatedMemory::refuses_fetch(address)) return std::nullopt;
    return bench_.memory_.code(address);
  }
  std::optional<std::uint32_t> load(std::uint32_t address, std::uint8_t bytes) override {
    bench_.model_accesses_.push_back({false, address, bytes, 0});
    if (RepeatedMemory::refuses_data(address)) return std::nullopt;
    return bench_.model_memory_.data(address);
  }
  bool store(std::uint32_t address, std::uint8_t bytes, std::uint32_t value) override {
    const DataAccess access{true, address, bytes, value & lanes_of(bytes)};
    bench_.model_accesses_.push_back(access);
    if (RepeatedMemory::refuses_data(address)) return false;
    bench_.model_memory_.store(access);
    return true;
  }

 private:
  Lockstep& bench_;
};

Lockstep::Lockstep(std::uint64_t seed)
    : stream_(seed), bus_(std::make_unique<Bus>(*this)), model_(*bus_, kResetAddress) {}

void Lockstep::differs(const std::string& what) {
  if (difference_.empty()) difference_ = "after " + std::to_string(instructions_) + " instructions: " + what;
}

void Lockstep::reset(const std::array<std::uint32_t, 32>& registers) {
  inputs_ = {};
  inputs_.reset = true;
  (void)core_->show(inputs_, &RepeatedMemory::refuses_data);
  core_->tick();
  (void)core_->show(inputs_, &RepeatedMemory::refuses_data);
  core_->tick();
  inputs_.reset = false;
  model_.state() = {};
  model_.state().pc = kResetAddress;
  model_.state().x = registers;
  model_.state().x[0] = 0;
  for (unsigned i = 0; i < 32; ++i) core_->set_register(i, registers[i]);
  for (std::uint32_t i = 0; i < RepeatedMemory::kWords; ++i) model_memory_.data(4 * i) = memory_.data(4 * i);
  core_accesses_.clear();
  cycle_ = 0;
  data_waited_ = false;
  always_pending_ = false;
  ticks_without_end_ = 0;
}

void Lockstep::set_counters(std::uint64_t cycle, std::uint64_t instret) {
  core_->set_counters(cycle, instret);
  cycle_ = cycle;
  model_.state().instret = instret;
}

void Lockstep::check_bus(const CoreOutputs& now) {
  if (now.reads && now.writes) differs("reads and writes at once");
  const bool same = now.reads == before_.reads && now.writes == before_.writes &&
                    now.data_address == before_.data_address && now.bytes == before_.bytes &&
                    (!now.writes || now.stored == before_.stored);
  if (data_waited_ && !same) differs("a request to the data bus changed while it waited");
  data_waited_ = (now.reads || now.writes) && inputs_.data_waits;
}

void Lockstep::take_accesses(const CoreOutputs& now) {
  const bool fetched = now.fetches && !inputs_.fetch_waits;
  const bool read = now.reads && !inputs_.data_waits;
  if ((now.reads || now.writes) && !inputs_.data_waits) {
    const DataAccess access{now.writes, now.data_address, now.bytes, now.writes ? now.stored & lanes_of(now.bytes) : 0};
    core_accesses_.push_back(access);
    if (now.writes && !RepeatedMemory::refuses_data(now.data_address)) memory_.store(access);
  }
  // What was not requested is noise.
  inputs_.fetched = fetched ? memory_.code(now.fetch_address) : stream_.value();
  inputs_.fetch_fault = fetched ? RepeatedMemory::refuses_fetch(now.fetch_address) : stream_.below(2) != 0;
  inputs_.loaded = read ? memory_.data(now.data_address) : stream_.value();
}

void Lockstep::compare(std::uint32_t address, std::uint32_t word) {
  ProcessorState core = core_->state();
  core.pc = model_.state().pc;
  core.x[0] = 0;
  if (!core_->copies_agree()) differs("the copies of the registers differ");
  if (core_accesses_ != model_accesses_) differs("accesses to the data bus, at " + hex(address));
  if (core == model_.state()) return;
  std::string what = "at " + hex(address) + " instruction " + hex(word) + ":";
  for (unsigned i = 1; i < 32; ++i) {
    if (core.x[i] != model_.state().x[i])
      what += " x" + std::to_string(i) + " " + hex(core.x[i]) + " instead of " + hex(model_.state().x[i]);
  }
  if (core.mcause != model_.state().mcause)
    what += " mcause " + hex(core.mcause) + " instead of " + hex(model_.state().mcause);
  if (core.mepc != model_.state().mepc) what += " mepc " + hex(core.mepc) + " instead of " + hex(model_.state().mepc);
  if (core.mtval != model_.state().mtval)
    what += " mtval " + hex(core.mtval) + " instead of " + hex(model_.state().mtval);
  differs(what);
}

void Lockstep::end(const CoreOutputs& now) {
  ++instructions_;
  ticks_without_end_ = 0;
  const std::uint32_t address = model_.state().pc;
  if (now.address != address) differs("executes " + hex(now.address) + " instead of " + hex(address));
  const bool wanted = model_.state().mie && model_.state().mtie;
  model_accesses_.clear();
  if (now.interrupted) {
    ++interrupts_;
    if (!wanted || !inputs_.timer_interrupt) differs("an interrupt that is not enabled");
    model_.interrupt();
  } else {
    if (wanted && always_pending_) differs("an interrupt was left out");
    const StepResult result = model_.step({cycle_, inputs_.timer_interrupt});
    if ((result == StepResult::kTrapped) != now.trapped)
      differs(now.trapped ? "trapped at " + hex(address) : "not trapped at " + hex(address));
    if (result == StepResult::kTrapped) {
      ++trapped_[model_.state().mcause & 15];
    } else {
      ++ended_[kind_of(memory_.code(address))];
    }
  }
  always_pending_ = true;
}

void Lockstep::tick(const Options& options) {
  inputs_.fetch_waits = stream_.below(8) < options.fetch_waits_of_8;
  inputs_.data_waits = stream_.below(8) < options.data_waits_of_8;
  if (options.interrupts) {
    if (stream_.below(32) == 0) inputs_.timer_interrupt = !inputs_.timer_interrupt;
  } else {
    inputs_.timer_interrupt = false;
  }
  always_pending_ = always_pending_ && inputs_.timer_interrupt;
  const CoreOutputs now = core_->show(inputs_, &RepeatedMemory::refuses_data);
  check_bus(now);
  const bool ends = now.ends;
  const std::uint32_t address = now.address;
  take_accesses(now);
  if (ends) end(now);
  core_->tick();
  ++cycle_;
  ++ticks_;
  if (ends) {
    compare(address, memory_.code(address));
    core_accesses_.clear();
    if (renews_code_) renew_code(address, !now.interrupted && !now.trapped);
  } else if (++ticks_without_end_ > kMaxTicksOfInstruction) {
    differs("no instruction ends");
  }
  before_ = now;
}

void Lockstep::renew_code(std::uint32_t address, bool retired) {
  constexpr std::uint32_t kFenceInstructions = 0x100F;
  const bool fence = retired && (memory_.code(address) & 0x707F) == kFenceInstructions;
  // After the fence, what was fetched before it must not be executed.
  for (std::uint32_t ahead = 0; ahead < (fence ? 16 : 4); ahead += 4) memory_.code(address + ahead) = stream_.next();
}

bool Lockstep::run(std::uint64_t instructions, const Options& options) {
  const std::uint64_t last = instructions_ + instructions;
  while (instructions_ < last && difference_.empty()) tick(options);
  return difference_.empty();
}

bool Lockstep::run_random(std::uint64_t instructions) {
  renews_code_ = true;
  for (std::uint64_t done = 0; done < instructions && difference_.empty(); done += kEpisode) {
    for (std::uint32_t i = 0; i < RepeatedMemory::kWords; ++i) {
      memory_.code(4 * i) = stream_.next();
      memory_.data(4 * i) = stream_.value();
    }
    if (stream_.below(2) == 0) {     // with interrupts from the beginning
      memory_.code(0) = 0x08000293;  // li x5, 128
      memory_.code(4) = 0x30429073;  // csrw mie, x5
      memory_.code(8) = 0x30046073;  // csrsi mstatus, 8
    }
    std::array<std::uint32_t, 32> registers{};
    for (std::uint32_t& value : registers) value = stream_.value();
    reset(registers);
    // Counters near a carry.
    set_counters((std::uint64_t{stream_.value()} << 32) - stream_.below(1000),
                 (std::uint64_t{stream_.value()} << 32) - stream_.below(500));
    const Options options{stream_.below(4), stream_.below(6), stream_.below(2) != 0};
    (void)run(kEpisode, options);
  }
  renews_code_ = false;
  return difference_.empty();
}

}  // namespace pharos::rtl
