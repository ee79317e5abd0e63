// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "host/table/byte_source.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/network/station.hpp"
#include "tools/convert/light_hit.hpp"

namespace pharos::convert {

/// One device of a record.
struct RecordedDevice {
  std::string name;
  Target target;               // sensors that the device describes; positions in its own frame
  std::vector<LightHit> hits;  // in the order of time; LightHit::station is the channel
  std::vector<ImuSample> imu;
  std::size_t without_sync = 0;  // hits before their station's first sync, or long after its last
};

/// A pose that another tracker told.
struct ExternalPose {
  double time_s = 0.0;
  std::string device;
  Quaternion q = Quaternion::Identity();
  Vector3 t = Vector3::Zero();
};

struct LibsurviveRecord {
  std::map<std::string, RecordedDevice> devices;
  std::vector<ExternalPose> external;
  bool cut_off = false;  // the file ends within a line or in its compressed data
};

/// Reads a record of libsurvive: lines `time device kind ...`, of which CONFIG, W, Y, i, IMU_SCALES and EXTERNAL_POSE
/// are used. Angles of LH2 come from the times since the sync (Y) and the channel's period; times are put on the log's
/// clock, which stamps arrivals, by the least delays (lower_envelope).
///
/// Throws InputError of one line: no line of such a record, a broken line, light of LH1 alone.
LibsurviveRecord read_libsurvive_record(host::ByteSource source);

/// Puts stations where the record says that they stood (EXTERNAL_POSE of previous_LH and the channel): a configuration
/// beside it may be of another day.
void place_stations(const LibsurviveRecord& record, network::Stations& stations);

}  // namespace pharos::convert
