// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/recordings.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <tuple>

#include "host/table/edges_reader.hpp"
#include "host/table/target_file.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"
#include "pharos/lighthouse/bearing.hpp"
#include "pharos/lighthouse/ootx_fields.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "tools/evaluation/reproduce/lighthouse/pose_spread.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/recording.hpp"
#include "tools/support/residual_table.hpp"
#include "tools/support/stations.hpp"
#include "tools/support/words.hpp"

namespace pharos::tools {
namespace {

// A payload with the number of times that it must be received. The calibration is identified by its bytes except
// acceleration and unlock count, which change between recordings.
struct ExpectedPayload {
  const char* id;
  const char* hex;
  int at_least;
};

struct RecordingCase {
  const char* name;
  std::array<ExpectedPayload, 2> payloads;
  const char* still_sd = "";  // required of a stationary sensor, arcsec; empty: no requirement, or it moves
  bool still = false;
  bool rigid = false;  // there is a requirement for the rigid-body residual
};

constexpr const char* kBEC08E38 = "063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100";
constexpr const char* kC33B4DE1 = "063de14d3bc3002beb2b2e9dea202b09f89c39a0007f04f3ad48ba30a1b9a00200";
constexpr const char* kF77E21F3 = "066df3217ef7d9257327d7a005a00209bd1835180a7f073e3fb5bc472549a20100";
constexpr const char* k0AA54F65 = "066d654fa50a812bf52b801533050409d397669b007f02c8412526d81c1d9c0000";

// Counts: the recordings' README. Sigmas: the requirement (a plain decoder reaches 8.8-9.2 and 5.8-6.3).
const std::array<RecordingCase, 4> kCases = {{
    {"hmd_static", {{{"BEC08E38", kBEC08E38, 5}, {"C33B4DE1", kC33B4DE1, 5}}}, "<= 9.2", true, true},
    {"controller_quick", {{{"BEC08E38", kBEC08E38, 16}, {"C33B4DE1", kC33B4DE1, 16}}}, "", false, false},
    {"two_bodies_hmd", {{{"F77E21F3", kF77E21F3, 4}, {"0AA54F65", k0AA54F65, 4}}}, "", true, true},
    {"two_bodies_controller", {{{"F77E21F3", kF77E21F3, 3}, {"0AA54F65", k0AA54F65, 5}}}, "<= 6.3", true, false},
}};

constexpr double kSmoothingAsked = 0.85;  // smoothed over raw deviation, at most

using Rotor = std::tuple<std::uint8_t, Axis>;
using Series = std::tuple<std::uint8_t, Axis, std::uint8_t>;  // station, axis, sensor

// Everything that is measured in one pass over a recording.
struct Decoded {
  std::vector<std::string> payloads;
  std::vector<lighthouse::Sweep> sweeps;
  std::optional<double> first_angle_s;
  std::map<Series, RunningMoments> raw;
  std::map<Series, RunningMoments> smoothed;
};

// Bearings of sensors hit once, because the angle of a reflection is not noise.
void push_single(const lighthouse::Sweep& sweep, const lighthouse::SweepBearings& bearings,
                 std::map<Series, RunningMoments>& series) {
  std::array<int, 256> hits{};
  for (const lighthouse::Bearing& bearing : bearings) ++hits[bearing.sensor];
  for (const lighthouse::Bearing& bearing : bearings) {
    if (hits[bearing.sensor] != 1) continue;
    series[{sweep.flash.station, sweep.flash.axis, bearing.sensor}].push(bearing.theta_rad);
  }
}

Decoded decode(const std::string& path) {
  Decoded out;
  Recording recording(path);
  std::map<Rotor, lighthouse::FlashSmoother> smoothers;
  while (const std::optional<RecordingEvent> event = recording.next()) {
    if (const auto* payload = std::get_if<lighthouse::OotxPayload>(&*event)) {
      out.payloads.push_back(hex_text({payload->bytes.data(), payload->bytes.size()}));
    } else if (const auto* sweep = std::get_if<lighthouse::Sweep>(&*event)) {
      const auto bearings = lighthouse::bearings_of(*sweep);
      if (!out.first_angle_s && !bearings.empty()) out.first_angle_s = ticks_to_seconds(bearings[0].time_ticks);
      push_single(*sweep, bearings, out.raw);
      const auto smoothed = smoothers[{sweep->flash.station, sweep->flash.axis}].push(*sweep);
      push_single(*sweep, lighthouse::bearings_of(*sweep, smoothed), out.smoothed);
      out.sweeps.push_back(*sweep);
    }
  }
  return out;
}

// Earliest time of an angle: the first pulse with a laser's width after the first one with a flash's length.
std::optional<double> first_light_s(const std::string& path) {
  constexpr std::int64_t kShortestFlash = 2900, kLongestFlash = 7100;  // ticks; nominal 3125 to 6771, real ones 3 % off
  constexpr std::int64_t kShortestHit = 28, kLongestHit = 1400;        // ticks; 27 to 1326 were measured at 48 MHz
  host::EdgesReader reader{host::ByteSource(path)};
  bool flashed = false;
  while (const auto pulse = reader.next()) {
    const std::int64_t length = pulse->fall_ticks - pulse->rise_ticks;
    if (length >= kShortestFlash && length <= kLongestFlash) flashed = true;
    if (flashed && length >= kShortestHit && length <= kLongestHit) return ticks_to_seconds(pulse->rise_ticks);
  }
  return std::nullopt;
}

bool same_calibration(std::string a, std::string b) {
  // Byte 14 is the unlock count, bytes 20 to 22 are the acceleration.
  constexpr std::array kChanging = {14u, 20u, 21u, 22u};
  if (a.size() != b.size()) return false;
  for (const std::size_t byte : kChanging) {
    for (const std::size_t digit : {2 * byte, 2 * byte + 1}) {
      if (digit < a.size()) a[digit] = b[digit] = '0';
    }
  }
  return a == b;
}

void add_ootx_rows(const RecordingCase& c, const Decoded& decoded, const std::string& file,
                   std::vector<ComparisonRow>& rows) {
  std::size_t known = 0;
  for (const ExpectedPayload& expected : c.payloads) {
    int count = 0;
    for (const std::string& payload : decoded.payloads) count += same_calibration(payload, expected.hex) ? 1 : 0;
    known += static_cast<std::size_t>(count);
    rows.push_back({c.name, std::string("OOTX payloads of ") + expected.id, "",
                    ">= " + std::to_string(expected.at_least), static_cast<double>(count),
                    "pharos decode " + file + " --ootx"});
  }
  rows.push_back({c.name, "false OOTX payloads", "", "<= 0", static_cast<double>(decoded.payloads.size() - known), ""});
}

void add_lock_row(const RecordingCase& c, const Decoded& decoded, const std::string& path, const std::string& file,
                  std::vector<ComparisonRow>& rows) {
  const std::optional<double> light_s = first_light_s(path);
  if (!light_s || !decoded.first_angle_s) return;
  rows.push_back({c.name, "first angle after the first flash and laser hit", "s", "<= 0.15",
                  *decoded.first_angle_s - *light_s, "pharos decode " + file});
}

double median_deviation_arcsec(const std::map<Series, RunningMoments>& series) {
  constexpr std::int64_t kMinHits = 100;
  std::vector<double> deviations;
  for (const auto& [key, moments] : series) {
    if (moments.count() >= kMinHits) deviations.push_back(*moments.deviation() * kArcsecPerRad);
  }
  return deviations.empty() ? std::numeric_limits<double>::infinity() : median_of(deviations);
}

void add_noise_rows(const RecordingCase& c, const Decoded& decoded, const std::string& file,
                    std::vector<ComparisonRow>& rows) {
  if (!c.still) return;
  const double raw = median_deviation_arcsec(decoded.raw);
  const double smoothed = median_deviation_arcsec(decoded.smoothed);
  rows.push_back({c.name, "still sensor: sigma of one sweep (median over sensors)", "arcsec", c.still_sd, raw,
                  "pharos decode " + file});
  const bool asked = c.still_sd[0] != '\0';
  rows.push_back(
      {c.name, "the same smoothed by earlier flashes", "arcsec", "", smoothed, "pharos decode " + file + " --smooth"});
  std::array<char, 16> bound;
  std::snprintf(bound.data(), bound.size(), "<= %.2f", kSmoothingAsked);
  rows.push_back({c.name, "smoothed / raw", "", asked ? bound.data() : "", smoothed / raw, ""});
}

// Rigid-body residual on one station.
struct Rigidity {
  std::vector<double> rms_arcsec;
  std::vector<double> reduced_chi2;
  std::size_t refused = 0;
};

void add_rigidity_rows(const RecordingCase& c, const Decoded& decoded, const std::string& path, const std::string& file,
                       std::vector<ComparisonRow>& rows) {
  if (!c.still) return;
  const std::string target_file = file.substr(0, file.find(".edges")) + ".target.csv";
  const host::TargetFile target = host::read_target(path.substr(0, path.find(".edges")) + ".target.csv");
  const track::TrackOptions options;
  const auto tracker = std::make_unique<track::EpochTracker>(target.target, options);
  const Stations stations = read_ahead(path);
  for (std::uint8_t s = 0; s < kMaxStations; ++s) {
    if (stations.calibration(s) != nullptr) tracker->set_calibration(s, *stations.calibration(s));
  }
  std::array<Rigidity, kMaxStations> left;
  const auto take = [&](const track::EpochResult& result) {
    Rigidity& here = left[result.station];
    constexpr int kPoseUnknowns = 6;
    if (!result.pose || result.observations <= kPoseUnknowns) {
      ++here.refused;
      return;
    }
    const double rms = result.pose->residual_rms;
    const double in_sigmas = rms / options.solve.sigma_rad;
    here.rms_arcsec.push_back(rms * kArcsecPerRad);
    here.reduced_chi2.push_back(in_sigmas * in_sigmas * result.observations / (result.observations - kPoseUnknowns));
  };
  for (const lighthouse::Sweep& sweep : decoded.sweeps) {
    if (const auto result = tracker->push(sweep)) take(*result);
  }
  while (const auto result = tracker->flush()) take(*result);
  double best = std::numeric_limits<double>::infinity();
  for (const Rigidity& here : left) {
    if (!here.rms_arcsec.empty()) best = std::min(best, median_of(here.rms_arcsec));
  }
  for (std::uint8_t s = 0; s < kMaxStations; ++s) {
    const Rigidity& here = left[s];
    if (here.rms_arcsec.empty()) continue;
    const double rms = median_of(here.rms_arcsec);
    const std::string name = "station " + station_id_text(stations.id(s));
    rows.push_back({c.name, "rigid-body residual RMS (median of cycles) " + name, "arcsec",
                    c.rigid && rms == best ? "<= 10" : "", rms,
                    "pharos track " + file + " --target " + target_file + " --sensors FILE"});
    rows.push_back({c.name, "residual chi2 per degree of freedom at 8.8 arcsec (median) " + name, "", "",
                    median_of(here.reduced_chi2), ""});
    rows.push_back({c.name, "cycles refused " + name, "", "", static_cast<double>(here.refused),
                    "of " + std::to_string(here.refused + here.rms_arcsec.size())});
  }
}

}  // namespace

std::vector<ComparisonRow> measure_recordings(const std::string& directory) {
  std::vector<ComparisonRow> rows;
  Progress progress("recordings", "recordings", kCases.size());
  for (const RecordingCase& c : kCases) {
    const std::string file = std::string(c.name) + ".edges.csv.gz";
    const std::string path = directory + "/" + file;
    const Decoded decoded = decode(path);
    add_ootx_rows(c, decoded, file, rows);
    add_lock_row(c, decoded, path, file, rows);
    add_noise_rows(c, decoded, file, rows);
    add_rigidity_rows(c, decoded, path, file, rows);
    progress.step();
  }
  return rows;
}

}  // namespace pharos::tools
