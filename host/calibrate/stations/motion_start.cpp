// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/motion_start.hpp"

#include <algorithm>
#include <memory>

#include "pharos/network/network_tracker.hpp"

namespace pharos::calibrate {
namespace {

using network::WorldFromBody;

// Short pieces: one that does not fit is left out without much that does.
constexpr double kMinPiece_s = 0.3, kMaxPiece_s = 1.0, kGap_s = 0.15;
// Between control points: a hand moves by less than a millimetre otherwise within it.
constexpr double kStep_s = 0.04;
constexpr double kStart_m = 0.3;  // a start for an adjustment may be known less well than an answer
// The adjustment does not get out of a flat target's mirrored attitude: one that may be it is no start.
constexpr double kStart_rad = 0.5;

struct Tracked {
  double time_s = 0.0;
  WorldFromBody pose;
};

WorldFromBody between(const std::vector<Tracked>& poses, double time_s) {
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), time_s, [](const Tracked& p, double t) { return p.time_s < t; });
  if (after == poses.begin()) return poses.front().pose;
  if (after == poses.end()) return poses.back().pose;
  const Tracked& a = *(after - 1);
  const double part = (time_s - a.time_s) / std::max(1e-9, after->time_s - a.time_s);
  return {rotation_exp(part * rotation_log(after->pose.R * a.pose.R.transpose())) * a.pose.R,
          a.pose.t + part * (after->pose.t - a.pose.t)};
}

}  // namespace

double TrackedMotion::seconds() const {
  double sum_s = 0.0;
  for (const BodySpline& piece : pieces) sum_s += piece.end_s() - piece.begin_s();
  return sum_s;
}

TrackedMotion track_motion(const std::vector<network::PlaneSweep>& sweeps, const network::Stations& stations,
                           const Target& target, const network::StationSigmas& unstated) {
  network::NetworkOptions options;
  options.max_position_m = kStart_m;
  options.max_rotation_rad = kStart_rad;
  options.noise.unstated = unstated;
  options.noise.model_rad = 0.0;  // of the adjustment that follows, not of a start for it
  network::Stations uncertain = stations;
  for (network::Station& station : uncertain) station.sigmas.reset();
  const auto tracker = std::make_unique<network::NetworkTracker>(uncertain, target, options);
  TrackedMotion out;
  std::vector<Tracked> piece;
  const auto end_piece = [&] {
    if (!piece.empty() && piece.back().time_s - piece.front().time_s >= kMinPiece_s) {
      out.pieces.emplace_back(piece.front().time_s, piece.back().time_s, kStep_s,
                              [&](double time_s) { return between(piece, time_s); });
    }
    piece.clear();
  };
  const auto take = [&](const std::optional<network::NetworkResult>& result) {
    if (!result || !result->pose.ok()) return;
    const double time_s = result->time_s;
    if (!piece.empty() && time_s <= piece.back().time_s) return;  // sweeps of two stations overlap
    const bool gap = !piece.empty() && time_s - piece.back().time_s > kGap_s;
    if (gap || (!piece.empty() && time_s - piece.front().time_s > kMaxPiece_s)) end_piece();
    piece.push_back({time_s, result->pose.value()});
  };
  for (const network::PlaneSweep& sweep : sweeps) {
    for (const network::Hit& hit : sweep.hits) take(tracker->push(stations[sweep.station].number, sweep.plane, hit));
  }
  while (const auto last = tracker->flush()) take(last);
  end_piece();
  return out;
}

}  // namespace pharos::calibrate
