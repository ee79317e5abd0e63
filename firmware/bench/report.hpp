// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include "firmware/bench/input.hpp"
#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/processor.hpp"

namespace pharos::bench {

/// One line of a program's results: `name value`.
inline void say(std::string_view name, std::int64_t value) {
  board::console_write(name);
  board::console_write(" ");
  board::console_write_decimal(value);
  board::console_write("\n");
}

/// The input file, read from front to back.
class Input {
 public:
  template <class Row>
  const Row& next() {
    const Row& row = *reinterpret_cast<const Row*>(at_);
    at_ += sizeof(Row);
    return row;
  }
  /// The header; ends the emulator where there is none.
  template <class Header>
  const Header& header() {
    const auto& header = next<Header>();
    if (header.magic != kMagic) {
      board::console_write("no input: load it with -device loader,file=FILE,addr=0x82000000,force-raw=on\n");
      board::exit_emulator(1);
    }
    return header;
  }

 private:
  std::uintptr_t at_ = kInputAddress;
};

/// Counts instructions from its construction on, without those of counting: it must not be a call, which would count
/// its own overhead.
class Count {
 public:
  [[gnu::always_inline]] Count() : begin_(board::instructions_retired_low()) {}
  [[gnu::always_inline]] std::uint32_t instructions() const {
    return board::instructions_retired_low() - begin_ - 1U;  // the reading itself
  }

 private:
  std::uint32_t begin_;
};

/// Instructions of a call.
template <class Call>
std::uint32_t instructions_of(Call&& call) {
  const Count count;
  call();
  return count.instructions();
}

/// Median and worst of many counts, exact up to kBins, then to the next power of two's 256th.
class Counts {
 public:
  void add(std::uint32_t count) {
    ++number_;
    sum_ += count;
    worst_ = std::max(worst_, count);
    ++bins_[bin_of(count)];
  }
  std::uint32_t number() const { return number_; }
  std::int64_t sum() const { return static_cast<std::int64_t>(sum_); }
  std::uint32_t worst() const { return worst_; }
  /// The count that this fraction of all does not exceed.
  std::uint32_t quantile(std::uint32_t permille) const {
    const std::uint64_t wanted = std::uint64_t{number_} * permille / 1000;
    std::uint64_t sum = 0;
    for (std::uint32_t bin = 0; bin < bins_.size(); ++bin) {
      sum += bins_[bin];
      if (sum > wanted) return value_of(bin);
    }
    return worst_;
  }

 private:
  // Below 256 one bin a count; above, 128 bins an octave.
  static std::uint32_t bin_of(std::uint32_t count) {
    if (count < 256) return count;
    const auto octave = static_cast<std::uint32_t>(std::bit_width(count)) - 8U;
    return 128U * octave + (count >> octave);
  }
  static std::uint32_t value_of(std::uint32_t bin) {
    if (bin < 256) return bin;
    const std::uint32_t octave = bin / 128U - 1U;
    return (bin - 128U * octave) << octave;
  }

  std::array<std::uint32_t, 128 * 26> bins_{};
  std::uint64_t sum_ = 0;
  std::uint32_t number_ = 0;
  std::uint32_t worst_ = 0;
};

inline void say(std::string_view name, const Counts& counts) {
  const auto line = [&](std::string_view what, std::int64_t value) {
    board::console_write(name);
    say(what, value);
  };
  line("_number", counts.number());
  line("_sum", counts.sum());
  line("_median", counts.quantile(500));
  line("_99_percent", counts.quantile(990));
  line("_worst", counts.worst());
}

}  // namespace pharos::bench
