// SPDX-License-Identifier: Apache-2.0
// Any bytes as a recording of a camera: an InputError, or frames of the size in the head with times that go forward.
#include <cstdint>

#include "host/frame_record/frame_reader.hpp"
#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"

namespace {

using pharos::test::require;

void read(const std::string& path, std::size_t size, bool packed) {
  using namespace pharos::host;
  FrameReader reader{ByteSource(path)};
  const FramesHeader& head = reader.header();
  DepthFrame frame;
  std::int64_t last_ns = head.monotonic_ns;
  std::uint64_t bytes = 0;
  while (reader.next(frame)) {
    require(frame.width_px == head.width_px && frame.height_px == head.height_px);
    require(2 * (frame.intensity.size() + frame.depth.size()) == head.pixel_bytes());
    require(frame.complete_monotonic_ns >= last_ns);
    last_ns = frame.complete_monotonic_ns;
    bytes += head.pixel_bytes();
  }
  require(reader.counters().frames_missing >= 0);
  require(packed || bytes + reader.counters().dropped_bytes <= size);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const pharos::test::MemoryFile file(data, size);
  try {
    read(file.path(), size, size >= 2 && data[0] == 0x1f && data[1] == 0x8b);
  } catch (const pharos::host::InputError& error) {
    require(error.what()[0] != '\0');
  }
  return 0;
}
