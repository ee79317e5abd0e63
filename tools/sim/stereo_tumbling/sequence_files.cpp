// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/sequence_files.hpp"

#include "host/support/exact_number.hpp"
#include "host/support/fixed_number.hpp"
#include "host/support/input_error.hpp"

namespace pharos::sim {

SequenceFiles::SequenceFiles(const std::string& directory, const host::RigFile& rig) : root_(directory) {
  for (const char* side : {"left", "right"}) {
    std::error_code error;
    std::filesystem::create_directories(root_ / side, error);
    if (error) throw host::InputError((root_ / side).string() + ": cannot be made: " + error.message());
  }
  std::ofstream rig_file(root_ / "rig.toml");
  if (!(rig_file << host::rig_text(rig)).flush()) {
    throw host::InputError((root_ / "rig.toml").string() + ": cannot be written");
  }
}

void SequenceFiles::image(const std::string& stem, int side, const host::GreyImage& image) const {
  host::write_grey_png((root_ / (side == 0 ? "left" : "right") / (stem + ".png")).string(), image.view(), 8);
}

void SequenceFiles::truth(double time_s, const Vector3& t_m, const Quaternion& q) {
  if (!truth_.is_open()) truth_.open(root_ / "truth.tum");
  truth_ << host::fixed_number(time_s);
  for (const double value : {t_m.x(), t_m.y(), t_m.z(), q.x(), q.y(), q.z(), q.w()}) {
    truth_ << ' ' << host::exact_number(value);
  }
  truth_ << '\n';
}

void SequenceFiles::finish() {
  if (!truth_.flush()) throw host::InputError((root_ / "truth.tum").string() + ": cannot be written");
}

}  // namespace pharos::sim
