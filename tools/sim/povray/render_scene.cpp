// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/povray/render_scene.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "host/images/grey_image.hpp"
#include "host/support/exact_number.hpp"
#include "host/support/input_error.hpp"
#include "tools/sim/povray/temporary_folder.hpp"

namespace pharos::sim {
namespace {

std::string settings_text(const RenderSettings& settings) {
  std::ostringstream text;
  text << "Input_File_Name=scene.pov\nOutput_File_Name=scene.png\n"
       << "Width=" << settings.width_px << "\nHeight=" << settings.height_px << "\n"
       << "Display=off\nVerbose=off\nWork_Threads=" << settings.threads << "\n"
       << "Output_File_Type=N\nBits_Per_Color=16\nGrayscale_Output=on\nFile_Gamma=1.0\nDisplay_Gamma=1.0\n";
  if (settings.rays_per_side < 2) return text.str() + "Antialias=off\n";
  // Method 1 spreads its rays alike about the pixel's centre. Without the gamma it would average encoded light.
  text << "Antialias=on\nSampling_Method=1\nAntialias_Depth=" << settings.rays_per_side
       << "\nAntialias_Threshold=" << host::exact_number(settings.antialias_threshold)
       << "\nAntialias_Gamma=1.0\nJitter=off\n";
  return text.str();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw host::InputError(path.string() + ": cannot be written; is the disk full?");
}

// The environment with another HOME, so that no user's povray.ini is read.
std::vector<std::string> environment_at(const std::filesystem::path& home) {
  std::vector<std::string> variables{"HOME=" + home.string()};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (std::strncmp(*variable, "HOME=", 5) != 0 && std::strncmp(*variable, "POVINI=", 7) != 0) {
      variables.emplace_back(*variable);
    }
  }
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// The program's exit code; its output is stored in `log`.
int run_povray(const std::filesystem::path& directory, const std::filesystem::path& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  std::vector<std::string> words{"povray", "render.ini"};
  std::vector<std::string> variables = environment_at(directory);
  pid_t child = -1;
  const int failed =
      posix_spawnp(&child, "povray", &actions, nullptr, pointers_to(words).data(), pointers_to(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT)
    throw host::InputError("the program povray is missing: install povray (Debian's package povray)");
  if (failed != 0) throw host::InputError(std::string("povray cannot be started: ") + std::strerror(failed));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// The error in POV-Ray's output: from the line with "Error" on, or the last line.
std::string error_in(const std::filesystem::path& log) {
  std::ifstream file(log);
  std::string line;
  std::string complaint = "it said nothing";
  bool found = false;
  while (std::getline(file, line)) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.find("Fatal error in") == 0) continue;
    complaint = found ? complaint + ' ' + line : line;
    found = found || line.find("rror:") != std::string::npos;
  }
  return complaint;
}

}  // namespace

LinearImage render_scene(const std::string& scene, const RenderSettings& settings) {
  const TemporaryFolder directory("pharos-povray");
  write_text(directory.path() / "scene.pov", scene);
  write_text(directory.path() / "render.ini", settings_text(settings));
  const std::filesystem::path log = directory.path() / "log";
  const int code = run_povray(directory.path(), log);
  if (code != 0) {
    throw host::InputError("povray ended with " + std::to_string(code) + ": " + error_in(log));
  }
  const host::GreyImage grey = host::read_grey_image((directory.path() / "scene.png").string());
  LinearImage image{grey.width_px, grey.height_px, std::vector<float>(grey.pixels.size())};
  for (std::size_t i = 0; i < grey.pixels.size(); ++i) image.light[i] = static_cast<float>(grey.pixels[i]) / 65535.0F;
  return image;
}

}  // namespace pharos::sim
