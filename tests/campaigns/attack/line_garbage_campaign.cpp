// SPDX-License-Identifier: Apache-2.0
// Random bytes and damaged frames on the serial line, between the target's own.
#include <cstdio>
#include <random>

#include "campaigns/attack/attacked_lighthouse.hpp"
#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

using Bytes = StationaryTarget::Bytes;

class AttackedLine : public AttackedLighthouse {
 protected:
  Bytes garbage(std::size_t size) {
    Bytes bytes(size);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    bytes.back() = 0;  // a delimiter: the frame after it is whole
    return bytes;
  }
  /// Frames of another body at another place, each with some bytes changed, cut out or doubled.
  Bytes damaged_frames(std::size_t size) {
    Bytes bytes;
    while (bytes.size() < size) {
      const auto flash_ticks = static_cast<std::int64_t>(random_() % (std::uint64_t{1} << 40));
      const Bytes whole = other_.bytes_of(other_.sweep(random_() % 2 == 0 ? Axis::kX : Axis::kY, flash_ticks));
      Bytes frame = whole;
      for (std::uint64_t changes = 1 + random_() % 4; changes > 0; --changes) damage(frame);
      if (frame == whole) continue;  // two changes may cancel
      bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    bytes.push_back(0);
    return bytes;
  }
  /// Changes a byte between the delimiters.
  void damage(Bytes& frame) {
    const auto at = frame.begin() + 1 + static_cast<std::ptrdiff_t>(random_() % (frame.size() - 2));
    switch (random_() % 3) {
      case 0:
        *at = static_cast<std::uint8_t>(*at ^ (1U << random_() % 8));
        break;
      case 1:
        frame.erase(at);
        break;
      default:
        frame.insert(at, *at);
    }
  }
  /// Megabytes of `make`'s bytes in pieces, a cycle after each; lost: sweeps without a pose that no counter reports.
  template <class Make>
  void attack(const char* name, std::int64_t megabytes, const Make& make) {
    start();
    ASSERT_TRUE(measures()) << daemon.process().text();
    std::int64_t sent_bytes = 0;
    play_until(
        [&] {
          const Bytes bytes = make();
          if (!line.write(bytes)) return true;
          sent_bytes += static_cast<std::int64_t>(bytes.size());
          return sent_bytes >= megabytes * 1'000'000;
        },
        900.0);
    EXPECT_GE(sent_bytes, megabytes * 1'000'000);
    const int wrong = false_poses();
    const std::int64_t lost = lost_poses();
    const std::int64_t uncounted = uncounted_poses();
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(uncounted, 0) << reasons();
    std::printf("  all counters since the start:%s\n", reasons().c_str());
    add_row({name,
             std::to_string(sent_bytes / 1'000'000) + " MB between " + std::to_string(sweeps_sent()) + " sweeps, " +
                 std::to_string(sweeps_sent() - lost) + " of them with a pose",
             wrong, uncounted, memory()});
    EXPECT_TRUE(poses_come(30)) << daemon.process().text();
  }

  std::mt19937_64 random_{1};
  StationaryTarget other_{{rotation_exp(Vector3(-0.1, 0.2, 0.0)), Vector3(-0.5, 0.1, 3.0)}};
};

TEST_F(AttackedLine, RandomBytes) {
  attack("random bytes on the serial line", campaign_size("PHAROS_ATTACK_MEGABYTES", 200),
         [&] { return garbage(50'000); });
}

TEST_F(AttackedLine, DamagedFrames) {
  attack("damaged frames on the serial line", campaign_size("PHAROS_ATTACK_MEGABYTES", 200) / 4,
         [&] { return damaged_frames(50'000); });
}

}  // namespace
}  // namespace pharos::host
