// SPDX-License-Identifier: Apache-2.0
#include "host/config/environment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "host/record/stream_format.hpp"
#include "host/support/input_error.hpp"
#include "support/temporary_folder.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class EnvironmentTest : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return (folder_.path() / name).string(); }
  std::string error_of_recording(const char* name) const {
    return pharos::test::error_of([&] { real_.check_recording(path(name), "dock"); });
  }
  std::vector<std::string> errors(const fs::path& state, const fs::path& recording) const {
    DaemonConfig config;
    config.state_directory = state;
    config.recording.emplace().directory = recording;
    return lines(config);
  }
  std::vector<std::string> lines(const DaemonConfig& config) const {
    std::vector<std::string> all;
    for (const PlaceError& error : place_errors(config)) {
      all.push_back((error.table.empty() ? "" : error.table + '.') + error.key + ": " + error.message);
    }
    return all;
  }
  std::vector<fs::path> everything() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) all.push_back(entry.path());
    return all;
  }

  pharos::test::TemporaryFolder folder_;
  Environment real_ = host_environment();
};

TEST_F(EnvironmentTest, PairsAreHeldToTheRigByTheFirstThatCanBeRead) {
  const auto write = [&](const char* name, const std::string& content) {
    test::write_file(path(name), {content.begin(), content.end()});
  };
  RigFile rig;
  rig.left.intrinsics.width_px = rig.right.intrinsics.width_px = 2;
  rig.left.intrinsics.height_px = rig.right.intrinsics.height_px = 1;
  for (const char* name : {"0_left.pgm", "0_right.pgm", "1_left.pgm"}) write(name, "P5\n2 1\n255\nAB");
  write("1_right.pgm", "P5\n1 1\n255\nA");
  write("0_right.pgm", "no image");
  EXPECT_THROW(real_.check_pairs(folder_.path(), rig, "front"), InputError)
      << "the second right image is of another size";
  write("1_right.pgm", "P5\n2 1\n255\nAB");
  EXPECT_NO_THROW(real_.check_pairs(folder_.path(), rig, "front"));
  write("1_left.pgm", "");
  try {
    real_.check_pairs(folder_.path(), rig, "front");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("0_right.pgm: is no PNG"));
  }
}

TEST_F(EnvironmentTest, ARecordingIsOpenedAndItsHeadRead) {
  pharos::test::write_file(path("good"), stream_format::encode_head({"dock", 460'800, 1, 1}));
  EXPECT_EQ(error_of_recording("good"), "");
  EXPECT_THAT(error_of_recording("missing"), HasSubstr("missing"));
  pharos::test::write_file(path("table"), {'s', 'e', 'n', 's', 'o', 'r'});
  EXPECT_THAT(error_of_recording("table"), HasSubstr("is not a recorded serial stream"));
  pharos::test::write_file(path("empty"), {});
  EXPECT_THAT(error_of_recording("empty"), HasSubstr("is not a recorded serial stream"));
  pharos::test::Bytes damaged = stream_format::encode_head({"dock", 460'800, 1, 1});
  damaged.back() ^= 1;
  pharos::test::write_file(path("damaged"), damaged);
  EXPECT_THAT(error_of_recording("damaged"), HasSubstr("head of this recording is damaged"));
}

TEST_F(EnvironmentTest, APipeOrAFolderWithoutRecordingsIsRefusedAtOnce) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);  // opening it would wait for a writer
  EXPECT_THAT(error_of_recording("pipe"), HasSubstr("is not a file"));
  fs::create_directory(path("folder"));
  EXPECT_THAT(error_of_recording("folder"), HasSubstr("has no recording of target \"dock\""));
}

TEST_F(EnvironmentTest, EverySpellingOfAPortIsTheSame) {
  std::ofstream(path("port")) << "";
  fs::create_symlink("port", path("link"));
  fs::create_symlink(path("link"), path("second"));
  fs::create_directory(path("folder"));
  const std::string identity = real_.identity(path("port"));
  EXPECT_EQ(real_.identity(path("link")), identity);
  EXPECT_EQ(real_.identity(path("second")), identity);
  EXPECT_EQ(real_.identity(path("folder") + "/../port"), identity);
  EXPECT_NE(real_.identity(path("other")), identity);
}

TEST_F(EnvironmentTest, ADeviceIsReportedByItsNumber) {
  fs::create_symlink("/dev/null", path("link"));
  EXPECT_EQ(real_.identity(path("link")), real_.identity("/dev/null"));
  EXPECT_NE(real_.identity("/dev/zero"), real_.identity("/dev/null"));
}

TEST_F(EnvironmentTest, PortsNotPluggedInYetAreComparedByTheirPaths) {
  EXPECT_EQ(real_.identity("/dev/./none"), real_.identity("/dev/none"));
  EXPECT_NE(real_.identity("/dev/none0"), real_.identity("/dev/none1"));
}

TEST_F(EnvironmentTest, WritableDirectoriesPassAndNothingIsMade) {
  fs::create_directory(path("state"));
  const auto before = everything();
  EXPECT_THAT(errors(path("state"), path("to/be/made")), IsEmpty());
  EXPECT_EQ(everything(), before);
}

TEST_F(EnvironmentTest, WhatStandsInThePlaceOfAPortALogOrATelescopesFolderIsReported) {
  std::ofstream(path("file")) << "";
  DaemonConfig config;
  config.log.sink = LogSink::kFile;
  config.targets.resize(4);
  config.targets[0].port = path("file");
  config.targets[1].port = path("no/port");
  config.targets[2].port = "/dev/null";
  config.targets[3].port = path("awaited");
  config.telescopes.resize(1);
  config.telescopes[0].directory = path("no");
  config.log.file = path("file/log");
  EXPECT_THAT(lines(config), ElementsAre(HasSubstr("log.file: "), HasSubstr("is no terminal device"),
                                         HasSubstr("its folder does not exist"), HasSubstr("is no folder")));
}

TEST_F(EnvironmentTest, AFileInADirectorysPlaceIsReported) {
  std::ofstream(path("file")) << "";
  EXPECT_THAT(errors(path("file"), path("file/below")),
              ElementsAre(AllOf(HasSubstr("state_directory: "), HasSubstr("cannot be written: Not a directory")),
                          AllOf(HasSubstr("recording.directory: "), HasSubstr("/file): Not a directory"))));
}

TEST_F(EnvironmentTest, ADirectoryWithoutPermissionIsReported) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::create_directory(path("closed"));
  fs::permissions(path("closed"), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(errors(path("closed"), path("closed/raw")),
              ElementsAre(HasSubstr("Permission denied"), HasSubstr("Permission denied")));
}

}  // namespace
}  // namespace pharos::host
