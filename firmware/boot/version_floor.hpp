// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "firmware/boot/boot_board.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::boot {

/// A version as a number that orders as it.
inline std::uint32_t number_of(const boot_image::Version& version) {
  return static_cast<std::uint32_t>(version.major) << 16 | static_cast<std::uint32_t>(version.minor) << 8 |
         version.patch;
}

/// The oldest version that may still be written: the greatest record of a list in flash that only grows. A record whose
/// CRC is wrong, for power failed, does not count. Nothing is ever erased: the sector must be erased when the board is
/// made, and the floor stays when it is full.
template <BootBoard Board>
class VersionFloor {
 public:
  [[gnu::noinline]] static std::uint32_t read() { return scan().floor; }

  /// False when a write failed or the list is full; the floor is then the old one.
  template <class Idle>
  [[gnu::noinline]] static bool raise(std::uint32_t version, Idle&& idle) {
    const State state = scan();
    if (version <= state.floor) return true;
    if (state.records == kMaxRecords) return false;
    const Record record{version, check_of(version)};
    return Board::flash().program(offset_of(state.records),
                                  {reinterpret_cast<const std::uint8_t*>(&record), sizeof record},
                                  std::forward<Idle>(idle));
  }

 private:
  struct Record {
    std::uint32_t version;
    std::uint32_t check;  // CRC-32 of the version
  };
  struct State {
    std::uint32_t floor;
    std::uint32_t records;  // before the first erased one
  };
  /// 4 KiB: one for each of the first 512 releases, read in some ms.
  static constexpr std::uint32_t kMaxRecords = 512;

  static std::uint32_t offset_of(std::uint32_t record) {
    return Board::kFloorOffset + record * static_cast<std::uint32_t>(sizeof(Record));
  }
  static std::uint32_t check_of(const std::uint32_t& version) {
    return wire::crc32({reinterpret_cast<const std::uint8_t*>(&version), sizeof version});
  }
  [[gnu::noinline]] static State scan() {
    State state{0, 0};
    for (; state.records < kMaxRecords; ++state.records) {
      Record record;
      Board::flash().read(offset_of(state.records), {reinterpret_cast<std::uint8_t*>(&record), sizeof record});
      if ((record.version & record.check) == UINT32_MAX) break;
      if (record.check == check_of(record.version) && record.version > state.floor) state.floor = record.version;
    }
    return state;
  }
};

}  // namespace pharos::boot
