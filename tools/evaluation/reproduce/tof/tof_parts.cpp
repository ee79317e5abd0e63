// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/tof_parts.hpp"

#include "tools/calibrate/board_figure.hpp"
#include "tools/evaluation/reproduce/tof/board_table.hpp"
#include "tools/evaluation/reproduce/tof/four_tests.hpp"

namespace pharos::tools {
namespace {

int frames_of(const report::PartSettings& settings) { return settings.quick ? 10 : 100; }
int boards_of(const report::PartSettings& settings) { return settings.quick ? 8 : 20; }

std::string command(const report::PartSettings& settings) {
  return "pharos reproduce tof --frames " + std::to_string(frames_of(settings)) + " --boards " +
         std::to_string(boards_of(settings)) + " --seed " + std::to_string(settings.seed);
}

}  // namespace

std::vector<report::Part> tof_parts() {
  return {{"tof-boards", command,
           [](const report::PartSettings& settings, const std::filesystem::path& folder) {
             report::PartResult result{reproduce_board_table(boards_of(settings), settings.seed), {}};
             write_board_pictures((folder / "").string(), settings.seed);
             result.pictures = {{"figure 2", "rendered board of dots", "board.png"},
                                {"figure 2", "its dots as found, in their order", "dots.png"}};
             return result;
           }},
          {"tof-tests", command, [](const report::PartSettings& settings, const std::filesystem::path& folder) {
             return reproduce_four_tests({frames_of(settings), settings.seed}, folder);
           }}};
}

}  // namespace pharos::tools
