// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/converted_folder.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "host/files/atomic_file.hpp"
#include "host/stations/network_file.hpp"
#include "host/support/input_error.hpp"
#include "host/table/row_writer.hpp"

namespace pharos::convert {
namespace {

using host::RowWriter;

void write_table(const std::string& path, std::vector<std::string> columns,
                 const std::function<void(RowWriter&)>& write_rows) {
  host::AtomicFile file(path);
  {
    RowWriter rows(file.stream(), host::RowFormat::kCsv, std::move(columns));
    write_rows(rows);
    rows.flush();
  }
  file.commit();
}

std::string id_text(std::uint32_t id) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%08X", static_cast<unsigned>(id));
  return text.data();
}

const char* axis_name(int generation, std::uint8_t plane) {
  if (generation == 1) return plane == 0 ? "x" : "y";
  return plane == 0 ? "a" : "b";
}

void write_vector(RowWriter& rows, const Vector3& v) {
  for (int k = 0; k < 3; ++k) rows.number(v[k]);
}

void write_sweeps(RowWriter& rows, const ConvertedLog& log) {
  for (const LightHit& hit : log.hits) {
    const network::Station* station = network::find_station(log.stations, hit.station);
    rows.number(hit.time_s)
        .integer(hit.station)
        .text(station != nullptr && station->id != 0 ? id_text(station->id) : "");
    rows.text(axis_name(log.generation, hit.plane)).integer(hit.sensor).number(hit.theta_rad);
    rows.none().none().integer(log.generation).end_row();
  }
}

}  // namespace

void write_folder(const std::string& folder, const ConvertedLog& log) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) throw host::InputError(folder + ": the folder cannot be made");
  const std::string in = folder + "/";
  write_table(in + "sweeps.csv",
              {"time_s", "station", "station_id", "axis", "sensor", "theta_rad", "width_ticks", "flags", "generation"},
              [&](RowWriter& rows) { write_sweeps(rows, log); });
  host::write_file(in + "stations.toml", host::network_text(log.stations));
  write_table(in + "target.csv", {"sensor", "x_m", "y_m", "z_m", "nx", "ny", "nz"}, [&](RowWriter& rows) {
    for (const SensorPlacement& sensor : log.target) {
      rows.integer(sensor.sensor);
      write_vector(rows, sensor.position_m);
      write_vector(rows, sensor.normal);
      rows.end_row();
    }
  });
  if (!log.imu.empty()) {
    write_table(in + "imu.csv",
                {"time_s", "gyro_x_rad_s", "gyro_y_rad_s", "gyro_z_rad_s", "acc_x_m_s2", "acc_y_m_s2", "acc_z_m_s2"},
                [&](RowWriter& rows) {
                  for (const ImuSample& sample : log.imu) {
                    rows.number(sample.time_s);
                    write_vector(rows, sample.gyro_rad_s);
                    write_vector(rows, sample.acceleration_m_s2);
                    rows.end_row();
                  }
                });
  }
  if (!log.crossing_beams.empty()) {
    write_table(in + "crossing_beam.csv", {"time_s", "x_m", "y_m", "z_m", "delta_m"}, [&](RowWriter& rows) {
      for (const CrossingBeam& beam : log.crossing_beams) {
        rows.number(beam.time_s);
        write_vector(rows, beam.position_m);
        rows.number(beam.delta_m).end_row();
      }
    });
  }
  if (!log.events.empty()) {
    write_table(in + "events.csv", {"time_s", "event"}, [&](RowWriter& rows) {
      for (const LogEvent& event : log.events) rows.number(event.time_s).text(event.what).end_row();
    });
  }
  if (!log.external.empty()) {
    write_table(in + "external_pose.csv", {"time_s", "qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"},
                [&](RowWriter& rows) {
                  for (const ExternalPose& pose : log.external) {
                    const Quaternion q = canonical(pose.q);
                    rows.number(pose.time_s);
                    for (const double v : {q.w(), q.x(), q.y(), q.z()}) rows.number(v);
                    write_vector(rows, pose.t);
                    rows.end_row();
                  }
                });
  }
}

}  // namespace pharos::convert
