// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "host/device/depth_frame.hpp"
#include "host/device/ptp_state.hpp"

namespace pharos::host {

// The counters of a source. X(name, what it counts)
#define PHAROS_FRAME_SOURCE_COUNTERS(X)                                                               \
  X(frames_received, "whole frames of the right size and format")                                     \
  X(frames_incomplete, "frames with packets missing")                                                 \
  X(frames_missing, "frames of which nothing came, told by gaps in their numbers")                    \
  X(frames_wrong_size, "frames of another size or format than was agreed")                            \
  X(frames_out_of_order, "frames whose number cannot follow the last one's: another sender's")        \
  X(frames_wrong_time, "frames whose time is not the camera's clock's: another sender's")             \
  X(datagrams_discarded, "datagrams to the stream's port that were not the camera's, or had no room") \
  X(frames_unpaired, "depth frames whose intensity frame did not come, or the reverse")               \
  X(frames_dropped, "whole frames that gave way to newer ones: the one before was still measured")    \
  X(camera_opened, "times the camera was opened")                                                     \
  X(camera_lost, "times it was lost")                                                                 \
  X(camera_silences, "times it was opened anew because no frame came")                                \
  X(camera_contested, "times it was opened anew because frames of two senders came")                  \
  X(ptp_losses, "times the camera ceased to follow PTP")                                              \
  X(ptp_refusals, "times it did not take the order to follow PTP")                                    \
  X(camera_process_deaths, "times the camera's process died and was started again")                   \
  X(messages_refused, "messages of the camera's process that could not be")

struct FrameSourceCounters {
#define PHAROS_X(name, text) std::int64_t name = 0;
  PHAROS_FRAME_SOURCE_COUNTERS(PHAROS_X)
#undef PHAROS_X
};

/// Calls visit(name, value) for every counter; the value can be changed if the counters are not const.
template <class Counters, class Visitor>
requires std::is_same_v<std::remove_const_t<Counters>, FrameSourceCounters>
void for_each_counter(Counters& counters, Visitor&& visit) {
#define PHAROS_X(name, text) visit(#name, counters.name);
  PHAROS_FRAME_SOURCE_COUNTERS(PHAROS_X)
#undef PHAROS_X
}

/// Whole pictures since the start, and those of which something or all did not come. Another sender's are neither.
struct DeliveredFrames {
  std::int64_t came = 0;
  std::int64_t lost = 0;
};

inline DeliveredFrames delivered(const FrameSourceCounters& counters) {
  return {counters.frames_received - counters.frames_dropped, counters.frames_incomplete + counters.frames_missing +
                                                                  counters.frames_wrong_size +
                                                                  counters.frames_unpaired + counters.frames_dropped};
}

enum class CameraState : std::uint8_t {
  kOpen,    // frames come or are expected
  kSilent,  // open, but no frame comes
  kGone,    // not found
  kTaken,   // in use by another program
  kWrong,   // not as configured
};

/// Status of a source of frames or of pairs.
struct SourceStatus {
  CameraState state = CameraState::kGone;
  std::string error;          // what is wrong and what to do; empty when open
  std::string remark;         // to be logged once: how a recording's images were converted
  std::string identity;       // of each camera: vendor, model, serial number, mode, format, packets, PTP
  std::string ptp;            // of each camera that is asked to follow PTP: its state; to be logged when it changes
  bool ptp_fault = false;     // a camera refuses PTP, does not tell its state, or ceased to follow it
  std::uint32_t session = 0;  // increases with every opening of a camera
  bool finished = false;      // a recording has ended
};

/// Of a camera that is recorded, or that is played from a recording.
struct FrameRecordingCounters {
  std::int64_t frames = 0;         // written; of a replay: read
  std::int64_t frames_lost = 0;    // the disk was too slow, full or gone; of a replay: missing or damaged
  std::int64_t files = 0;          // begun
  std::int64_t files_deleted = 0;  // the oldest, to keep the limit
  std::int64_t failures = 0;       // to open, write, delete or read a file
};

struct FrameSourceStatus : SourceStatus {
  PtpState ptp_state = PtpState::kOff;
  FrameSourceCounters counters;
  std::optional<FrameRecordingCounters> recording;
};

/// A source of depth frames: a camera on the network, or recorded frames.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Readable while frames wait.
  virtual int fd() const = 0;
  virtual DepthFramePtr take() = 0;
  virtual void recycle(DepthFramePtr frame) = 0;
  virtual FrameSourceStatus status() const = 0;
  /// Readable name of its device.
  virtual std::string device() const = 0;
  /// Why its frames are not recorded, though they should be; empty otherwise.
  virtual std::string storage_error() const { return {}; }
};

}  // namespace pharos::host
