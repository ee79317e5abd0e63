// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_cpu_load.hpp"

#include <variant>

#include "host/support/input_error.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/report/link_decoder.hpp"
#include "tools/evaluation/bench/target_images.hpp"
#include "tools/evaluation/bench/target_input.hpp"

namespace pharos::tools {
namespace {

constexpr int kSensors = 12;
/// Left out of the mean: until both stations are found, the load is lower.
constexpr std::int64_t kStart_ticks = 2 * kTicksPerSecond;

}  // namespace

CpuLoad cpu_load(const std::filesystem::path& images, double cycles) {
  const std::string line = run_image_live(images, "decoder.qemu_virt", simulated_words(kSensors, cycles));
  report::LinkDecoder link;
  std::int64_t first_ticks = -1;
  int seconds = 0;
  CpuLoad fraction;
  for (const char byte : line) {
    const auto event = link.push(static_cast<std::uint8_t>(byte));
    const auto* device = event ? std::get_if<report::DeviceReport>(&*event) : nullptr;
    if (device == nullptr) continue;
    if (first_ticks < 0) first_ticks = device->time_ticks;
    if (device->time_ticks - first_ticks < kStart_ticks) continue;
    ++seconds;
    fraction.percent += 0.1 * device->counters.busy_permille;  // of a core of this speed (board/qemu_virt)
    fraction.lost = static_cast<double>(device->counters.edges_lost) + device->counters.frames_skipped;
  }
  if (seconds == 0) throw host::InputError("decoder.qemu_virt.elf: told no counters on its line; build it anew");
  fraction.percent /= seconds;
  return fraction;
}

}  // namespace pharos::tools
