// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/sequence_files.hpp"

#include "host/support/exact_number.hpp"
#include "host/support/fixed_number.hpp"
#include "tools/sim/output_files.hpp"

namespace pharos::sim {

SequenceFiles::SequenceFiles(const std::string& directory, const host::RigFile& rig) : root_(directory) {
  for (const char* side : {"left", "right"}) make_output_folder(root_ / side);
  write_output(root_ / "rig.toml", host::rig_text(rig));
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
  if (!truth_.flush()) refuse_output(root_ / "truth.tum");
}

}  // namespace pharos::sim
