// SPDX-License-Identifier: Apache-2.0
// pharos-manual: writes the manual pages and completions of all programs from their definitions. Not installed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/daemon/program_options.hpp"
#include "host/gige/program_options.hpp"
#include "tools/cli/program.hpp"
#include "tools/manual/completion.hpp"
#include "tools/manual/description.hpp"
#include "tools/manual/man_page.hpp"

namespace {

using namespace pharos;
namespace fs = std::filesystem;

constexpr int kExitUsage = 2;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

void write_pages(const fs::path& folder, const tools::CommandDescription& command, const tools::PageFrame& frame) {
  write(folder / "man" / (command.name('-') + "." + std::to_string(frame.section)), tools::man_page(command, frame));
  for (const tools::CommandDescription& inner : command.commands) {
    tools::PageFrame inner_frame = frame;
    inner_frame.see_also.clear();
    write_pages(folder, inner, inner_frame);
  }
}

void write_completions(const fs::path& folder, const tools::CommandDescription& program) {
  write(folder / "bash" / program.words.front(), tools::bash_completion(program));
  write(folder / "zsh" / ("_" + program.words.front()), tools::zsh_completion(program));
}

void write_manual(const fs::path& folder) {
  int exit_code = 0;
  CLI::App pharos_app("", "pharos");
  tools::add_program(pharos_app, exit_code);
  const tools::CommandDescription pharos = tools::describe(pharos_app);
  write_pages(folder, pharos,
              {1,
               PHAROS_VERSION,
               "0: at least one result. 1: none. 2: wrong usage or unreadable input, with one line on standard error "
               "that says what, where and what to do.",
               {"pharosd(8)", "pharosd.toml(5)", "pharos-tables(5)"}});
  write_completions(folder, pharos);

  CLI::App daemon_app("", "pharosd");
  host::ProgramOptions daemon_options;
  host::add_program_options(daemon_app, daemon_options);
  const tools::CommandDescription daemon = tools::describe(daemon_app);
  write_pages(folder, daemon, {8, PHAROS_VERSION, "", {"pharosd.toml(5)", "pharos(1)", "pharos-lcm(7)"}});
  write_completions(folder, daemon);

  CLI::App camera_app("", "pharos-camera");
  host::add_camera_program_options(camera_app);
  write_pages(folder, tools::describe(camera_app), {8, PHAROS_VERSION, "", {"pharosd(8)", "pharosd.toml(5)"}});
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes the manual pages and completions of all programs into FOLDER/man, /bash and /zsh",
               "pharos-manual");
  std::string folder;
  app.add_option("FOLDER", folder, "Folder to write to")->required();
  try {
    app.parse(argc, argv);
    write_manual(folder);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pharos-manual: %s\n", error.what());
    return 1;
  }
  return 0;
}
