// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/fusion/fusion_feed.hpp"
#include "host/daemon/lighthouse_feed.hpp"
#include "host/daemon/pointing_feed.hpp"
#include "host/daemon/remote/remote_feed.hpp"
#include "host/daemon/source.hpp"
#include "host/daemon/stereo/stereo_feed.hpp"
#include "host/daemon/tof_feed.hpp"

namespace pharos::host {

// In the order of PHAROS_STATUS. The log names the first kind even if there is no source of it.
const SourceKinds& source_kinds() {
  static const SourceKinds kinds{{"target", open_target_feeds},      {"camera", open_tof_feeds},
                                 {"telescope", open_pointing_feeds}, {"stereo rig", open_stereo_feeds},
                                 {"remote", open_remote_feed},       {"vehicle", open_fusion_feed}};
  return kinds;
}

}  // namespace pharos::host
