// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/table/edges_reader.hpp"
#include "support/real_data.hpp"

namespace pharos::test {

/// Folder of the real recordings of base stations.
inline std::filesystem::path recordings() { return real_data("lighthouse"); }

inline std::vector<lighthouse::RawPulse> recorded_pulses(const std::string& name) {
  host::EdgesReader reader(host::ByteSource((recordings() / (name + ".edges.csv.gz")).string()));
  std::vector<lighthouse::RawPulse> pulses;
  while (const auto pulse = reader.next()) pulses.push_back(*pulse);
  return pulses;
}

}  // namespace pharos::test

#define PHAROS_NEEDS_RECORDINGS() PHAROS_NEEDS_DATA("lighthouse")
