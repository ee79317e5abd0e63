// SPDX-License-Identifier: Apache-2.0
// Instructions a burst of Lighthouse 2.0's light: bits from changes, and the search for their place in a sequence, for
// a station that is known and for one that is not.
#include "firmware/bench/report.hpp"
#include "pharos/lighthouse/lh2_light_decoder.hpp"

namespace {

using namespace pharos;  // NOLINT: a program of one page
using bench::Counts;

constexpr std::size_t kSequence = 12;  // channel 6
constexpr int kBursts = 200;
constexpr std::size_t kBits = 45;

std::uint32_t random_state = 1;
std::uint32_t random_below(std::uint32_t bound) {
  random_state = random_state * 1664525U + 1013904223U;
  return (random_state >> 8U) % bound;
}

/// Light of `kBits` bits from a random place on; every third burst lacks a change.
lighthouse::Lh2Burst some_burst(bool lacks_one) {
  std::uint32_t window = 1 + random_below(lighthouse::kWindowMask);
  lighthouse::Lh2Burst burst;
  burst.start_ticks = 1000;
  std::size_t changes = 0;
  const auto add = [&](std::uint32_t half_bits) {
    const bool lost = lacks_one && changes++ == 20;
    if (!lost) burst.edge_ticks.push_back(static_cast<std::uint16_t>((half_bits * 25U + 3U) / 6U));
  };
  for (std::uint32_t i = 0; i < kBits; ++i) {
    add(2 * i);
    if ((window >> 16U & 1U) != 0) add(2 * i + 1);
    window = lighthouse::window_after(window, lighthouse::kLh2Taps[kSequence]);
  }
  burst.light_begin_ticks = 10;
  burst.light_end_ticks = 370;
  return burst;
}

lighthouse::Lh2Sequences* sequences = nullptr;
alignas(lighthouse::Lh2Sequences) unsigned char place_of_sequences[sizeof(lighthouse::Lh2Sequences)];
Counts bits, known, unknown, search;

}  // namespace

int main() {
  Counts construction;
  construction.add(bench::instructions_of([&] { sequences = new (place_of_sequences) lighthouse::Lh2Sequences; }));
  std::uint32_t found = 0;
  for (int k = 0; k < kBursts; ++k) {
    const lighthouse::Lh2Burst burst = some_burst(k % 3 == 0);
    std::optional<lighthouse::Lh2Bits> read;
    bits.add(bench::instructions_of([&] { read = lighthouse::biphase_bits(burst); }));
    if (!read) continue;
    std::optional<lighthouse::Lh2Beam> beam;
    known.add(
        bench::instructions_of([&] { beam = lighthouse::identify(*read, 1U << (kSequence / 2), *sequences, 0); }));
    if (beam) ++found;
    unknown.add(
        bench::instructions_of([&] { beam = lighthouse::identify(*read, lighthouse::kAllLh2Channels, *sequences); }));
    std::optional<std::uint32_t> place;
    const std::uint32_t window = 1 + random_below(lighthouse::kWindowMask);
    search.add(bench::instructions_of([&] { place = sequences->place_of(window, kSequence); }));
  }
  bench::say("lh2_bits", bits);
  bench::say("lh2_known", known);
  bench::say("lh2_unknown", unknown);
  bench::say("lh2_search", search);
  bench::say("lh2_construction", construction);
  bench::say("lh2_found", found);
  bench::say("lh2_sequences_bytes", sizeof(lighthouse::Lh2Sequences));
  bench::say("lh2_decoder_bytes", sizeof(lighthouse::Lh2LightDecoder));
  return 0;
}
