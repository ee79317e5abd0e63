// SPDX-License-Identifier: Apache-2.0
#include "host/gige/gige_camera.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "host/device/pixel_format.hpp"
#include "host/gige/camera_ptp.hpp"
#include "host/gige/camera_time.hpp"
#include "host/gige/device_feature.hpp"
#include "host/gige/find_camera.hpp"
#include "host/gige/frame_numbers.hpp"
#include "host/gige/gobject.hpp"
#include "host/gige/heartbeat.hpp"
#include "host/gige/stream_guard.hpp"
#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

// Requested receive buffer of the kernel; net.core.rmem_max limits it.
constexpr int kSocketBytes = 8 << 20;
// If formats alternate: maximum time for the other format's frame, including a stop and a start of the camera.
constexpr std::chrono::milliseconds kOtherFormatTimeout{1000};
// A frame may contain chunk data (metadata of the camera) in addition to the pixels.
constexpr std::size_t kMaxChunks_bytes = 65'536;
constexpr std::chrono::milliseconds kTakeWhileLearning{1};

[[noreturn]] void refuse(const std::string& message) { throw CameraError(CameraState::kWrong, message); }

/// A comma-separated list of the camera's names, for messages.
std::string list_of(const char* const* words, guint count) {
  std::string list;
  for (guint i = 0; i < count; ++i) list += (i == 0 ? "" : ", ") + std::string(words[i]);
  return list;
}

std::uint32_t code_of(CameraFormat format) {
  if (format == CameraFormat::kDepth) return kCoord3dAbcy16;
  return format == CameraFormat::kMono8 ? kMono8 : kMono16;
}

const char* name_of(CameraFormat format) {
  if (format == CameraFormat::kDepth) return "Coord3D_ABCY16";
  return format == CameraFormat::kMono8 ? "Mono8" : "Mono16";
}

std::uint32_t format_of(ArvBuffer* buffer) {
  return static_cast<std::uint32_t>(arv_buffer_get_image_pixel_format(buffer));
}

}  // namespace

struct GigeCamera::Parts {
  CameraSettings settings;
  GObjectPtr<ArvCamera> camera;
  GObjectPtr<ArvStream> stream;
  std::optional<Heartbeat> heartbeat;
  std::optional<CameraTime> time;
  std::optional<CameraPtp> ptp;  // if it is to be followed
  StreamGuard guard;
  std::uint64_t packets_per_frame = 1;
  bool believe_source_port = true;
  std::string identity;
  std::string address;
  bool in_turns = false;
  std::optional<CoordinateScale> scale;
  FrameNumbers numbers;

  bool is_depth() const { return settings.format == CameraFormat::kDepth; }
  bool has(const char* feature) const { return has_feature(arv_camera_get_device(camera.get()), feature); }
  bool offers_format(const char* format) const {
    ArvError error;
    return arv_camera_is_enumeration_entry_available(camera.get(), "PixelFormat", format, error.out()) != 0 && !error;
  }
  std::string word(const char* feature) const {
    ArvError error;
    const char* text = arv_camera_get_string(camera.get(), feature, error.out());
    return text == nullptr || error ? "" : text;
  }
  void set_word(const char* feature, const std::string& value, const char* key) const;
  void set_mode();
  void set_format();
  void set_packets();
  void check_size() const;
  void read_scale();
  void start_stream();
  std::size_t payload() const;
  void guard_stream(std::size_t payload_bytes);
  void start() const;
  void stop() const;
  void describe();

  GObjectPtr<ArvBuffer> pop(std::chrono::milliseconds timeout) const;
  void recycle(GObjectPtr<ArvBuffer> buffer) const;
  FrameOutcome outcome(ArvBuffer* buffer, std::uint32_t format, DepthFrame& about, const FrameImages& images,
                       std::int64_t& missing);
  bool unpack(ArvBuffer* buffer, std::uint32_t format, const FrameImages& images) const;
  FrameOutcome intensity_of(DepthFrame& about, const FrameImages& images);
};

void GigeCamera::Parts::set_word(const char* feature, const std::string& value, const char* key) const {
  ArvError error;
  arv_camera_set_string(camera.get(), feature, value.c_str(), error.out());
  if (!error) return;
  guint count = 0;
  ArvError ignored;
  const GMemory<const char*> words(
      arv_camera_dup_available_enumerations_as_strings(camera.get(), feature, &count, ignored.out()));
  refuse("the camera does not take " + std::string(key) + " \"" + value + "\"" +
         (words ? "; it knows " + list_of(words.get(), count) : ": " + error.text()));
}

void GigeCamera::Parts::set_mode() {
  if (settings.mode.empty()) return;
  if (!has("Scan3dOperatingMode"))
    refuse("the camera has no Scan3dOperatingMode: is it a depth camera? Or remove mode");
  set_word("Scan3dOperatingMode", settings.mode, "mode");
}

