// SPDX-License-Identifier: Apache-2.0
#include "host/gige/program_options.hpp"

#include <CLI/CLI.hpp>

namespace pharos::host {

void add_camera_program_options(CLI::App& app) {
  app.description("Operates one GigE Vision camera for pharosd, which starts it");
  app.set_version_flag("--version", PHAROS_VERSION);
  app.footer(
      "Example: pharos-camera --version\nIs not started by hand: pharosd starts one process for each camera of its "
      "configuration, sends it the camera's settings over a socket and takes frames from shared memory. Faults that "
      "packets cause in the library that parses them stay in this process, and pharosd starts it again.\nEnds with 0 "
      "when pharosd closes the socket, with 1 when the camera cannot be operated, with 2 when it was not started by "
      "pharosd of the same version.");
}

}  // namespace pharos::host
