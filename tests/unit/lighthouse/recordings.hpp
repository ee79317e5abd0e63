// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "host/table/edges_reader.hpp"

namespace pharos::test {

/// Folder of the real recordings: $PHAROS_DATA/lighthouse, by default ../shared/data beside the repository.
inline std::filesystem::path recordings() {
  const char* data = std::getenv("PHAROS_DATA");
  const auto source = std::filesystem::path(__FILE__).parent_path() / "../../..";
  return (data != nullptr ? std::filesystem::path(data) : source / "../shared/data") / "lighthouse";
}

inline std::vector<lighthouse::RawPulse> recorded_pulses(const std::string& name) {
  host::EdgesReader reader(host::ByteSource((recordings() / (name + ".edges.csv.gz")).string()));
  std::vector<lighthouse::RawPulse> pulses;
  while (const auto pulse = reader.next()) pulses.push_back(*pulse);
  return pulses;
}

}  // namespace pharos::test

/// Leaves the test with a clear word where the recordings are not at hand.
#define PHAROS_NEEDS_RECORDINGS()                                                              \
  if (!std::filesystem::exists(pharos::test::recordings()))                                    \
  GTEST_SKIP() << "no recordings at " << pharos::test::recordings() << ": set PHAROS_DATA to " \
               << "the folder that holds lighthouse/"
