// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/text_file.hpp"

#include "host/files/atomic_file.hpp"

namespace pharos::tools {

void write_text_file(const std::string& path, const std::string& text) {
  host::write_file(path, text, host::AtomicFile::Sync::kToDisk);
}

}  // namespace pharos::tools
