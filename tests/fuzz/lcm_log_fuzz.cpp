// SPDX-License-Identifier: Apache-2.0
// Any bytes as a log of LCM: whole messages, counted damage, and an MCAP file.
#include <cstdint>
#include <cstdio>

#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"
#include "tools/export/mcap_export.hpp"

namespace {

using pharos::test::require;

void export_log(const std::uint8_t* data, std::size_t size) {
  const pharos::test::MemoryFile file(data, size);
  pharos::tools::LcmLogReader log{pharos::host::ByteSource(file.path())};
  std::FILE* out = std::fopen("/dev/null", "wb");
  require(out != nullptr);
  std::int64_t messages = 0, bytes = 0;
  {
    pharos::tools::McapExport mcap(out, "pharos fuzz");
    while (const auto message = log.next()) {
      require(!message->channel.empty() && message->channel.size() <= pharos::tools::LcmLogReader::kMaxChannel);
      bytes += static_cast<std::int64_t>(message->channel.size() + message->data.size()) + 28;
      ++messages;
      mcap.push(*message);
    }
    mcap.finish();
    std::int64_t counted = 0;
    for (const auto& [name, c] : mcap.channels()) counted += c.exported + c.foreign + c.not_finite + c.without_time;
    require(counted == messages);
    require(mcap.written() <= 3U * static_cast<std::uint64_t>(messages));
  }
  std::fclose(out);
  // gzip unpacks to more; otherwise every byte is a message's, skipped, or of the one that is cut off.
  const bool gzip = size >= 2 && data[0] == 0x1F && data[1] == 0x8B;
  const std::int64_t used = bytes + log.counters().bytes_skipped;
  if (!gzip) {
    require(log.counters().cut_off ? used < static_cast<std::int64_t>(size) : used == static_cast<std::int64_t>(size));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    export_log(data, size);
  } catch (const pharos::host::InputError& error) {
    require(error.what()[0] != '\0');  // broken gzip
  }
  return 0;
}
