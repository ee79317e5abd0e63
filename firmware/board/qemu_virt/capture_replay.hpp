// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/board/qemu_virt/virtio_console.hpp"
#include "firmware/board/rv32/processor.hpp"
#include "firmware/hal/edge_capture.hpp"

namespace pharos::board {

/// A capture block played from outside: its register values, four little-endian words at a time.
///
///   STATUS with a count:    STATUS, FIFO_TIME, FIFO_CHANGED, FIFO_LEVELS   a record
///   STATUS with count 0:    STATUS, TIME_LOW, TIME_HIGH, LOST             the FIFO was empty at that time
///   0xFFFFFFFE, ticks that 1,024 instructions take, and two words          a core of this speed, from here on
///   0xFFFFFFFF and three words of anything                                 the end: the emulator ends with success
///
/// Time does not advance between two of them: it is the block's and not the emulator's, so that the same tape always
/// gives the same frames. With a core's speed it advances with the instructions (except those that read the tape): a
/// record can be read no earlier than such a core would have found it, and a program that is too slow falls behind.
/// Such a tape is read from a file: where words are late, the program waits for them in no time of the core's.
class CaptureReplay final : public hal::EdgeCapture {
 public:
  /// Waits for the first words, so that the program starts with the tape's time.
  void start();
  bool read(hal::CaptureRecord& record) override;
  std::int64_t now_ticks() override;
  std::uint32_t edges_lost() override { return lost_; }
  bool take_overflow() override;
  std::uint32_t inputs() override { return UINT32_MAX; }
  /// Instructions spent on the tape, in place of a board's four register reads.
  std::uint32_t instructions() const { return instructions_; }
  /// Instructions that such a core has in a millisecond; 0 where the tape names no speed.
  std::uint32_t instructions_a_millisecond() const { return millisecond_; }
  /// While such an object exists, instructions do not count for the core: no board executes them.
  class PausedClock {
   public:
    [[gnu::always_inline]] explicit PausedClock(CaptureReplay& tape)
        : replay_(tape), begin_(instructions_retired_low()) {}
    [[gnu::always_inline]] ~PausedClock() { replay_.instructions_ += instructions_retired_low() - begin_; }
    PausedClock(const PausedClock&) = delete;
    PausedClock& operator=(const PausedClock&) = delete;
    std::uint32_t begin() const { return begin_; }

   private:
    CaptureReplay& replay_;
    std::uint32_t begin_;
  };
  /// No more words have arrived so far.
  bool waiting() const { return waiting_; }
  /// All words have been read.
  bool ended() const { return ended_; }

 private:
  bool take_words(std::uint32_t instructions);
  bool fetch();
  void use();
  std::int64_t core_ticks(std::uint32_t instructions);

  VirtioConsole console_;
  std::array<std::uint32_t, 4> words_{};
  std::size_t count_ = 0;
  std::int64_t due_ticks_ = 0;       // when the words in words_ may be used
  std::int64_t core_ticks_ = 0;      // the core's own time
  std::uint32_t core_fraction_ = 0;  // and what is left of a tick, 1/1024
  std::uint32_t core_begin_ = 0;     // instructions by then, except those on the tape
  std::uint32_t speed_ = 0;          // ticks that 1,024 instructions take; 0: time is the tape's alone
  std::uint32_t millisecond_ = 0;    // instructions in one
  std::int64_t now_ticks_ = 0;
  std::uint32_t lost_ = 0;
  std::uint32_t instructions_ = 0;
  bool overflow_ = false;      // the flag as last read
  bool new_overflow_ = false;  // it rose since the last query
  bool held_ = false;          // the record in words_ was not returned yet
  bool waiting_ = false;
  bool ended_ = false;
};

}  // namespace pharos::board
