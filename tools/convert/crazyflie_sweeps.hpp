// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "pharos/geometry/target.hpp"
#include "tools/convert/crazyflie_log.hpp"

namespace pharos::convert {

/// Sweeps of a log.
struct CrazyflieSweeps {
  std::vector<LightHit> hits;  // in the order of time
  std::size_t repeated = 0;    // angles logged again, unchanged: left out, but where a light shows that they are new
  std::size_t untimed = 0;     // the decoder board's frames do not tell when they were: left out
  double clock_rate = 1.0;     // seconds of the log's clock a second of the stations' rotors
};

/// Hits from the angles that the firmware logged after each turn of a station, all at once, with those of the other
/// station repeated.
///
/// The log's time of a group is the hit's only up to a delay of milliseconds. LH2: the decoder board's frames tell when
/// each light came (framed_hits). LH1, and LH2 of a log without frames: a rotor turns evenly, so its turns, counted,
/// less the least delays around (lower_envelope) give when each began, and the angle says the rest. LH1: two slots of
/// half a turn before the group, and of two stations each in every second turn; LH2: one turn, whose later plane ended
/// before the group: what was the least delay differs from station to station by some milliseconds. The log's clock may
/// be off by 5 %; the rotors tell by how much.
CrazyflieSweeps sweeps_of(const CrazyflieLog& log, int generation);

/// The lighthouse deck: four sensors in a plane, x ahead, y left, looking up.
Target lighthouse_deck();

/// Nominal time of a rotor's turn, s. `channel` of LH2: 0..15.
double rotor_period_s(int generation, int channel);

}  // namespace pharos::convert