void GigeCamera::Parts::set_format() {
  if (!is_depth() || offers_format("Coord3D_ABCY16")) {
    set_word("PixelFormat", name_of(settings.format), "the pixel format");
  } else if (offers_format("Coord3D_C16") && offers_format("Mono16")) {
    in_turns = true;
    set_word("PixelFormat", "Coord3D_C16", "the pixel format");
  } else {
    guint count = 0;
    ArvError ignored;
    const GMemory<const char*> words(
        arv_camera_dup_available_pixel_formats_as_strings(camera.get(), &count, ignored.out()));
    refuse("the camera offers neither Coord3D_ABCY16 nor Coord3D_C16 with Mono16" +
           (words ? ", only " + list_of(words.get(), count) : std::string()));
  }
}

void GigeCamera::Parts::set_packets() {
  ArvError error;
  // Otherwise Aravis negotiates the size when the stream starts, and ends at 1400.
  arv_camera_gv_set_packet_size_adjustment(camera.get(), ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
  arv_camera_gv_set_packet_size(camera.get(), settings.packet_size, error.out());
  if (error)
    refuse("the camera does not take packet_size " + std::to_string(settings.packet_size) + ": " + error.text());
  if (settings.frame_rate_hz <= 0.0) return;
  arv_camera_set_frame_rate(camera.get(), settings.frame_rate_hz, error.out());
  if (error) refuse("the camera does not take frame_rate_hz: " + error.text());
}

void GigeCamera::Parts::check_size() const {
  ArvError error;
  gint x = 0;
  gint y = 0;
  gint width = 0;
  gint height = 0;
  arv_camera_get_region(camera.get(), &x, &y, &width, &height, error.out());
  if (error) throw CameraError(CameraState::kGone, "the camera does not tell its size: " + error.text());
  if (width == settings.width_px && height == settings.height_px) return;
  refuse("the camera gives " + std::to_string(width) + " x " + std::to_string(height) +
         " pixels, its camera file is for " + std::to_string(settings.width_px) + " x " +
         std::to_string(settings.height_px) + "; set one of them (binning changes the size)");
}

void GigeCamera::Parts::read_scale() {
  if (!is_depth() || !has("Scan3dCoordinateSelector") || !has("Scan3dCoordinateScale")) return;
  constexpr std::array<const char*, 3> kAxes{"CoordinateA", "CoordinateB", "CoordinateC"};
  constexpr double kMetresPerMillimetre = 1e-3;
  CoordinateScale read;
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    ArvError error;
    arv_camera_set_string(camera.get(), "Scan3dCoordinateSelector", kAxes[axis], error.out());
    if (error) refuse("the camera's coordinate scale cannot be read: " + error.text());
    const double scale_mm = arv_camera_get_float(camera.get(), "Scan3dCoordinateScale", error.out());
    if (error) refuse("the camera's coordinate scale cannot be read: " + error.text());
    const double offset_mm =
        has("Scan3dCoordinateOffset") ? arv_camera_get_float(camera.get(), "Scan3dCoordinateOffset", error.out()) : 0.0;
    if (error) refuse("the camera's coordinate offset cannot be read: " + error.text());
    read.scale_m[axis] = scale_mm * kMetresPerMillimetre;
    read.offset_m[axis] = offset_mm * kMetresPerMillimetre;
  }
  scale = read;
}

