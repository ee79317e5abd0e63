// SPDX-License-Identifier: Apache-2.0
#include "rtl/chip/sdram_model.hpp"

#include <algorithm>

namespace pharos::rtl {
namespace {

constexpr std::int64_t kTick_ns = 20;
constexpr std::int64_t ticks(std::int64_t ns) { return (ns + kTick_ns - 1) / kTick_ns; }

// Data sheets of the grade -75 (133 MHz), the longest of several makers.
constexpr std::int64_t kStart = ticks(200'000);
constexpr std::int64_t kRowToColumn = ticks(20);   // tRCD
constexpr std::int64_t kClose = ticks(20);         // tRP
constexpr std::int64_t kRowCycle = ticks(68);      // tRC
constexpr std::int64_t kRefreshCycle = ticks(75);  // tRFC
constexpr std::int64_t kMinOpen = ticks(45);       // tRAS
constexpr std::int64_t kMaxOpen = ticks(100'000);  // tRAS
constexpr std::int64_t kRowToRow = ticks(15);      // tRRD
constexpr std::int64_t kWriteRecovery = 2;         // tWR
constexpr std::int64_t kModeSet = 2;               // tMRD
constexpr std::int64_t kLatency = 2;               // CAS latency, as the mode must say
constexpr unsigned kBurst = 8;
constexpr std::uint32_t kMode = 0x223;  // single writes, latency 2, bursts of 8 in sequence
constexpr unsigned kMinRefreshesAtStart = 8;
constexpr std::int64_t kRefresh_half_ns = 15'625;  // 8,192 in 64 ms
constexpr std::int64_t kLate_half_ns = 40 * 20;    // behind an access
constexpr std::uint32_t kCloses = 1U << 10;        // A10
constexpr std::uint32_t kColumns = 512;
constexpr std::uint32_t kRows = 2'048;  // of 8,192: 8 MiB
constexpr std::uint16_t kNoise = 0xDEAD;

}  // namespace

SdramModel::SdramModel() : content_(std::size_t{4} * kRows * kColumns, kNoise) {}

void SdramModel::require(bool holds, const char* rule) {
  constexpr std::size_t kMaxViolations = 20;
  if (holds || violations_.size() >= kMaxViolations) return;
  violations_.push_back("tick " + std::to_string(now_) + ": " + rule);
}

void SdramModel::require_all_closed(const char* rule) {
  for (const Bank& bank : banks_) require(!bank.open && now_ - bank.closed >= kClose, rule);
}

void SdramModel::restart() {
  banks_ = {};
  burst_left_ = 0;
  shown_ = false;
  started_ = now_;
  all_closed_once_ = false;
  refreshes_before_mode_ = 0;
  ready_ = false;
}

std::uint16_t& SdramModel::at(std::uint32_t bank, std::uint32_t column) {
  return content_[(std::size_t{banks_[bank].row} * banks_.size() + bank) * kColumns + column];
}

void SdramModel::write(std::uint32_t offset, std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    std::uint16_t& half = content_.at(offset / 2);
    half = static_cast<std::uint16_t>(offset % 2 == 0 ? (half & 0xFF00) | byte : (half & 0xFF) | unsigned{byte} << 8);
    ++offset;
  }
}

std::uint8_t SdramModel::read(std::uint32_t offset) const {
  return static_cast<std::uint8_t>(content_.at(offset / 2) >> 8 * (offset % 2));
}

std::uint16_t SdramModel::tick(const SdramPins& pins) {
  ++now_;
  for (Bank& bank : banks_) {
    if (!bank.open) continue;
    require(now_ - bank.opened <= kMaxOpen, "a row is open for longer than 100 us");
    if (now_ < bank.closes) continue;
    bank.open = false;
    bank.closed = bank.closes;
    bank.closes = kNever;
  }
  if (ready_) {
    owed_half_ns_ += 2 * kTick_ns;
    if (owed_half_ns_ > kRefresh_half_ns + kLate_half_ns) {
      require(false, "no refresh in 7.8 us");
      owed_half_ns_ = 0;
    }
  }
  require(!pins.driven || !shown_, "both ends drive the data");
  if (!(pins.ras_n && pins.cas_n && pins.we_n)) command(pins);
  shown_ = burst_left_ != 0 && now_ >= burst_begins_;
  if (!shown_) return kNoise;
  const std::uint32_t column =
      (burst_column_ & ~(kBurst - 1)) | ((burst_column_ + kBurst - burst_left_) & (kBurst - 1));
  --burst_left_;
  return content_[(std::size_t{burst_row_} * banks_.size() + burst_bank_) * kColumns + column];
}

void SdramModel::command(const SdramPins& pins) {
  require(now_ - started_ >= kStart, "a command in the first 200 us");
  require(now_ - mode_set_ >= kModeSet, "a command within tMRD");
  require(now_ - refreshed_ >= kRefreshCycle, "a command within tRFC");
  const bool row = !pins.ras_n;
  const bool column = !pins.cas_n;
  if (row && !column && pins.we_n) return open(pins);
  if (row && !column) return close(pins);
  if (row && column && pins.we_n) return refresh();
  if (row && column) return set_mode(pins);
  if (column) return access(pins, !pins.we_n);
  require(false, "a burst is stopped");
}

void SdramModel::open(const SdramPins& pins) {
  Bank& bank = banks_[pins.bank];
  require(ready_, "a row opens before the mode is set");
  require(!bank.open, "a row opens where one is open");
  require(now_ - bank.closed >= kClose, "a row opens within tRP");
  require(now_ - bank.opened >= kRowCycle, "a row opens within tRC");
  require(now_ - last_opened_ >= kRowToRow, "a row opens within tRRD");
  require(pins.address < kRows, "a row beyond the 8 MiB");
  bank = {.open = true, .row = pins.address % kRows, .opened = now_, .closed = bank.closed, .written = bank.written};
  last_opened_ = now_;
}

void SdramModel::access(const SdramPins& pins, bool write) {
  Bank& bank = banks_[pins.bank];
  require(bank.open && bank.closes == kNever, write ? "a write where no row is open" : "a read where no row is open");
  require(now_ - bank.opened >= kRowToColumn, "a column within tRCD");
  require(burst_left_ == 0, "an access while a burst is read");
  const std::uint32_t column = pins.address % kColumns;
  std::int64_t ends = now_ + kBurst;
  if (write) {
    require(pins.driven, "nothing drives the data of a write");
    std::uint16_t& half = at(pins.bank, column);
    const auto kept = static_cast<std::uint16_t>((pins.mask & 1 ? 0xFF : 0) | (pins.mask & 2 ? 0xFF00 : 0));
    half = static_cast<std::uint16_t>((half & kept) | (pins.data & ~kept));
    bank.written = now_;
    ends = now_ + kWriteRecovery;
  } else {
    require(pins.mask == 0, "a read is masked");
    burst_begins_ = now_ + kLatency - 1;
    burst_left_ = kBurst;
    burst_bank_ = pins.bank;
    burst_row_ = bank.row;
    burst_column_ = column;
  }
  if ((pins.address & kCloses) != 0) bank.closes = std::max(ends, bank.opened + kMinOpen);
}

void SdramModel::close(const SdramPins& pins) {
  for (std::uint32_t number = 0; number < banks_.size(); ++number) {
    if ((pins.address & kCloses) == 0 && number != pins.bank) continue;
    Bank& bank = banks_[number];
    if (!bank.open) continue;
    require(now_ - bank.opened >= kMinOpen, "a row closes within tRAS");
    require(now_ - bank.written >= kWriteRecovery, "a row closes within tWR");
    bank.open = false;
    bank.closed = now_;
    bank.closes = kNever;
  }
  all_closed_once_ = all_closed_once_ || (pins.address & kCloses) != 0;
}

void SdramModel::refresh() {
  require(all_closed_once_, "a refresh before all banks were closed");
  require_all_closed("a refresh while a bank is open");
  refreshed_ = now_;
  ++refreshes_;
  ++refreshes_before_mode_;
  owed_half_ns_ = std::max<std::int64_t>(owed_half_ns_ - kRefresh_half_ns, -kRefresh_half_ns);
}

void SdramModel::set_mode(const SdramPins& pins) {
  require(refreshes_before_mode_ >= kMinRefreshesAtStart, "the mode is set before eight refreshes");
  require_all_closed("the mode is set while a bank is open");
  require(pins.address == kMode && pins.bank == 0, "another mode");
  mode_set_ = now_;
  ready_ = true;
  owed_half_ns_ = 0;
}

}  // namespace pharos::rtl
