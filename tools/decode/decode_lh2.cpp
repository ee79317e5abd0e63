// SPDX-License-Identifier: Apache-2.0
// pharos decode --lh2-light: raw light of Lighthouse 2.0 to hits, to each burst's bits, or to the stations' OOTX.
#include "tools/decode/decode_lh2.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>

#include "host/table/lh2_light_reader.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/lh2_light_decoder.hpp"
#include "pharos/lighthouse/lh2_ootx_fields.hpp"
#include "tools/decode/lh2_rows.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/words.hpp"

namespace pharos::tools {
namespace {

using lighthouse::Lh2Beam;
using lighthouse::Lh2Bits;

constexpr double kSecondsPerSixth = kSecondsPerTick / lighthouse::kSixthsPerTick;

const std::vector<std::string> kBitColumns = {"time_s", "sensor",    "channel",     "slow_bit", "offset_bits", "sync_s",
                                              "axis",   "theta_rad", "width_ticks", "agreeing", "bits_time_s", "bits"};

double seconds(std::int64_t sixths) { return static_cast<double>(sixths) * kSecondsPerSixth; }

// Bits as they came: 0 and 1, x where a boundary was missing.
std::string text_of(const Lh2Bits& bits) {
  std::string text;
  for (std::size_t i = 0; i < bits.count; ++i) text += !bits.is_clean(i) ? 'x' : bits.value(i) ? '1' : '0';
  return text;
}

// Each burst alone: its bits, and what they say without a rotor's history.
class BitWriter {
 public:
  explicit BitWriter(host::RowWriter& rows) : rows_(rows) {}

  void push(const lighthouse::Lh2Edge& edge) {
    if (const auto burst = collector_.push(edge, counters_)) write(*burst);
  }
  void flush() {
    while (const auto burst = collector_.flush(counters_)) write(*burst);
  }
  const lighthouse::Lh2Counters& counters() const { return counters_; }

 private:
  void write(const lighthouse::Lh2Burst& burst) {
    const std::optional<Lh2Bits> bits = biphase_bits(burst);
    if (!bits) {
      ++counters_.bursts_no_clock;
      return;
    }
    const std::optional<Lh2Beam> beam = identify(*bits, lighthouse::kAllLh2Channels, sequences_);
    ++(beam ? counters_.beams : counters_.bursts_unknown);
    if (beam) {
      write_beam(*beam);
    } else {
      rows_.number(ticks_to_seconds(burst.start_ticks)).integer(burst.sensor).none(8);
    }
    rows_.number(seconds(bits->start_sixths)).text(text_of(*bits)).end_row();
  }

  void write_beam(const Lh2Beam& beam) {
    const std::int64_t place = std::int64_t{beam.place} * lighthouse::kBit_sixths;
    lighthouse::Lh2Sweep sweep;
    sweep.channel = beam.channel;
    const auto centre = static_cast<std::int32_t>(place + beam.centre_sixths - beam.time_sixths);
    sweep.plane = lighthouse::lh2_plane_of(centre, beam.channel);
    rows_.number(seconds(beam.centre_sixths)).integer(beam.sensor).integer(beam.channel).integer(beam.slow_bit ? 1 : 0);
    rows_.number(static_cast<double>(centre) / lighthouse::kBit_sixths).number(seconds(beam.time_sixths - place));
    rows_.text(sweep.plane == 0 ? "a" : "b").number(lh2_hit_angle(sweep, {beam.sensor, beam.width_ticks, centre}));
    rows_.integer(beam.width_ticks).integer(beam.bits);
  }

