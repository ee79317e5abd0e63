// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos::tools {

/// Pose solvers of other projects that the benchmark runs beside ours.
enum class Peer : int { kSqpnp = 0, kEpnp = 1, kIterative = 2 };

/// What the module of peers offers: a pose from points (x, y, z in turn, body frame, m) and their tangents (x/z, y/z in
/// turn, lighthouse frame). Rotation row by row, R_lighthouse_body. False where the peer gives no answer.
using PeerFunction = bool (*)(int peer, const double* body, const double* tangents, int count, double* rotation,
                              double* translation);

inline constexpr const char* kPeerFunctionName = "pharos_bench_peer";
inline constexpr const char* kPeerModuleName = "libpharos_bench_opencv.so";

}  // namespace pharos::tools
