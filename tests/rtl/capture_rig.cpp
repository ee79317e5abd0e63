// SPDX-License-Identifier: Apache-2.0
#include "rtl/capture_rig.hpp"

#include <gtest/gtest.h>

#include "firmware/rtl/capture_registers.h"

namespace pharos::rtl {
namespace {

// The build passes its parameters to the program, so that the block's BUILD register can be checked against them.
constexpr CaptureBuild kBuild{.inputs = PHAROS_RTL_INPUTS,
                              .depth = PHAROS_RTL_DEPTH,
                              .filter_width = PHAROS_RTL_FILTER_WIDTH,
                              .lost_width = PHAROS_RTL_LOST_WIDTH};

const char* name_of(BusRequest::Kind kind) {
  switch (kind) {
    case BusRequest::Kind::kRead:
      return "read of";
    case BusRequest::Kind::kWrite:
      return "write to";
    default:
      return "address";
  }
}

}  // namespace

bool CaptureRecord::gap() const { return (status & PHAROS_CAPTURE_STATUS_GAP) != 0; }

CaptureRig::CaptureRig() : build_(kBuild), model_(kBuild) { reset(); }

void CaptureRig::reset(std::uint32_t pins) {
  set_pins(pins);
  device_->reset(pins_);
  model_.reset(pins_);
}

void CaptureRig::set_ticks(std::uint64_t ticks) {
  device_->set_ticks(ticks);
  model_.set_ticks(ticks);
}

void CaptureRig::tick(const BusRequest& request) {
  device_->tick(pins_, request);
  model_.tick(pins_, request);
  if (agrees_) compare(request);
}

void CaptureRig::compare(const BusRequest& request) {
  agrees_ = device_->read_data() == model_.read_data() && device_->interrupt() == model_.interrupt();
  if (agrees_) return;
  ADD_FAILURE() << "tick " << device_->ticks() - 1 << ", " << name_of(request.kind) << " 0x" << std::hex
                << unsigned{request.offset} << ": the block answers 0x" << device_->read_data() << " interrupt "
                << device_->interrupt() << ", the reference 0x" << model_.read_data() << " interrupt "
                << model_.interrupt();
}

void CaptureRig::ticks(std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) tick();
}

std::uint32_t CaptureRig::read(std::uint8_t offset) {
  tick({BusRequest::Kind::kRead, offset, 0});
  return device_->read_data();
}

void CaptureRig::write(std::uint8_t offset, std::uint32_t data) { tick({BusRequest::Kind::kWrite, offset, data}); }

void CaptureRig::enable() { write(PHAROS_CAPTURE_CONTROL_OFFSET, PHAROS_CAPTURE_CONTROL_ENABLE); }

std::optional<CaptureRecord> CaptureRig::read_record() {
  CaptureRecord record;
  record.status = read(PHAROS_CAPTURE_STATUS_OFFSET);
  if ((record.status & PHAROS_CAPTURE_STATUS_COUNT_MASK) == 0) return std::nullopt;
  record.stamp = read(PHAROS_CAPTURE_FIFO_TIME_OFFSET);
  record.changed = read(PHAROS_CAPTURE_FIFO_CHANGED_OFFSET);
  record.levels = read(PHAROS_CAPTURE_FIFO_LEVELS_OFFSET);
  return record;
}

std::vector<CaptureRecord> CaptureRig::drain() {
  std::vector<CaptureRecord> records;
  while (const auto record = read_record()) records.push_back(*record);
  return records;
}

}  // namespace pharos::rtl
