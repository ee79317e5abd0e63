// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/tof_writer.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "host/cameras/camera_file.hpp"
#include "host/images/grey_image.hpp"
#include "host/support/input_error.hpp"
#include "tools/sim/table_file.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;

template <typename Bytes>
void write_bytes(const fs::path& path, const Bytes& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())).flush();
  if (!out) refuse_output(path);
}

// Four digits, more where there are more frames: names sort as the frames follow each other.
std::string number_of(int frame, int frames) {
  const std::size_t width = std::max<std::size_t>(4, std::to_string(frames - 1).size());
  const std::string digits = std::to_string(frame);
  return std::string(width - digits.size(), '0') + digits;
}

std::string camera_of(const TofScenario& scenario, const RawCoordinates& raw) {
  host::CameraFile file;
  const LensModel& lens = scenario.lens;
  file.camera.intrinsics.width_px = lens.width_px;
  file.camera.intrinsics.height_px = lens.height_px;
  file.camera.intrinsics.fx_px = lens.fx_px;
  file.camera.intrinsics.fy_px = lens.fy_px;
  file.camera.intrinsics.cx_px = lens.cx_px;
  file.camera.intrinsics.cy_px = lens.cy_px;
  file.camera.intrinsics.distortion = lens.distortion;
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

void write_tof_frames(TofSimulator& simulator, const fs::path& directory, const std::function<void()>& written) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) {
    throw host::InputError(directory.string() + ": cannot be made: " + error.message() + "; choose another --output");
  }
  const TofScenario& scenario = simulator.scenario();
  const RawCoordinates raw;
  write_bytes(directory / "camera.toml", camera_of(scenario, raw));
  TruthTable truth(directory / "truth.csv");
  for (int frame = 0; frame < simulator.frames(); ++frame) {
    const std::string number = number_of(frame, simulator.frames());
    const TofPixels pixels = simulator.pixels(frame);
    if (scenario.write_abcy16) {
      write_bytes(directory / (number + "_abcy16.raw"), abcy16_of(pixels, simulator.lens(), scenario.depth, raw));
    } else {
      host::write_grey_png(directory / (number + "_intensity.png"),
                           {pixels.intensity.data(), pixels.width_px, pixels.height_px});
      host::write_grey_png(directory / (number + "_depth.png"),
                           {pixels.depth.data(), pixels.width_px, pixels.height_px});
    }
    truth.add(number, simulator.truth(frame));
    written();
  }
  truth.finish();
}

}  // namespace pharos::sim
