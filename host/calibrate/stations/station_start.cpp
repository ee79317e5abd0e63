// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/station_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/linear/dense.hpp"
#include "host/support/input_error.hpp"
#include "pharos/network/network_start.hpp"

namespace pharos::calibrate {
namespace {

using network::PlaneSweep;
using network::Stations;
using network::WorldFromStation;

constexpr double kPair_s = 0.03;     // between the two planes of a station
constexpr double kBetween_s = 0.06;  // between two instants of a station to interpolate
constexpr std::size_t kMinCommon = 30;
constexpr double kMinSpread_m = 0.05;  // across the line along which the target was carried, 1 sigma
constexpr double kKept = 0.7;          // of the instants, whose positions agree best
constexpr int kRounds = 10;

struct Seen {
  double time_s = 0.0;
  Vector3 p_station_m = Vector3::Zero();
};

std::vector<Seen> positions_of(const std::vector<PlaneSweep>& sweeps, std::size_t place, network::Station station,
                               const Target& target) {
  station.T_world_station = WorldFromStation{};
  Stations alone;
  alone.push_back(station);
  std::vector<Seen> out;
  const PlaneSweep* before = nullptr;
  for (const PlaneSweep& sweep : sweeps) {
    if (sweep.station != place) continue;
    if (before != nullptr && before->plane != sweep.plane && sweep.time_s() - before->time_s() < kPair_s) {
      std::array<PlaneSweep, 2> both = {*before, sweep};
      network::SweepView pair;
      for (PlaneSweep& one : both) {
        one.station = 0;
        pair.push_back(&one);
      }
      const network::Starts starts = network::starts_of(pair, alone, target);
      if (!starts.empty()) out.push_back({0.5 * (before->time_s() + sweep.time_s()), starts[0].t});
    }
    before = &sweep;
  }
  return out;
}

std::optional<Vector3> position_at(const std::vector<Seen>& seen, double time_s) {
  const auto after =
      std::lower_bound(seen.begin(), seen.end(), time_s, [](const Seen& s, double t) { return s.time_s < t; });
  if (after == seen.begin() || after == seen.end()) return std::nullopt;
  const Seen& a = *(after - 1);
  const double step_s = after->time_s - a.time_s;
  if (step_s > kBetween_s || !(step_s > 0.0)) return std::nullopt;
  return a.p_station_m + (time_s - a.time_s) / step_s * (after->p_station_m - a.p_station_m);
}

struct Common {
  std::vector<Vector3> a, b;
};

Common common_of(const std::vector<Seen>& a, const std::vector<Seen>& b) {
  Common out;
  for (const Seen& one : b) {
    const auto other = position_at(a, one.time_s);
    if (!other) continue;
    out.a.push_back(*other);
    out.b.push_back(one.p_station_m);
  }
  return out;
}

struct Alignment {
  Matrix3 R = Matrix3::Identity();
  Vector3 t = Vector3::Zero();
  double spread_m = 0.0;  // the second of the three
};

// a = R b + t by least squares (Arun, Huang and Blostein 1987) over the pairs of `use`.
Alignment align(const Common& common, const std::vector<std::size_t>& use) {
  const double n = static_cast<double>(use.size());
  Vector3 ca = Vector3::Zero(), cb = Vector3::Zero();
  for (const std::size_t i : use) {
    ca += common.a[i] / n;
    cb += common.b[i] / n;
  }
  Matrix3 H = Matrix3::Zero();
  for (const std::size_t i : use) H += (common.a[i] - ca) * (common.b[i] - cb).transpose() / n;
  const host::NearestRotation turn = host::nearest_rotation(H);
  Alignment out;
  out.R = turn.R;
  out.t = ca - out.R * cb;
  out.spread_m = std::sqrt(turn.singular_values[1]);
  return out;
}

// The worst are left out, as a range that a small target tells may be off by much.
Alignment align_robustly(const Common& common) {
  std::vector<std::size_t> use(common.a.size());
  for (std::size_t i = 0; i < use.size(); ++i) use[i] = i;
  Alignment out = align(common, use);
  for (int round = 0; round < kRounds; ++round) {
    const auto apart = [&](std::size_t i) { return (common.a[i] - out.R * common.b[i] - out.t).norm(); };
    use.resize(common.a.size());
    for (std::size_t i = 0; i < use.size(); ++i) use[i] = i;
    std::sort(use.begin(), use.end(), [&](std::size_t i, std::size_t j) { return apart(i) < apart(j); });
    use.resize(
        std::max<std::size_t>(kMinCommon / 2, static_cast<std::size_t>(kKept * static_cast<double>(use.size()))));
    out = align(common, use);
  }
  return out;
}

}  // namespace

void start_stations(const std::vector<PlaneSweep>& sweeps, const Target& target, const std::string& name,
                    Stations& stations) {
  std::vector<std::vector<Seen>> seen;
  for (std::size_t s = 0; s < stations.size(); ++s) seen.push_back(positions_of(sweeps, s, stations[s], target));
  std::vector<bool> placed(stations.size(), false);
  placed[0] = true;
  if (!stations[0].T_world_station) stations[0].T_world_station = WorldFromStation{};
  for (std::size_t count = 1; count < stations.size(); ++count) {
    Common best;
    std::size_t from = 0, to = 0;
    for (std::size_t a = 0; a < stations.size(); ++a) {
      for (std::size_t b = 0; b < stations.size(); ++b) {
        if (!placed[a] || placed[b]) continue;
        Common common = common_of(seen[a], seen[b]);
        if (to != 0 && common.a.size() <= best.a.size()) continue;
        best = std::move(common);
        from = a;
        to = b;
      }
    }
    const std::string which = "station " + std::to_string(stations[to].number);
    if (best.a.size() < kMinCommon) {
      throw host::InputError(name + ": " + which + " and the others saw the target at once " +
                             std::to_string(best.a.size()) + " times, at least " + std::to_string(kMinCommon) +
                             " are needed: carry it where two stations see it");
    }
    const Alignment found = align_robustly(best);
    if (found.spread_m < kMinSpread_m) {
      throw host::InputError(name + ": the target was hardly moved where " + which +
                             " and another saw it: carry it around in all directions");
    }
    const auto T_world_from = *stations[from].T_world_station;
    stations[to].T_world_station = WorldFromStation{T_world_from.R * found.R, T_world_from * found.t};
    placed[to] = true;
  }
}

}  // namespace pharos::calibrate
