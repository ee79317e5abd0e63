// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "host/mounting/source_table.hpp"
#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"

namespace {

using pharos::test::require;
using namespace pharos::host;

void check(const std::string& path, SourceKind kind) {
  try {
    SourceTable table(path, kind, {std::nullopt, 10.0});
    while (const auto row = table.next()) {
      require(std::isfinite(row->time_s) && row->pose.is_finite() && row->covariance.allFinite());
      require((row->pose.R * row->pose.R.transpose() - pharos::Matrix3::Identity()).norm() < 1e-9);
      require(row->covariance.diagonal().minCoeff() >= 0.0);
      if (row->second) require(row->second->is_finite());
    }
  } catch (const InputError& error) {
    require(error.what()[0] != '\0');
  }
}

}  // namespace

// Any bytes as a table of each kind of source: an InputError, or rows of valid poses and covariances.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const pharos::test::MemoryFile file(data, size);
  for (const SourceKind kind : {SourceKind::kLighthouse, SourceKind::kTof, SourceKind::kRing2, SourceKind::kSlam}) {
    check(file.path(), kind);
  }
  return 0;
}
