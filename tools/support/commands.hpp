// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

// Exit codes of every subcommand.
inline constexpr int kExitAnswered = 0;  // at least one result
inline constexpr int kExitNoAnswer = 1;  // no result
inline constexpr int kExitUsage = 2;     // wrong usage or unreadable input

// Every subcommand adds itself to `app` with its options, help and example; its callback writes the program's exit
// code: kExitAnswered or kExitNoAnswer. Wrong usage and unreadable input are thrown as host::InputError (kExitUsage).
void add_decode(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_track(CLI::App& app, int& exit_code);
void add_solve(CLI::App& app, int& exit_code);
void add_precision(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);  // cli/calibrate
void add_reproduce(CLI::App& app, int& exit_code);
void add_sim(CLI::App& app, int& exit_code);         // tools/sim
void add_listen(CLI::App& app, int& exit_code);      // tools/listen
void add_watch(CLI::App& app, int& exit_code);       // tools/watch
void add_view(CLI::App& app, int& exit_code);        // tools/view
void add_export(CLI::App& app, int& exit_code);      // tools/export
void add_devices(CLI::App& app, int& exit_code);     // tools/devices
void add_init(CLI::App& app, int& exit_code);        // tools/init
void add_flash(CLI::App& app, int& exit_code);       // tools/flash
void add_bench(CLI::App& app, int& exit_code);       // tools/evaluation/bench
void add_evaluate(CLI::App& app, int& exit_code);    // tools/evaluate
void add_fuse(CLI::App& app, int& exit_code);        // tools/fuse
void add_layout(CLI::App& app, int& exit_code);      // tools/layout
void add_ellipses(CLI::App& app, int& exit_code);    // tools/ellipses
void add_ring2(CLI::App& app, int& exit_code);       // tools/ring2
void add_enhance(CLI::App& app, int& exit_code);     // tools/enhance
void add_tof(CLI::App& app, int& exit_code);         // tools/tof
void add_plot(CLI::App& app, int& exit_code);        // tools/plot_pages
void add_pointing(CLI::App& app, int& exit_code);    // tools/pointing
void add_slam(CLI::App& app, int& exit_code);        // tools/slam
void add_vocabulary(CLI::App& app, int& exit_code);  // tools/slam

inline void add_commands(CLI::App& app, int& exit_code) {
  add_decode(app, exit_code);
  add_convert(app, exit_code);
  add_track(app, exit_code);
  add_solve(app, exit_code);
  add_precision(app, exit_code);
  add_calibrate(app, exit_code);
  add_reproduce(app, exit_code);
  add_sim(app, exit_code);
  add_listen(app, exit_code);
  add_watch(app, exit_code);
  add_view(app, exit_code);
  add_export(app, exit_code);
  add_devices(app, exit_code);
  add_init(app, exit_code);
  add_flash(app, exit_code);
  add_bench(app, exit_code);
  add_evaluate(app, exit_code);
  add_fuse(app, exit_code);
  add_layout(app, exit_code);
  add_ellipses(app, exit_code);
  add_ring2(app, exit_code);
  add_enhance(app, exit_code);
  add_tof(app, exit_code);
  add_plot(app, exit_code);
  add_pointing(app, exit_code);
  add_slam(app, exit_code);
  add_vocabulary(app, exit_code);
}

}  // namespace pharos::tools
