// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/fake_helios.hpp"

#include <arv.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <random>

#include "host/device/pixel_format.hpp"
#include "host/gige/gobject.hpp"
#include "host/runtime/now.hpp"
#include "host/support/input_error.hpp"
#include "host/support/unique_fd.hpp"
#include "tools/sim/camera/helios_description.hpp"

namespace pharos::sim {
namespace {

using host::GObjectPtr;

constexpr double kNanosecondsPerSecond = 1e9;
constexpr double kUsPerSecond = 1e6;
constexpr double kMmPerM = 1e3;
constexpr std::size_t kFineModes = 2;  // up to 3000 mm
constexpr std::uint32_t kVendorText = 0x48;
constexpr std::uint32_t kModelText = 0x68;
constexpr std::size_t kTextBytes = 32;

OfferedFormats offered_by(const CameraPlay& play) {
  if (play.grey) return OfferedFormats::kGrey;
  return play.depth_and_intensity_apart ? OfferedFormats::kDepthApart : OfferedFormats::kDepth;
}

std::uint32_t first_format(OfferedFormats offered) {
  if (offered == OfferedFormats::kGrey) return host::kMono16;
  return offered == OfferedFormats::kDepth ? host::kCoord3dAbcy16 : host::kCoord3dC16;
}

bool any_holds(const std::vector<Outage>& intervals, double time_s) {
  return std::any_of(intervals.begin(), intervals.end(), [&](const Outage& one) { return one.holds(time_s); });
}

// Aravis takes the description as a file only.
class DescriptionFile {
 public:
  explicit DescriptionFile(const std::string& text) {
    const char* folder = ::getenv("TMPDIR");
    path_ = std::string(folder == nullptr ? "/tmp" : folder) + "/pharos-helios-XXXXXX";
    const host::UniqueFd fd(::mkstemp(path_.data()));
    if (!fd.valid() || ::write(fd.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
      throw host::InputError(path_ + ": cannot be written; the camera's description goes there");
    }
  }
  DescriptionFile(const DescriptionFile&) = delete;
  DescriptionFile& operator=(const DescriptionFile&) = delete;
  ~DescriptionFile() { ::unlink(path_.c_str()); }
  const char* path() const { return path_.c_str(); }

 private:
  std::string path_;
};

}  // namespace

struct FakeHelios::Parts {
  Parts(const FrameSequence& shown_sequence, const CameraPlay& how, TruthRows* rows, std::int64_t began)
      : sequence(shown_sequence), play(how), truth(rows), began_ns(began) {}

  const FrameSequence& sequence;
  const CameraPlay& play;
  TruthRows* truth;
  std::int64_t began_ns;
  std::int64_t clock_began_ns = host::monotonic_now_ns();
  GObjectPtr<ArvGvFakeCamera> camera;
  std::atomic<std::uint64_t> frames{0};
  std::uint64_t shown = 0;  // of the reel
  std::int64_t last_camera_ns = 0;
  double lost_fraction = 0.0;  // as Aravis was told
  std::uint32_t ptp_state = kPtpDisabled;
  std::int64_t clock_began_camera_ns = std::llround(play.clock_start_s * kNanosecondsPerSecond);
  std::mt19937_64 jitter{std::hash<std::string>()(play.serial)};

