// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/station_watch.hpp"

namespace pharos::network {
namespace {

// Sweeps in a row that exclude a station while another one fits, and that readmit it.
constexpr int kForExclusion = 25, kForReadmission = 50;
// How often more than not in favour a station is excluded that contradicts all others. Until then contradictions in so
// many checks end the answers.
constexpr int kDissents = 6, kContradictions = 10, kContradictionWeight = 3;

}  // namespace

// Where one other fits, that one may be the one that is wrong.
void StationWatch::watch(std::size_t station, bool fits, double time_s, NetworkCounters& counters) {
  Record& own = records_[station];
  bool& excluded = excluded_[station];
  own.refused = fits ? 0 : own.refused + 1;
  own.accepted = fits ? own.accepted + 1 : 0;
  int fitting = 0;
  for (std::size_t s = 0; s < records_.size(); ++s) {
    const Record& other = records_[s];
    const bool fresh = other.accepted >= kForExclusion && other.seen.within(kFresh_s, time_s);
    fitting += s != station && !excluded_[s] && fresh ? 1 : 0;
  }
  if (!excluded && own.refused >= kForExclusion && fitting > 0) {
    (fitting > 1 ? excluded : own.disputed) = true;
    if (fitting > 1) ++counters.exclusions;
  } else if (excluded && own.accepted >= kForReadmission) {
    excluded = false;
    ++counters.readmissions;
  }
  if (excluded || own.accepted >= kForReadmission) own.disputed = false;
  if (fits) own.seen.set(time_s);
}

void StationWatch::take(const Consensus& consensus, NetworkCounters& counters) {
  contradictions_ =
      std::clamp(contradictions_ + (consensus.contradiction ? kContradictionWeight : -1), 0, kContradictions);
  if (contradictions_ == kContradictions) too_contradictory_ = true;
  if (contradictions_ == 0) too_contradictory_ = false;
  for (std::size_t s = 0; s < records_.size(); ++s) {
    Record& station = records_[s];
    station.dissents = consensus.dissenting == s ? station.dissents + 1 : std::max(0, station.dissents - 1);
    if (excluded_[s] || station.dissents < kDissents) continue;
    excluded_[s] = true;
    station.disputed = false;
    station.dissents = station.accepted = 0;
    contradictions_ = 0;
    too_contradictory_ = false;
    ++counters.exclusions;
  }
}

void StationWatch::begin() {
  for (Record& station : records_) station.refused = station.accepted = 0;
}

bool StationWatch::disputed() const {
  return std::any_of(records_.begin(), records_.end(), [](const Record& station) { return station.disputed; });
}

int StationWatch::fresh(double time_s) const {
  int fresh = 0;
  for (std::size_t s = 0; s < records_.size(); ++s) {
    if (!excluded_[s] && records_[s].seen.within(kFresh_s, time_s)) ++fresh;
  }
  return fresh;
}

}  // namespace pharos::network