void GigeCamera::Parts::start_stream() {
  ArvError error;
  // A packet socket needs CAP_NET_RAW, which the service does not have. Without it, all users run the same code.
  arv_camera_gv_set_stream_options(camera.get(), ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  stream.reset(arv_camera_create_stream(camera.get(), nullptr, nullptr, error.out()));
  if (!stream) throw CameraError(CameraState::kGone, "the camera gives no stream: " + error.text());
  g_object_set(stream.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size", kSocketBytes,
               nullptr);
  const std::size_t bytes = payload();
  guard_stream(bytes);
  for (int i = 0; i < kBuffers; ++i) arv_stream_push_buffer(stream.get(), arv_buffer_new(bytes, nullptr));
  start();
}

/// Size of a frame as the camera reports it; checked, as memory is allocated for it.
std::size_t GigeCamera::Parts::payload() const {
  ArvError error;
  const std::size_t bytes = arv_camera_get_payload(camera.get(), error.out());
  if (error) throw CameraError(CameraState::kGone, "the camera does not tell its payload: " + error.text());
  const std::uint32_t format = in_turns ? kCoord3dC16 : code_of(settings.format);
  const std::size_t pixels = payload_bytes(format, settings.width_px, settings.height_px);
  if (bytes >= pixels && bytes <= pixels + kMaxChunks_bytes) return bytes;
  refuse("the camera says that a frame has " + std::to_string(bytes) + " bytes; " + std::to_string(settings.width_px) +
         " x " + std::to_string(settings.height_px) + " pixels have " + std::to_string(pixels));
}

void GigeCamera::Parts::guard_stream(std::size_t payload_bytes) {
  StreamRule rule;
  rule.camera_address = ip_of(camera.get());
  rule.payload_bytes = payload_bytes;
  rule.packet_size = static_cast<std::size_t>(settings.packet_size);
  if (const std::string mode = word("GevGVSPExtendedIDMode"); !mode.empty()) rule.extended_ids = mode == "On";
  ArvError error;
  const gint64 port =
      arv_device_get_integer_feature_value(arv_camera_get_device(camera.get()), "ArvGevSCSP", error.out());
  if (believe_source_port && !error && port > 0 && port <= 0xFFFF) rule.source_port = static_cast<std::uint16_t>(port);
  packets_per_frame = std::max<std::uint64_t>(1, payload_bytes / rule.packet_size);
  guard = StreamGuard(arv_gv_stream_get_port(ARV_GV_STREAM(stream.get())), rule);
}

void GigeCamera::Parts::start() const {
  ArvError error;
  arv_camera_start_acquisition(camera.get(), error.out());
  if (error) throw CameraError(CameraState::kGone, "the camera does not start: " + error.text());
}

void GigeCamera::Parts::stop() const {
  ArvError ignored;
  arv_camera_stop_acquisition(camera.get(), ignored.out());
}

void GigeCamera::Parts::describe() {
  identity = word("DeviceVendorName") + ' ' + word("DeviceModelName") + ' ' + serial_of(camera.get());
  if (const std::string mode = word("Scan3dOperatingMode"); !mode.empty()) identity += ", " + mode;
  identity += in_turns ? ", Coord3D_C16 and Mono16 in turns" : std::string(", ") + name_of(settings.format);
  identity += ", packets of " + std::to_string(settings.packet_size);
}

GigeCamera::GigeCamera(const CameraSettings& settings, bool believe_source_port) : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  parts.settings = settings;
  parts.believe_source_port = believe_source_port;
  parts.camera = find_camera(settings);
  guard_control_sockets(ip_of(parts.camera.get()));
  parts.address = address_of(parts.camera.get());
  parts.stop();  // a client that died may have left the stream running
  parts.set_mode();
  parts.set_format();
  parts.set_packets();
  parts.check_size();
  parts.read_scale();  // depends on mode and format
  if (settings.ptp) parts.ptp.emplace(arv_camera_get_device(parts.camera.get()));
  parts.describe();
  parts.heartbeat.emplace(arv_camera_get_device(parts.camera.get()), ip_of(parts.camera.get()));
  parts.time.emplace(arv_camera_get_device(parts.camera.get()));
  parts.start_stream();
}

GigeCamera::~GigeCamera() {
  if (parts_->stream) parts_->stop();
}

std::int64_t GigeCamera::frames_passed_over() const {
  ArvStream* const stream = parts_->stream.get();
  if (arv_stream_get_info_uint64_by_name(stream, "n_underruns") > 0)
    return 0;  // then packets were ignored for lack of buffers
  const std::uint64_t packets = arv_stream_get_info_uint64_by_name(stream, "n_ignored_packets");
  return static_cast<std::int64_t>(packets / parts_->packets_per_frame);
}

void GigeCamera::beat_if_due() { parts_->heartbeat->beat_if_due(); }

void GigeCamera::read_clock() { parts_->time->read(); }

void GigeCamera::restore_heartbeat() { parts_->heartbeat->restore(); }

const std::string& GigeCamera::identity() const { return parts_->identity; }
const std::string& GigeCamera::address() const { return parts_->address; }

bool GigeCamera::is_controller() const {
  return arv_gv_device_is_controller(ARV_GV_DEVICE(arv_camera_get_device(parts_->camera.get()))) != 0;
}

std::int64_t GigeCamera::discarded_datagrams() const { return parts_->guard.discarded(); }

PtpState GigeCamera::ptp_state() const { return parts_->ptp ? parts_->ptp->read() : PtpState::kOff; }

GObjectPtr<ArvBuffer> GigeCamera::Parts::pop(std::chrono::milliseconds timeout) const {
  return GObjectPtr<ArvBuffer>(
      arv_stream_timeout_pop_buffer(stream.get(), static_cast<guint64>(std::chrono::microseconds(timeout).count())));
}

void GigeCamera::Parts::recycle(GObjectPtr<ArvBuffer> buffer) const {
  arv_stream_push_buffer(stream.get(), buffer.release());
}

