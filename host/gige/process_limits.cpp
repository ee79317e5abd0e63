// SPDX-License-Identifier: Apache-2.0
#include "host/gige/process_limits.hpp"

#include <malloc.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "host/camera_link/frame_slots.hpp"
#include "host/device/pixel_format.hpp"
#include "host/gige/gige_camera.hpp"

namespace pharos::host {
namespace {

// More than twice the use with the simulated camera (VmPeak 98 MiB, 24 MiB of them frames). Each thread has 8 MiB of
// address space for its stack, and a search of the network runs one thread per network interface.
constexpr std::size_t kWithoutFrames_bytes = std::size_t{256} << 20;

}  // namespace

void bind_to_parent() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGPIPE}) ::signal(signal, SIG_IGN);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::mallopt(M_ARENA_MAX, 1);  // each further arena takes 64 MiB of address space
}

bool is_child_of(pid_t parent) { return ::getppid() == parent; }

std::size_t address_space_limit(const CameraSettings& settings) {
  const std::uint32_t largest = settings.format == CameraFormat::kDepth ? kCoord3dAbcy16 : kMono16;
  const std::size_t frame = payload_bytes(largest, settings.width_px, settings.height_px);
  return kWithoutFrames_bytes + 2 * GigeCamera::kBuffers * frame + SlotLayout::of(settings).bytes();
}

void limit_address_space(std::size_t bytes) {
#if !defined(__SANITIZE_ADDRESS__)
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &limit);
#else
  static_cast<void>(bytes);
#endif
}

}  // namespace pharos::host
