// SPDX-License-Identifier: Apache-2.0
// Any bytes as a recording: an InputError or chunks with a consistent sum of sizes; never a crash.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "host/record/stream_reader.hpp"
#include "host/support/input_error.hpp"
#include "host/support/unique_fd.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pharos::host;
  const UniqueFd file(::memfd_create("recording", MFD_CLOEXEC));
  if (!file.valid() || ::write(file.get(), data, size) != static_cast<ssize_t>(size)) return 0;
  const bool packed = size >= 2 && data[0] == 0x1f && data[1] == 0x8b;
  try {
    StreamReader reader{ByteSource("/proc/self/fd/" + std::to_string(file.get()))};
    std::size_t bytes = 0;
    while (const auto chunk = reader.next()) bytes += chunk->bytes.size() + stream_format::kChunkHeadBytes;
    if (!packed && bytes + reader.dropped_bytes() > size) std::abort();
  } catch (const InputError&) {
    return 0;
  }
  return 0;
}
