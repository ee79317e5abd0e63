// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos {

// SI inside; degrees, arc seconds and millimetres only in user interfaces.
inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 2.0 * kPi;
inline constexpr double kRadPerDeg = kPi / 180.0;
inline constexpr double kDegPerRad = 180.0 / kPi;
inline constexpr double kRadPerArcsec = kPi / (180.0 * 3600.0);
inline constexpr double kArcsecPerRad = 1.0 / kRadPerArcsec;
inline constexpr double kMmPerM = 1000.0;

/// Standard deviation of one sweep angle that the paper measured (002, section 4.2): 8.8 arcsec.
inline constexpr double kPaperSigma_rad = 8.8 * kRadPerArcsec;
/// Correlation between sensors of one rotor that the paper measured (002, section 4.2).
inline constexpr double kPaperRho = 0.8717;

}  // namespace pharos
