// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos::host {

/// Whether two paths lead to one file or folder, whatever links are between: by device and inode where both exist, else
/// by their names. Devices, pipes and sockets are never the same (`/dev/null` twice is no mistake), nor is `-`.
bool same_file(const std::string& a, const std::string& b);

}  // namespace pharos::host
