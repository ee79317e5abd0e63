// SPDX-License-Identifier: Apache-2.0
// Any bytes as a body: an InputError, or a convex one with outward faces.
#include <cstdint>

#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"
#include "tools/layout/convex_body.hpp"

namespace {

using pharos::test::MemoryFile;
using pharos::test::require;

void check(const std::string& path) {
  const pharos::layout::ConvexBody body = pharos::layout::read_body(path);
  const pharos::Vector3 middle = 0.5 * (body.low + body.high);
  require(body.facets.size() >= 4);
  for (const auto& facet : body.facets) {
    require(facet.normal.allFinite() && facet.corners.size() >= 3);
    // The body's centre is inside of every face, up to rounding.
    require(facet.normal.dot(facet.origin - middle) > -0.5 * (body.high - body.low).norm());
    for (const auto& corner : pharos::layout::inset(facet.corners, 0.001)) require(corner.allFinite());
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
