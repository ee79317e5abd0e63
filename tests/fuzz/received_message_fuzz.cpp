// SPDX-License-Identifier: Apache-2.0
// Any bytes as an LCM message: a row, or counted as left out; the state of the page is valid JSON on one line.
#include <cstdint>
#include <nlohmann/json.hpp>

#include "support/require.hpp"
#include "tools/view/state_json.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pharos::tools;
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  SourceTable table;
  table.take("PHAROS_POSE", data, static_cast<int>(size), kSecond_ns, kSecond_ns);
  table.tick(2 * kSecond_ns, 2 * kSecond_ns);
  ViewContext context;
  context.utc_ns = context.now_ns = 2 * kSecond_ns;
  const std::string text = state_json(table, context);
  pharos::test::require(nlohmann::json::accept(text) && text.find('\n') == std::string::npos);
  pharos::test::require(table.rows().size() <= 1);
  pharos::test::require(table.previews().size() <= 1);
  for (const CameraPreview& preview : table.previews()) pharos::test::require(preview.jpeg->size() <= 32 * 1024);
  return 0;
}