  ArvFakeCamera* registers() const { return arv_gv_fake_camera_get_fake_camera(camera.get()); }
  std::uint32_t read(std::uint32_t address) const {
    std::uint32_t value = 0;
    arv_fake_camera_read_register(registers(), address, &value);
    return value;
  }
  void write(std::uint32_t address, std::uint32_t value) const {
    arv_fake_camera_write_register(registers(), address, value);
  }
  void write_text(std::uint32_t address, const std::string& text) const {
    std::array<char, kTextBytes> padded{};
    std::copy_n(text.data(), std::min(text.size(), kTextBytes - 1), padded.data());
    arv_fake_camera_write_memory(registers(), address, kTextBytes, padded.data());
  }
  void write_mm(std::uint32_t address, double metres) const {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(metres * kMmPerM);
    write(address, static_cast<std::uint32_t>(bits >> 32));
    write(address + 4, static_cast<std::uint32_t>(bits & 0xFFFFFFFF));
  }
  WireScale scale_of(std::size_t mode) const;
  void set_up() const;
  void fill(ArvBuffer* buffer, std::uint32_t format);
  void apply_ptp(double time_s);
  void lose(double fraction);
  std::int64_t camera_time_ns(std::int64_t utc_ns, std::int64_t monotonic_ns) const;
  void take_picture(std::int64_t utc_ns);
};

WireScale FakeHelios::Parts::scale_of(std::size_t mode) const {
  const double scale_m = mode < kFineModes ? play.fine_scale_m : play.scale_m;
  constexpr double kMiddle = 32'768.0;  // the optical axis is in the middle of X and Y
  return {{scale_m, scale_m, scale_m}, {-kMiddle * scale_m, -kMiddle * scale_m, 0.0}};
}

void FakeHelios::Parts::set_up() const {
  write_text(kVendorText, "LUCID Vision Labs");
  write_text(kModelText, play.grey ? "PHX050S-M (simulated)" : "HLS003S-001 (simulated)");
  const auto width = static_cast<std::uint32_t>(sequence.width_px);
  const auto height = static_cast<std::uint32_t>(sequence.height_px);
  write(ARV_FAKE_CAMERA_REGISTER_SENSOR_WIDTH, width);
  write(ARV_FAKE_CAMERA_REGISTER_SENSOR_HEIGHT, height);
  write(ARV_FAKE_CAMERA_REGISTER_WIDTH, width);
  write(ARV_FAKE_CAMERA_REGISTER_HEIGHT, height);
  write(ARV_FAKE_CAMERA_REGISTER_PIXEL_FORMAT, first_format(offered_by(play)));
  write(ARV_FAKE_CAMERA_REGISTER_ACQUISITION_FRAME_PERIOD_US,
        static_cast<std::uint32_t>(std::lround(kUsPerSecond / play.frame_rate_hz)));
  write(kPtpStatusRegister, ptp_state);
  if (play.grey) return;
  const auto mode = std::find(kHeliosModes.begin(), kHeliosModes.end(), play.mode);
  if (mode == kHeliosModes.end()) throw host::InputError("--mode " + play.mode + ": the Helios has no such mode");
  write(kModeRegister, static_cast<std::uint32_t>(mode - kHeliosModes.begin()));
  for (std::uint32_t i = 0; i < kHeliosModes.size(); ++i) {
    const WireScale wire = scale_of(i);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      write_mm(kScaleTable + i * kModeStride + axis * kAxisStride, wire.scale_m[axis]);
      write_mm(kOffsetTable + i * kModeStride + axis * kAxisStride, wire.offset_m[axis]);
    }
  }
}

// A latch is answered at the next frame: Aravis does not tell when it is written.
void FakeHelios::Parts::apply_ptp(double time_s) {
  const bool enabled = read(kPtpEnableRegister) != 0;
  const bool master = play.ptp && !any_holds(play.ptp_masterless, time_s);
  const std::uint32_t state = !enabled ? kPtpDisabled : master ? kPtpSlave : kPtpListening;
  if (ptp_state == kPtpSlave && state != kPtpSlave) {  // it runs on from the time that it has
    clock_began_camera_ns = host::utc_now_ns();
    clock_began_ns = host::monotonic_now_ns();
  }
  ptp_state = state;
  if (read(kPtpLatchRegister) == 0) return;
  write(kPtpLatchRegister, 0);
  write(kPtpStatusRegister, ptp_state);
}

std::int64_t FakeHelios::Parts::camera_time_ns(std::int64_t utc_ns, std::int64_t monotonic_ns) const {
  if (ptp_state == kPtpSlave) return utc_ns;
  const double since_start_ns = static_cast<double>(monotonic_ns - clock_began_ns);
  return clock_began_camera_ns + std::llround(since_start_ns * (1.0 + play.clock_ppm * 1e-6));
}

// Which frame is shown, and the time that the camera tells of it.
void FakeHelios::Parts::take_picture(std::int64_t utc_ns) {
  const std::int64_t now_ns = host::monotonic_now_ns();
  if (!play.grey) {
    ++shown;
    last_camera_ns = camera_time_ns(utc_ns, now_ns);
    return;
  }
  // Aravis sends at the beats of UTC: the trigger was the last one.
  const auto period_ns = static_cast<std::int64_t>(read(ARV_FAKE_CAMERA_REGISTER_ACQUISITION_FRAME_PERIOD_US)) * 1000;
  const std::int64_t since_trigger_ns = utc_ns % period_ns;
  shown = static_cast<std::uint64_t>(utc_ns / period_ns) + 1;
  const double off_ns =
      std::normal_distribution<double>(0.0, 1.0)(jitter) * play.clock_jitter_s * kNanosecondsPerSecond;
  last_camera_ns = camera_time_ns(utc_ns - since_trigger_ns, now_ns - since_trigger_ns) + std::llround(off_ns);
}

void FakeHelios::Parts::lose(double fraction) {
  if (fraction != lost_fraction) g_object_set(camera.get(), "gvsp-lost-ratio", fraction, nullptr);
  lost_fraction = fraction;
}

// In the thread of Aravis that also answers the control channel: must be over within a frame.
void FakeHelios::Parts::fill(ArvBuffer* buffer, std::uint32_t format) {
  const double time_s = static_cast<double>(host::monotonic_now_ns() - began_ns) / kNanosecondsPerSecond;
  apply_ptp(time_s);
  const std::int64_t utc_ns = host::utc_now_ns();
  const bool frozen = any_holds(play.freezes, time_s) && shown > 0;
  if (!frozen) take_picture(utc_ns);
  arv_buffer_set_timestamp(buffer, static_cast<guint64>(last_camera_ns));
  write(kClockRegister, static_cast<std::uint32_t>(static_cast<std::uint64_t>(last_camera_ns) >> 32));
  write(kClockRegister + 4, static_cast<std::uint32_t>(last_camera_ns & 0xFFFFFFFF));
  const SequenceFrame& frame = sequence.at(shown - 1);
  std::size_t received = 0;  // what a receiver would have got; the memory is as large as the payload
  auto* data = static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &received)));
  const WireScale wire = play.grey ? WireScale() : scale_of(read(kModeRegister));
  write_payload(sequence, frame, format, wire, {data, arv_fake_camera_get_payload(registers())});
  if (truth != nullptr && frame.T_camera_target && !frozen) truth->add(utc_ns, *frame.T_camera_target);
  lose(any_holds(play.stalls, time_s) ? 1.0 : play.loss);
  frames.fetch_add(1, std::memory_order_relaxed);
}

FakeHelios::FakeHelios(const FrameSequence& sequence, const CameraPlay& play, TruthRows* truth, std::int64_t began_ns)
    : parts_(std::make_unique<Parts>(sequence, play, truth, began_ns)) {
  const DescriptionFile description(helios_description(offered_by(play), play.ptp_names, play.ptp_refused));
  parts_->camera.reset(arv_gv_fake_camera_new_full(play.address.c_str(), play.serial.c_str(), description.path()));
  if (arv_gv_fake_camera_is_running(parts_->camera.get()) == 0) {
    throw host::InputError("no camera can be served at " + play.address +
                           ": give an address of this computer (ip address), where nothing else serves UDP port 3956");
  }
  parts_->set_up();
  const auto fill = [](ArvBuffer* buffer, void* parts, guint32, guint32, ArvPixelFormat format) {
    static_cast<Parts*>(parts)->fill(buffer, static_cast<std::uint32_t>(format));
  };
  arv_fake_camera_set_fill_pattern(parts_->registers(), fill, parts_.get());
}

FakeHelios::~FakeHelios() = default;

std::uint64_t FakeHelios::frames() const { return parts_->frames.load(std::memory_order_relaxed); }

}  // namespace pharos::sim