  host::RowWriter& rows_;
  lighthouse::Lh2BurstCollector collector_;
  lighthouse::Lh2Sequences sequences_;
  lighthouse::Lh2Counters counters_;
};

void print_statistics(const lighthouse::Lh2Counters& counters) {
  lighthouse::for_each_counter(counters, [](const char* name, std::uint32_t value, const char* text) {
    std::fprintf(stderr, "%-24s %10" PRIu32 "  %s\n", name, value, text);
  });
}

void finish(const host::Lh2LightReader& reader, Output& output, const lighthouse::Lh2Counters& counters,
            bool statistics) {
  output.finish();
  if (reader.ended_unfinished()) note(reader.name() + ": its last line was cut off and is not used");
  if (statistics) print_statistics(counters);
}

// A hit table or an OOTX table without a row.
int no_row(const std::string& name, bool ootx) {
  note(name + (ootx ? ": no OOTX frame; it takes 10 s of light of one station, record longer"
                    : ": no hit; --bits shows each burst, --stats what became of the light"));
  return kExitNoAnswer;
}

int write_bits(host::Lh2LightReader& reader, bool statistics, const OutputOptions& options) {
  Output output(options, kBitColumns);
  const auto writer = std::make_unique<BitWriter>(output.rows());
  while (const auto edge = reader.next()) writer->push(*edge);
  writer->flush();
  finish(reader, output, writer->counters(), statistics);
  if (output.rows().rows() > 0) return kExitAnswered;
  note(reader.name() + ": no burst of 17 bits; --stats says what became of its light");
  return kExitNoAnswer;
}

int write_decoded(host::Lh2LightReader& reader, bool ootx, bool statistics, const OutputOptions& options) {
  Output output(options, ootx ? lh2_ootx_columns() : lh2_hit_columns());
  Progress progress("decode", "sweeps");
  const auto sequences = std::make_unique<lighthouse::Lh2Sequences>();
  const auto decoder = std::make_unique<lighthouse::Lh2LightDecoder>(*sequences);
  Lh2HitRows hits(output.rows());
  const auto take = [&] {
    while (const auto payload = decoder->take_ootx()) {
      hits.name_station(*payload);
      if (ootx) write_lh2_payload(*payload, output.rows());
    }
    while (const auto sweep = decoder->take_sweep()) {
      progress.step();
      if (!ootx) hits.push(*sweep);
    }
  };
  while (const auto edge = reader.next()) {
    decoder->push(*edge);
    take();
  }
  decoder->flush();
  take();
  hits.flush();
  finish(reader, output, decoder->counters(), statistics);
  return output.rows().rows() > 0 ? kExitAnswered : no_row(reader.name(), ootx);
}

}  // namespace

int decode_lh2_stream(Recording& recording, const RecordingEvent& first, Lh2Rows what, bool statistics,
                      const OutputOptions& options) {
  const bool ootx = what == Lh2Rows::kOotx;
  Output output(options, ootx ? lh2_ootx_columns() : lh2_hit_columns());
  Progress progress("decode", "sweeps");
  Lh2HitRows hits(output.rows());
  recording.on_pause([&output] { output.rows().flush(); });
  for (std::optional<RecordingEvent> event = first; event; event = recording.next()) {
    if (const auto* report = std::get_if<report::Lh2OotxReport>(&*event)) {
      hits.name_station(report->payload);
      if (ootx) write_lh2_payload(report->payload, output.rows());
    } else if (const auto* sweep = std::get_if<lighthouse::Lh2Sweep>(&*event)) {
      progress.step();
      if (!ootx) hits.push(*sweep);
    }
  }
  recording.on_pause({});
  hits.flush();
  output.finish();
  recording.print_remarks();
  if (statistics) recording.print_statistics();
  return output.rows().rows() > 0 ? kExitAnswered : no_row(recording.name(), ootx);
}

int decode_lh2_light(const std::string& path, Lh2Rows what, bool statistics, const OutputOptions& output) {
  host::Lh2LightReader reader{host::ByteSource(path)};
  if (what == Lh2Rows::kBits) return write_bits(reader, statistics, output);
  return write_decoded(reader, what == Lh2Rows::kOotx, statistics, output);
}

}  // namespace pharos::tools
