// SPDX-License-Identifier: Apache-2.0
// The reference model is held to QEMU: the same random programs, all registers after every block, every trap.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "rtl/core/processor_model.hpp"
#include "rtl/core/qemu_program.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::rtl {
namespace {

class QemuMachine final : public ModelBus {
 public:
  explicit QemuMachine(std::vector<std::uint32_t> memory) : memory_(std::move(memory)) {}
  std::optional<std::uint32_t> fetch(std::uint32_t address) override { return memory_.at((address - kQemuMemory) / 4); }
  std::optional<std::uint32_t> load(std::uint32_t address, std::uint8_t) override {
    return memory_.at((address - kQemuMemory) / 4);
  }
  bool store(std::uint32_t address, std::uint8_t bytes, std::uint32_t value) override {
    if (address == kQemuUart) {
      output_.push_back(static_cast<char>(value));
    } else if (address == kQemuEnd) {
      ended_ = true;
    } else {
      std::uint32_t& word = memory_.at((address - kQemuMemory) / 4);
      for (unsigned i = 0; i < 4; ++i) {
        const std::uint32_t lane = 0xFFU << 8 * i;
        if ((bytes >> i & 1) != 0) word = (word & ~lane) | (value & lane);
      }
    }
    return true;
  }
  bool ended() const { return ended_; }
  const std::string& output() const { return output_; }

 private:
  std::vector<std::uint32_t> memory_;
  std::string output_;
  bool ended_ = false;
};

TEST(CoreModel, AgreesWithQemuOnRandomPrograms) {
  if (std::system("command -v qemu-system-riscv32 >/dev/null") != 0) {
    GTEST_SKIP() << "qemu-system-riscv32 is not installed (tools/install-dependencies test)";
  }
  constexpr std::uint32_t kBlocks = 1000;
  constexpr std::uint32_t kBlockInstructions = 60;
  std::uint64_t instructions = 0;
  for (const std::uint64_t seed : {1u, 2u}) {
    const auto words = qemu_program(seed, kBlocks, kBlockInstructions);
    const test::TemporaryFolder folder;
    const std::string program = folder.path("program.bin");
    std::ofstream(program, std::ios::binary)
        .write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(4 * words.size()));
    const std::string line = folder.path("line");
    const std::string command =
        "timeout 300 qemu-system-riscv32 -M virt -smp 1 -m 32M -bios none -nodefaults -display none -serial file:" +
        line + " -device loader,addr=0x80000000,cpu-num=0 -device loader,force-raw=on,addr=0x80000000,file=" + program;
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream file(line, std::ios::binary);
    const std::string emulated{std::istreambuf_iterator<char>(file), {}};

    QemuMachine machine(words);
    ProcessorModel model(machine, kQemuMemory);
    while (!machine.ended()) {
      (void)model.step({});
      ASSERT_LT(++instructions, 10'000'000u) << "the program does not end";
    }
    ASSERT_EQ(emulated.size(), machine.output().size());
    const auto differing =
        std::mismatch(emulated.begin(), emulated.end(), machine.output().begin()).first - emulated.begin();
    EXPECT_EQ(static_cast<std::size_t>(differing), emulated.size()) << "byte of the output, seed " << seed;
  }
  EXPECT_GT(instructions, 2 * kBlocks * kBlockInstructions / 2);
}

}  // namespace
}  // namespace pharos::rtl
