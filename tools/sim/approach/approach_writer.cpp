// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/approach_writer.hpp"

#include "host/mounting/mounting_file.hpp"
#include "tools/sim/output_files.hpp"

namespace pharos::sim {
namespace {

void write_truth(const ApproachSimulator& simulator, double start_s, const std::filesystem::path& path) {
  TableFile file(path, {"time_s", "qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m", "vx_m_s", "vy_m_s", "vz_m_s",
                        "wx_rad_s", "wy_rad_s", "wz_rad_s"});
  const double step_s = simulator.scenario().truth_step_s;
  const auto count = static_cast<std::int64_t>(simulator.scenario().motion.duration_s / step_s);
  for (std::int64_t i = 0; i <= count; ++i) {
    const double time_s = static_cast<double>(i) * step_s;
    const host::VehicleFromTarget pose = simulator.truth().at(time_s);
    const ApproachTruth::Rates rates = simulator.truth().rates(time_s);
    const Quaternion q = pose.quaternion();
    host::RowWriter& rows = file.rows();
    rows.number(start_s + time_s).number(q.w()).number(q.x()).number(q.y()).number(q.z());
    for (const Vector3& v : {pose.t, rates.velocity_m_s, rates.rate_rad_s}) {
      rows.number(v.x()).number(v.y()).number(v.z());
    }
    rows.end_row();
  }
  file.rows().flush();
}

void write_faults(const ApproachSimulator& simulator, double start_s, const std::filesystem::path& path) {
  TableFile file(path, {"time_s", "end_s", "source", "kind", "amount"});
  for (const DrawnFault& fault : simulator.faults()) {
    file.rows().number(start_s + fault.from_s).number(start_s + fault.to_s);
    file.rows().text(simulator.scenario().sources[fault.source].name);
    file.rows().text(word_of(fault.kind)).number(fault.amount).end_row();
  }
  file.rows().flush();
}

std::vector<ApproachMeasurement> measured(const ApproachSimulator& simulator, std::size_t source, double start_s) {
  std::vector<ApproachMeasurement> out = simulator.measure(source);
  for (ApproachMeasurement& m : out) {
    m.time_s += start_s;
    m.arrival_s += start_s;
  }
  return out;
}

// The slow errors are those of the simulated measurements; those of raw data come from what estimates them.
host::Mounting without_slow_errors(host::Mounting mounting, const ApproachOutput& output) {
  for (std::size_t i = 0; i < mounting.sources.size(); ++i) {
    if (output.is_raw(i)) mounting.sources[i].slow_error.reset();
  }
  return mounting;
}

}  // namespace

ApproachSummary write_approach(const ApproachSimulator& simulator, const std::filesystem::path& folder,
                               const ApproachOutput& output) {
  make_output_folder(folder);
  ApproachSummary summary;
  for (std::size_t i = 0; i < simulator.scenario().sources.size(); ++i) {
    const ApproachSource& source = simulator.scenario().sources[i];
    std::vector<ApproachMeasurement> measurements;
    if (!output.is_raw(i)) {
      measurements = measured(simulator, i, output.start_s);
      write_source_table(folder / (source.name + ".csv"), source.kind, measurements);
    }
    std::size_t seen = 0;
    for (const ApproachMeasurement& m : measurements) seen += m.seen ? 1 : 0;
    summary.seen.push_back(seen);
    summary.refused.push_back(measurements.size() - seen);
  }
  write_truth(simulator, output.start_s, folder / "truth.csv");
  write_faults(simulator, output.start_s, folder / "faults.csv");
  host::write_mounting_file((folder / "mounting.toml").string(),
                            without_slow_errors(simulator.calibrated_mounting(), output));
  host::write_mounting_file((folder / "mounting_true.toml").string(),
                            without_slow_errors(simulator.true_mounting(), output));
  return summary;
}

}  // namespace pharos::sim
