// SPDX-License-Identifier: Apache-2.0
// pharos vocabulary: images to the visual words that `pharos slam` uses for place recognition.
#include "host/vision/slam/vocabulary.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "host/files/atomic_file.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tools/slam/slam_files.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/image_input.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

struct VocabularyOptions {
  std::vector<std::string> images;
  std::string output;
  int branches = 8, depth = 4, features = 1000;
  std::uint64_t seed = 1;
};

int run_vocabulary(const VocabularyOptions& options) {
  require_writable(options.output);
  std::vector<std::vector<slam::Descriptor>> described;
  ImageInput input;
  Progress progress("vocabulary", "images", options.images.size());
  for (const std::string& path : options.images) {
    progress.step();
    const auto image = input.try_read(path);
    if (!image) continue;
    const std::vector<std::uint8_t> pixels = eight_bits(*image);
    described.push_back(slam::describe_image({pixels.data(), image->width_px, image->height_px}, options.features));
  }
  const int exit_code = input.finish(!described.empty());
  if (described.empty()) return exit_code;
  const slam::Vocabulary vocabulary = slam::Vocabulary::train(described, options.branches, options.depth, options.seed);
  const std::vector<std::uint8_t> bytes = vocabulary.bytes();
  host::write_file(options.output, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  note(std::to_string(vocabulary.words()) + " words of " + std::to_string(described.size()) + " images, " +
       std::to_string(bytes.size()) + " bytes");
  return exit_code;
}

}  // namespace

void add_vocabulary(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("vocabulary", "Train the visual words that `pharos slam` knows places by");
  const auto options = std::make_shared<VocabularyOptions>();
  command->add_option("IMAGE", options->images, "Images, far apart from each other in what they show")->required();
  command->add_option("--output", options->output, "Vocabulary file to write")->check(output_place())->required();
  command->add_option("--branches", options->branches, "Children of a node (default 8)")
      ->check(CLI::Range(2, slam::Vocabulary::kMaxBranches));
  command->add_option("--depth", options->depth, "Levels of the tree (default 4)")
      ->check(CLI::Range(1, slam::Vocabulary::kMaxDepth));
  command->add_option("--seed", options->seed, "Of the start values");
  command->footer("Example: pharos vocabulary frames/left/*0.png --output orb.words");
  command->callback([options, &exit_code] { exit_code = run_vocabulary(*options); });
}

}  // namespace pharos::tools
