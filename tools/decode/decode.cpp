// SPDX-License-Identifier: Apache-2.0
// pharos decode: light pulses to bearings, or to the stations' OOTX.
#include <CLI/CLI.hpp>
#include <array>
#include <bitset>

#include "host/support/input_error.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/bearing.hpp"
#include "pharos/lighthouse/ootx_fields.hpp"
#include "tools/decode/decode_lh2.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/recording.hpp"
#include "tools/support/stations.hpp"
#include "tools/support/words.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos decode hmd_static.edges.csv.gz --stats > bearings.csv\n"
    "  pharos decode hmd_static.edges.csv.gz --ootx\n"
    "  pharos decode --lh2-light light.csv.gz > sweeps.csv\n"
    "theta_rad is the raw angle 2 pi (hit - flash) / turn, before the station's model; a quarter turn is straight\n"
    "ahead. station is 0 for the first flash of a slot (or a lone station), 1 for the second. flags: period_nominal,\n"
    "flash_weak, lock_poor, several (the sensor was hit more than once in this sweep: reflections).\n"
    "Of a target of Lighthouse 2.0 (its recorded serial stream, or --lh2-light): station is the channel, axis a or b\n"
    "the laser plane, theta_rad 0 straight ahead, growing to the station's left; the rows are those of pharos track\n"
    "--sweeps. sync_s and offset_bits: the turn's sync, and the light's middle in bits of 6 Mbit/s after it.\n"
    "--bits: each burst alone, with its bits (x: unclear).";

const std::vector<std::string> kBearingColumns = {"time_s", "station",   "station_id",  "axis",
                                                  "sensor", "theta_rad", "width_ticks", "flags"};
const std::vector<std::string> kOotxColumns = {
    "time_s",   "station",  "station_id", "payload_hex", "phase0",  "phase1",  "tilt0",        "tilt1",
    "curve0",   "curve1",   "gibphase0",  "gibphase1",   "gibmag0", "gibmag1", "mode",         "faults",
    "firmware", "protocol", "hardware",   "accel_x",     "accel_y", "accel_z", "unlock_count",
};

struct Options {
  std::string edges;
  bool ootx = false;
  bool stats = false;
  bool smooth = false;
  bool lh2_light = false;
  bool bits = false;
  OutputOptions output;
};

// One smoother a rotor.
class Smoothers {
 public:
  lighthouse::SweepBearings bearings(const lighthouse::Sweep& sweep) {
    const auto axis = static_cast<std::size_t>(index_of(sweep.flash.axis));
    return lighthouse::bearings_of(sweep, smoother_[sweep.flash.station][axis].push(sweep));
  }

 private:
  std::array<std::array<lighthouse::FlashSmoother, kAxes>, kMaxStations> smoother_;
};

std::bitset<256> sensors_hit_twice(const lighthouse::SweepBearings& bearings) {
  std::bitset<256> once;
  std::bitset<256> twice;
  for (const lighthouse::Bearing& bearing : bearings) {
    if (once.test(bearing.sensor)) twice.set(bearing.sensor);
    once.set(bearing.sensor);
  }
  return twice;
}

void write_bearings(const lighthouse::Sweep& sweep, const lighthouse::SweepBearings& bearings,
                    const std::string& station_id, host::RowWriter& rows) {
  const std::string words = sweep_flag_words(sweep.flags);
  const std::bitset<256> twice = sensors_hit_twice(bearings);
  const char axis = name_of(sweep.flash.axis);
  for (const lighthouse::Bearing& bearing : bearings) {
    rows.number(ticks_to_seconds(bearing.time_ticks)).integer(sweep.flash.station).text(station_id);
    rows.text({&axis, 1}).integer(bearing.sensor).number(bearing.theta_rad).integer(bearing.width_ticks);
    const char* separator = words.empty() ? "" : "|";
    rows.text(twice.test(bearing.sensor) ? words + separator + "several" : words);
    rows.end_row();
  }
}

void write_fields(const lighthouse::OotxFields& fields, host::RowWriter& rows) {
  const auto& rotor = fields.calibration.rotor;
  for (const auto& r : rotor) rows.number(r.phase_rad);
  for (const auto& r : rotor) rows.number(r.tilt_rad);
  for (const auto& r : rotor) rows.number(r.curve_rad);
  for (const auto& r : rotor) rows.number(r.gibbous_phase_rad);
  for (const auto& r : rotor) rows.number(r.gibbous_magnitude_rad);
  rows.integer(fields.mode).integer(fields.faults).integer(fields.firmware).integer(fields.protocol);
  rows.integer(fields.hardware);
  for (const std::int8_t a : fields.acceleration) rows.integer(a);
  rows.integer(fields.unlock_count);
}

