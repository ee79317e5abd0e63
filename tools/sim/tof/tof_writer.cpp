// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/tof_writer.hpp"

#include <string>
#include <vector>

#include "host/cameras/camera_file.hpp"
#include "host/images/grey_image.hpp"
#include "tools/sim/output_files.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;

std::string camera_of(const TofScenario& scenario, const RawCoordinates& raw) {
  host::CameraFile file;
  file.camera.intrinsics = optics_as<PinholeCamera>(scenario.lens);
  file.camera.depth_scale_m = scenario.depth.scale_m;
  file.camera.depth_origin_z_m = scenario.depth.origin_z_m;
  file.camera.scale_m = raw.scale_m;
  file.camera.offset_m = raw.offset_m;
  return host::camera_text(file);
}

class TruthTable {
 public:
  explicit TruthTable(const fs::path& path)
      : file_(path, {"frame", "time_s", "qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m", "alpha_deg", "beta_deg",
                     "gamma_deg"}) {}

  void add(const std::string& number, const TofTruth& truth) {
    const Quaternion q = truth.T_camera_target.quaternion();
    const Vector3& t = truth.T_camera_target.t;
    host::RowWriter& rows = file_.rows();
    rows.text(number).number(truth.time_s).number(q.w()).number(q.x()).number(q.y()).number(q.z());
    rows.number(t.x()).number(t.y()).number(t.z());
    rows.number(truth.angles.alpha_deg).number(truth.angles.beta_deg).number(truth.angles.gamma_deg);
    rows.end_row();
  }
  void finish() { file_.rows().flush(); }

 private:
  TableFile file_;
};

}  // namespace

void write_tof_camera(const TofScenario& scenario, const fs::path& directory) {
  write_output(directory / "camera.toml", camera_of(scenario, RawCoordinates{}));
}

void write_tof_frame(TofSimulator& simulator, int frame, const std::string& name, const fs::path& directory) {
  const TofScenario& scenario = simulator.scenario();
  const TofPixels pixels = simulator.pixels(frame);
  if (scenario.write_abcy16) {
    const std::vector<std::uint8_t> bytes = abcy16_of(pixels, simulator.rays(), scenario.depth, RawCoordinates{});
    write_output(directory / (name + "_abcy16.raw"), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return;
  }
  host::write_grey_png(directory / (name + "_intensity.png"),
                       {pixels.intensity.data(), pixels.width_px, pixels.height_px});
  host::write_grey_png(directory / (name + "_depth.png"), {pixels.depth.data(), pixels.width_px, pixels.height_px});
}

void write_tof_frames(TofSimulator& simulator, const fs::path& directory, const std::function<void()>& written) {
  make_output_folder(directory);
  write_tof_camera(simulator.scenario(), directory);
  TruthTable truth(directory / "truth.csv");
  for (int frame = 0; frame < simulator.frames(); ++frame) {
    const std::string number =
        file_number(static_cast<std::size_t>(frame), static_cast<std::size_t>(simulator.frames()));
    write_tof_frame(simulator, frame, number, directory);
    truth.add(number, simulator.truth(frame));
    written();
  }
  truth.finish();
}

}  // namespace pharos::sim
