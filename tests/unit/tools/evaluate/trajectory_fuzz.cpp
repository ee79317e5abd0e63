// SPDX-License-Identifier: Apache-2.0
// Any bytes as a trajectory: an InputError, or poses in the order of time with rotations, every row counted once.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

#include "host/support/input_error.hpp"
#include "tools/evaluate/trajectory_file.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

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
  const int fd = memfd_create("fuzz", 0);
  require(::write(fd, data, size) == static_cast<ssize_t>(size));
  try {
    check("/proc/self/fd/" + std::to_string(fd));
  } catch (const pharos::host::InputError& error) {
    require(error.what()[0] != '\0');
  }
  ::close(fd);
  return 0;
}