void write_payload(const lighthouse::OotxPayload& payload, host::RowWriter& rows) {
  const std::span<const std::uint8_t> bytes(payload.bytes.data(), payload.bytes.size());
  rows.number(ticks_to_seconds(payload.time_ticks)).integer(payload.station);
  const auto fields = lighthouse::ootx_fields(bytes);
  rows.text(fields ? station_id_text(fields->calibration.id) : "").text(hex_text(bytes));
  if (fields) {
    write_fields(*fields, rows);
  } else {
    rows.none(kOotxColumns.size() - 4);
  }
  rows.end_row();
}

int run_lh2(const Options& options) {
  if (options.smooth) throw host::InputError("--smooth is for the flashes of Lighthouse 1.0; leave it out");
  if (options.ootx && options.bits) throw host::InputError("--ootx and --bits: choose one");
  const Lh2Rows what = options.ootx ? Lh2Rows::kOotx : options.bits ? Lh2Rows::kBits : Lh2Rows::kHits;
  return decode_lh2_light(options.edges, what, options.stats, options.output);
}

int run(const Options& options) {
  if (options.lh2_light) return run_lh2(options);
  if (options.bits) throw host::InputError("--bits needs --lh2-light");
  Stations stations = options.ootx ? Stations{} : read_ahead(options.edges);
  Recording recording(options.edges);
  std::optional<RecordingEvent> event;
  if (recording.is_serial()) event = recording.next();
  if (event && is_lh2(*event)) {
    if (options.smooth) throw host::InputError("--smooth is for the flashes of Lighthouse 1.0; leave it out");
    return decode_lh2_stream(recording, *event, options.ootx ? Lh2Rows::kOotx : Lh2Rows::kHits, options.stats,
                             options.output);
  }
  Output output(options.output, options.ootx ? kOotxColumns : kBearingColumns);
  Progress progress("decode", "sweeps");
  Smoothers smoothers;
  recording.on_pause([&output] { output.rows().flush(); });
  if (!event) event = recording.next();  // of a table: after its header was written
  for (; event; event = recording.next()) {
    if (const auto* payload = std::get_if<lighthouse::OotxPayload>(&*event)) {
      stations.push(*payload);
      if (options.ootx) write_payload(*payload, output.rows());
    } else if (const auto* sweep = std::get_if<lighthouse::Sweep>(&*event); sweep != nullptr && !options.ootx) {
      const auto bearings = options.smooth ? smoothers.bearings(*sweep) : lighthouse::bearings_of(*sweep);
      write_bearings(*sweep, bearings, station_id_text(stations.id(sweep->flash.station)), output.rows());
      progress.step();
    }
  }
  output.finish();
  recording.print_remarks();
  if (options.stats) recording.print_statistics();
  if (output.rows().rows() > 0) return kExitAnswered;
  note(recording.name() + (options.ootx ? ": no OOTX frame; it takes 3 s of unbroken light, record longer"
                                        : ": no bearing; --stats says what became of its pulses"));
  return kExitNoAnswer;
}

}  // namespace

void add_decode(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("decode", "Light pulses to bearings, or (--ootx) to the stations' own data");
  const auto options = std::make_shared<Options>();
  command
      ->add_option(
          "EDGES", options->edges,
          "Table sensor,rise_ticks,fall_ticks (20 ns ticks) or a recorded serial stream; .gz; - is standard input")
      ->required();
  command->add_flag("--lh2-light", options->lh2_light,
                    "EDGES is raw light of Lighthouse 2.0: sensor,time_ticks,data,envelope (20 ns ticks), or a logic\n"
                    "analyser's table of one receiver: Time[s],DATA[,ENVELOPE]");
  command->add_flag("--bits", options->bits, "With --lh2-light: each burst of light and its bits");
  command->add_flag("--ootx", options->ootx, "The OOTX payloads instead of bearings");
  command->add_flag("--stats", options->stats, "Every counter at the end, on standard error");
  command->add_flag("--smooth", options->smooth, "Smooth flash times with earlier flashes of the same rotor");
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
