// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "host/publish/cycle_report.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::host {

/// The bearings behind each pose, for bearings_t.
///
/// The core's tracker keeps only residuals of a cycle (its memory is a soft core's), so the cycle is joined here once
/// more: 3 us of a cycle's 16.7 ms.
class CycleBearings {
 public:
  CycleBearings(const Target& target, const track::TrackOptions& options) : target_(target), options_(options) {}

  /// Push every sweep that the tracker gets. The cycle that it closed, if any: the one that the tracker answers.
  std::optional<track::Cycle> push(const lighthouse::Sweep& sweep);

  /// `cycle` as it is told: raw and ideal angles, and what the solver made of each.
  /// `calibration` may be null, `residuals` are those of track::EpochTracker.
  std::vector<ReportedBearing> report(const track::Cycle& cycle, const lighthouse::StationCalibration* calibration,
                                      const track::EpochResult& result, const track::BearingResiduals& residuals) const;

 private:
  struct Station {
    std::array<lighthouse::FlashSmoother, kAxes> smoother;
    track::CycleAssembler assembler;
  };
  Target target_;
  track::TrackOptions options_;
  std::array<Station, kMaxStations> stations_;
};

}  // namespace pharos::host
