// SPDX-License-Identifier: Apache-2.0
// One depth frame on the soft core: the output of host_main.cpp, and instructions by stage.
#include <array>
#include <memory>

#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/processor.hpp"
#include "firmware/board/rv32/stack_mark.hpp"
#include "tests/target/tof/frame_file.hpp"
#include "tests/target/tof/frame_result.hpp"

namespace {

using namespace pharos;  // NOLINT: a program of one page

void say(const char* what, std::int64_t value) {
  board::console_write("count ");
  board::console_write(what);
  board::console_write(" ");
  board::console_write_decimal(value);
  board::console_write("\n");
}

class StageCount final : public tof::TofStageListener {
 public:
  void ended(tof::TofStage stage) override {
    const std::uint64_t now = board::instructions_retired();
    counts_[static_cast<std::size_t>(stage)] += now - last_;
    last_ = now;
  }
  void print() const {
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < tof::kTofStages; ++k) {
      say(tof::name_of(static_cast<tof::TofStage>(k)), static_cast<std::int64_t>(counts_[k]));
      all += counts_[k];
    }
    say("instructions", static_cast<std::int64_t>(all));
  }

 private:
  std::array<std::uint64_t, tof::kTofStages> counts_{};
  std::uint64_t last_ = board::instructions_retired();
};

}  // namespace

int main() {
  const auto& file = *reinterpret_cast<const test::FrameFile*>(test::kFrameAddress);
  if (file.magic != test::kFrameMagic) {
    board::console_write("no frame: load it with -device loader,file=FILE,addr=0x82000000,force-raw=on\n");
    return 1;
  }
  // The test's heap replaces the board's external memory.
  const auto workspace = std::make_unique<tof::TofWorkspace>();
  // The lens' rays are computed once a camera: not part of the cost of a frame.
  const std::uint64_t begin = board::instructions_retired();
  if (!workspace->rays.prepare(file.camera().intrinsics)) return 1;
  say("rays_once", static_cast<std::int64_t>(board::instructions_retired() - begin));
  StageCount stages;
  const auto result = tof::measure_tof_pose(file.frame(), file.camera(), {}, *workspace, &stages);
  stages.print();
  say("workspace_bytes", sizeof(tof::TofWorkspace));
  say("stack_bytes", board::stack_bytes() - board::stack_never_used_bytes());
  test::print_result(result, *workspace);
  return 0;
}
