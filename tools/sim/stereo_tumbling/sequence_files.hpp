// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "host/cameras/rig_file.hpp"
#include "host/images/grey_image.hpp"

namespace pharos::sim {

/// The folder of a stereo sequence: left/ and right/, rig.toml, truth.tum.
class SequenceFiles {
 public:
  /// Throws host::InputError where it cannot be made.
  SequenceFiles(const std::string& directory, const host::RigFile& rig);
  /// 8 bits a pixel; `stem` names the pair, side 0 is left.
  void image(const std::string& stem, int side, const host::GreyImage& image) const;
  /// A row of the truth: timestamp tx ty tz qx qy qz qw.
  void truth(double time_s, const Vector3& t_m, const Quaternion& q);
  void finish();

 private:
  std::filesystem::path root_;
  std::ofstream truth_;
};

}  // namespace pharos::sim