bool GigeCamera::Parts::unpack(ArvBuffer* buffer, std::uint32_t format, const FrameImages& images) const {
  if (arv_buffer_get_payload_type(buffer) != ARV_BUFFER_PAYLOAD_TYPE_IMAGE || format_of(buffer) != format) return false;
  if (arv_buffer_get_image_width(buffer) != settings.width_px ||
      arv_buffer_get_image_height(buffer) != settings.height_px) {
    return false;
  }
  std::size_t size = 0;
  const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_data(buffer, &size));
  const std::span<const std::uint8_t> bytes(
      data, std::min(size, payload_bytes(format, settings.width_px, settings.height_px)));
  if (format == kMono8) return unpack_8(bytes, images.intensity);
  if (format == kCoord3dAbcy16) return unpack_abcy16(bytes, images.depth, images.intensity);
  return unpack_16(bytes, format == kMono16 ? images.intensity : images.depth);
}

FrameOutcome GigeCamera::Parts::outcome(ArvBuffer* buffer, std::uint32_t format, DepthFrame& about,
                                        const FrameImages& images, std::int64_t& missing) {
  // If depth and intensity alternate, frames are discarded at every change of the format: gaps in their numbers mean
  // nothing.
  const std::int64_t now_ns = monotonic_now_ns();
  const auto gap = in_turns ? 0 : numbers.missing_before(arv_buffer_get_frame_id(buffer), now_ns);
  missing += gap.value_or(0);
  const ArvBufferStatus status = arv_buffer_get_status(buffer);
  if (status == ARV_BUFFER_STATUS_SIZE_MISMATCH) return FrameOutcome::kWrongSize;
  if (status != ARV_BUFFER_STATUS_SUCCESS) return FrameOutcome::kIncomplete;
  if (!gap) return FrameOutcome::kOutOfOrder;
  if (!unpack(buffer, format, images)) return FrameOutcome::kWrongSize;
  about.width_px = settings.width_px;
  about.height_px = settings.height_px;
  about.camera_ns = static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer));
  about.complete_monotonic_ns = monotonic_now_ns();
  about.arrival_utc_ns = static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer));
  about.arrival_monotonic_ns = about.complete_monotonic_ns - (utc_now_ns() - about.arrival_utc_ns);
  about.taken_in_turns = in_turns;
  about.scale = scale;
  // PTP sets the camera's clock when it finds a master.
  if (!time->agrees(about.camera_ns, about.arrival_monotonic_ns) &&
      !(ptp && time->read_again(now_ns) && time->agrees(about.camera_ns, about.arrival_monotonic_ns))) {
    return FrameOutcome::kWrongTime;
  }
  return FrameOutcome::kFrame;
}

// After a depth frame: the intensity of the same view, from the next frame in the other format.
FrameOutcome GigeCamera::Parts::intensity_of(DepthFrame& about, const FrameImages& images) {
  stop();
  set_word("PixelFormat", "Mono16", "the pixel format");
  start();
  FrameOutcome outcome = FrameOutcome::kUnpaired;
  const std::int64_t until_ns = monotonic_now_ns() + std::chrono::nanoseconds(kOtherFormatTimeout).count();
  while (outcome == FrameOutcome::kUnpaired && monotonic_now_ns() < until_ns) {
    GObjectPtr<ArvBuffer> buffer = pop(kOtherFormatTimeout / 10);
    heartbeat->beat_if_due();
    if (!buffer) continue;
    if (arv_buffer_get_status(buffer.get()) == ARV_BUFFER_STATUS_SUCCESS && unpack(buffer.get(), kMono16, images)) {
      outcome = FrameOutcome::kFrame;
    }
    recycle(std::move(buffer));
  }
  stop();
  set_word("PixelFormat", "Coord3D_C16", "the pixel format");
  start();
  about.complete_monotonic_ns = monotonic_now_ns();
  return outcome;
}

FrameOutcome GigeCamera::next(DepthFrame& about, const FrameImages& images, std::chrono::milliseconds timeout,
                              std::int64_t& missing) {
  // Until the source port is known, the timeout is used to learn it; frames are still taken from the stream.
  const bool learning = parts_->guard.is_on() && !parts_->guard.knows_port();
  if (learning) parts_->guard.learn(timeout);
  GObjectPtr<ArvBuffer> buffer = parts_->pop(learning ? kTakeWhileLearning : timeout);
  if (!buffer) return FrameOutcome::kNone;
  if (parts_->in_turns && format_of(buffer.get()) == kMono16) {  // sent before the change of the format
    parts_->recycle(std::move(buffer));
    return FrameOutcome::kNone;
  }
  const std::uint32_t format = parts_->in_turns ? kCoord3dC16 : code_of(parts_->settings.format);
  const FrameOutcome outcome = parts_->outcome(buffer.get(), format, about, images, missing);
  parts_->recycle(std::move(buffer));
  return outcome == FrameOutcome::kFrame && parts_->in_turns ? parts_->intensity_of(about, images) : outcome;
}

}  // namespace pharos::host
