// SPDX-License-Identifier: Apache-2.0
// Any bytes as a trajectory: an InputError, or poses in the order of time with rotations, every row counted once.
#include <cstdint>

#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"
#include "tools/evaluate/trajectory_file.hpp"

namespace {

using pharos::test::MemoryFile;
using pharos::test::require;

void check(const std::string& path) {
  using namespace pharos::evaluate;
  const auto file = read_trajectory<EstimatePose>(path, {});
  require(file.rows == file.samples.size() + file.refused + file.ambiguous + file.flagged);
  for (std::size_t i = 0; i < file.samples.size(); ++i) {
    const auto& pose = file.samples[i].pose;
    require(pose.is_finite() && (pose.R * pose.R.transpose() - pharos::Matrix3::Identity()).norm() < 1e-9);
    require(i == 0 || file.samples[i].time_s > file.samples[i - 1].time_s);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  try {
    check(file.path());
  } catch (const pharos::host::InputError& error) {
    require(error.what()[0] != '\0');
  }
  return 0;
}
