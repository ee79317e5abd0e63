// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/cli/example_recording.hpp"

#include <array>
#include <memory>

#include "host/table/byte_source.hpp"
#include "host/table/target_file.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/sim/recording_writer.hpp"

namespace pharos::cli_test {

ExampleRecording::ExampleRecording() {
  target_ = host::read_target(folder_.write("solid.csv", solid_target_csv())).target;
  const Quaternion half_turn_and_more(0.05, 0.95, 0.25, -0.1);
  truth_ = {half_turn_and_more.normalized().toRotationMatrix(), {0.3, -0.2, 1.8}};

  sim::LighthouseScenario scenario;
  scenario.duration_s = 12.0;
  scenario.target = target_;
  scenario.noise = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  scenario.rotor.wander_ticks = 0.0;
  scenario.rotor.turn_jitter_ticks = 0.0;
  scenario.stations.emplace_back();
  sim::SheetErrors errors;
  errors.phase_rad = 0.03;
  errors.tilt_rad = 0.002;
  errors.curve_rad = -0.002;
  errors.gibbous_phase_rad = 1.0;
  errors.gibbous_magnitude_rad = 0.004;
  scenario.stations.front().calibration = std::array{errors, errors};
  const sim::RoomFromBody pose{truth_.R, truth_.t};
  scenario.trajectory = std::make_shared<sim::StationaryTrajectory>(std::vector{pose}, 2.0 * scenario.duration_s, 0.0);
  sim::write_recording(scenario, 1, folder_.path(""));
}

const ExampleRecording& ExampleRecording::get() {
  static const ExampleRecording recording;
  return recording;
}

std::string ExampleRecording::edges_text() const {
  host::ByteSource source(edges());
  std::string text;
  std::array<char, 65536> piece;
  while (const std::size_t got = source.read(piece)) text.append(piece.data(), got);
  return text;
}

std::string solid_target_csv() {
  return "sensor,x_m,y_m,z_m,nx,ny,nz\n"
         "0,-0.025,-0.025,0.0625,0,0,1\n"
         "1,-0.025,0.025,0.0625,0,0,1\n"
         "2,0.025,-0.025,0.0625,0,0,1\n"
         "3,0.025,0.025,0.0625,0,0,1\n"
         "4,0.055,0.035,0.015,0.894427191,0,0.447213595\n"
         "5,0.04,-0.015,0.045,0.894427191,0,0.447213595\n"
         "6,-0.035,0.055,0.015,0,0.894427191,0.447213595\n"
         "7,0.015,0.04,0.045,0,0.894427191,0.447213595\n"
         "8,-0.055,-0.035,0.015,-0.894427191,0,0.447213595\n"
         "9,-0.04,0.015,0.045,-0.894427191,0,0.447213595\n"
         "10,0.035,-0.055,0.015,0,-0.894427191,0.447213595\n"
         "11,-0.015,-0.04,0.045,0,-0.894427191,0.447213595\n";
}

std::string plane_target_csv() {
  return "sensor,x_m,y_m,z_m\n0,-0.025,-0.025,0.0625\n1,-0.025,0.025,0.0625\n2,0.025,-0.025,0.0625\n3,0.025,0.025,"
         "0.0625\n";
}

}  // namespace pharos::cli_test
