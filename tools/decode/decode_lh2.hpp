// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/support/output.hpp"
#include "tools/support/recording.hpp"

namespace pharos::tools {

/// What `pharos decode --lh2-light` writes.
enum class Lh2Rows { kHits, kBits, kOotx };

/// Raw light of Lighthouse 2.0 (host::Lh2LightReader) to rows. Returns the program's exit code.
int decode_lh2_light(const std::string& path, Lh2Rows what, bool statistics, const OutputOptions& output);

/// A recorded serial stream of a target of Lighthouse 2.0, whose first event was taken, to rows of hits or OOTX.
int decode_lh2_stream(Recording& recording, const RecordingEvent& first, Lh2Rows what, bool statistics,
                      const OutputOptions& output);

}  // namespace pharos::tools
