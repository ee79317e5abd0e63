// SPDX-License-Identifier: Apache-2.0
// pharos export: a log of LCM to a file that other tools read.
#include <CLI/CLI.hpp>
#include <memory>

#include "host/files/atomic_file.hpp"
#include "tools/export/mcap_export.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  lcm-logger flight.lcm; pharos export flight.lcm --mcap flight.mcap\n"
    "LOG is a log of lcm-logger, or of pharosd with [lcm] url = \"file:///FILE?mode=w\". Each message becomes JSON, "
    "with all\n"
    "its fields as in proto/, on the topic /CHANNEL (schemas pharos.pose, pharos.pointing, pharos.spin, "
    "pharos.status,\n"
    "pharos.bearings, pharos.target_state, pharos.preview). Good poses (not refused, not ambiguous, with a measured "
    "turn;\n"
    "ring2's with a conventional one) and states without a conflict are also on /CHANNEL/transform "
    "(foxglove.FrameTransform)\n"
    "and /CHANNEL/pose (foxglove.PoseInFrame), counters by name on /CHANNEL/counters, pictures of cameras on\n"
    "/CHANNEL/SOURCE/image, of a rig /CHANNEL/SOURCE/VIEW/image (foxglove.CompressedImage). log_time is that of the "
    "log,\n"
    "publish_time that of the measurement.\n"
    "Messages that are none of Pharos' are skipped and counted by channel, damage of the log too.";

struct Options {
  std::string log;
  std::string mcap;
};

void note_channel(const std::string& channel, const ChannelCounts& counts) {
  std::string text = (channel.empty() ? "(no name)" : channel) + ": " + std::to_string(counts.exported) + " exported";
  if (counts.foreign > 0) text += ", " + std::to_string(counts.foreign) + " skipped: of no type of Pharos";
  if (counts.not_finite > 0) text += ", " + std::to_string(counts.not_finite) + " skipped: a number is not finite";
  if (counts.without_time > 0) text += ", " + std::to_string(counts.without_time) + " skipped: logged before 1970";
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  note(text);
}

void note_damage(const std::string& name, const LcmLogCounters& counters) {
  if (counters.damaged > 0) {
    note(name + ": damaged in " + std::to_string(counters.damaged) + " places, " +
         std::to_string(counters.bytes_skipped) + " bytes were skipped");
  }
  if (counters.cut_off) note(name + ": ends within a message, which was left out");
}

int run(const Options& options) {
  host::AtomicFile file(options.mcap);
  LcmLogReader log{host::ByteSource(options.log)};
  McapExport mcap(file.stream(), "pharos " PHAROS_VERSION);
  Progress progress("export", "messages");
  while (const auto message = log.next()) {
    mcap.push(*message);
    progress.step();
  }
  for (const auto& [channel, counts] : mcap.channels()) note_channel(channel, counts);
  note_damage(log.name(), log.counters());
  if (mcap.exported() == 0) {
    note(log.name() + ": no message of Pharos in it; " + options.mcap + " was not written");
    return kExitNoAnswer;
  }
  mcap.finish();
  file.commit();
  return kExitAnswered;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("export", "A log of LCM to MCAP, for Foxglove and other tools");
  const auto options = std::make_shared<Options>();
  command->add_option("LOG", options->log, "Log of LCM; .gz; - is standard input")->required();
  command->add_option("--mcap", options->mcap, "MCAP file to write")->required()->check(output_place());
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
