// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/lighthouse/lh2_beam.hpp"
#include "pharos/lighthouse/lh2_biphase.hpp"
#include "pharos/lighthouse/lh2_sequence.hpp"

namespace pharos::lighthouse {

/// Channels as bits of a word.
inline constexpr std::uint32_t kAllLh2Channels = 0xFFFF;
// Bits beyond a window of 17 that agree, less three times those that do not.
inline constexpr int kMinScore = 8;

/// Finds the sequence that a burst's bits belong to, and their place in it.
///
/// Every window of 17 clean bits predicts, for each sequence, what follows and precedes. The stretch around the window
/// that agrees best (1 for each bit that agrees, -3 for one that does not, 0 for unclean ones) is that sequence's
/// score. Bits that agree by chance reach a score of s beyond the window about once in 1.84^s windows and sequences, of
/// which a burst has a thousand: kMinScore is for beams that need a second one of the same sync to count
/// (Lh2SweepDecoder). Of a station whose sync is known less will do: place and time must agree.
///
/// `channels`: bits of those to look for. Empty where none is found.
std::optional<Lh2Beam> identify(const Lh2Bits& bits, std::uint32_t channels, const Lh2Sequences& sequences,
                                int min_score = kMinScore);

}  // namespace pharos::lighthouse
