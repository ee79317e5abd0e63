// SPDX-License-Identifier: Apache-2.0
// Any mounting file with a pose table behind the first line of three equal signs, as pharos fuse reads them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "host/fusion/target_fuser.hpp"
#include "host/mounting/mounting_file.hpp"
#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"

namespace {

using pharos::test::require;
using namespace pharos::host;

void check(const pharos::fusion::TargetState& state) {
  if (!state.valid) return;
  require(state.kinematics.pose.is_finite() && state.covariance.allFinite());
  for (int i = 0; i < 12; ++i) require(state.covariance(i, i) >= 0.0);
}

void fuse(const Mounting& mounting, std::string_view table) {
  const std::size_t count = std::min(mounting.sources.size(), pharos::fusion::kMaxSources);
  TargetFuser fuser({mounting.sources.begin(), mounting.sources.begin() + static_cast<std::ptrdiff_t>(count)}, {});
  const pharos::test::MemoryFile file(reinterpret_cast<const std::uint8_t*>(table.data()), table.size());
  for (std::size_t source = 0; source < count; ++source) {
    SourceTable rows(file.path(), mounting.sources[source].kind, {std::nullopt, 10.0});
    while (const auto row = rows.next()) {
      fuser.push(source, *row);
      check(fuser.state(fuser.estimator().newest_ns()));
    }
  }
}

}  // namespace

// Any bytes are an InputError, or states whose numbers are finite and whose variances are not negative.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = text.find("\n===\n");
  try {
    fuse(parse_mounting(text.substr(0, cut), "fuzz.toml"),
         cut == std::string_view::npos ? std::string_view() : text.substr(cut + 5));
  } catch (const InputError& error) {
    require(error.what()[0] != '\0');
  }
  return 0;
}
