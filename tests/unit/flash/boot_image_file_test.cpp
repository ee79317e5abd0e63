// SPDX-License-Identifier: Apache-2.0
#include "tools/flash/boot_image_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"
#include "unit/boot/images.hpp"

namespace pharos::tools {
namespace {

using boot::test::Bytes;
using ::testing::AllOf;
using ::testing::HasSubstr;

class BootImageFileTest : public ::testing::Test {
 protected:
  ~BootImageFileTest() override { std::filesystem::remove(path_); }

  /// Error message for such a file; empty where it is accepted.
  std::string error_of(const Bytes& bytes) {
    std::ofstream(path_, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    return error();
  }
  std::string error() const {
    return pharos::test::error_of([&] { read_image(path_); });
  }

  const std::string path_ = ::testing::TempDir() + "image_file_test." + std::to_string(::getpid());
  const Bytes good_ = boot::test::make_image(1, {.version = {1, 22, 3}});
};

TEST_F(BootImageFileTest, TakesAWholeImage) {
  EXPECT_EQ(error_of(good_), "");
  const BootImageFile file = read_image(path_);
  EXPECT_EQ(file.bytes, good_);
  EXPECT_EQ(to_text(file.header.version), "1.22.3");
  EXPECT_EQ(view(file.header.board), "model");
}

TEST_F(BootImageFileTest, NamesTheFileAndWhatToDo) {
  EXPECT_THAT(error(), AllOf(HasSubstr(path_), HasSubstr("No such file")));
  EXPECT_THAT(error_of({}), HasSubstr("cut short"));
  EXPECT_THAT(error_of({good_.begin(), good_.end() - 1}),
              AllOf(HasSubstr(path_), HasSubstr("cut short; copy or build")));
  EXPECT_THAT(error_of(Bytes(500, 'x')), HasSubstr("is no image; take the file that ends in .image"));
  Bytes longer = good_;
  longer.push_back(0);
  EXPECT_THAT(error_of(longer), HasSubstr("bytes behind the image"));
  Bytes flipped = good_;
  flipped[900] ^= 4;
  EXPECT_THAT(error_of(flipped), HasSubstr("damaged"));
}

TEST_F(BootImageFileTest, AFolderIsNoImage) {
  std::filesystem::create_directory(path_);
  EXPECT_THAT(error(), HasSubstr("cannot be read: Is a directory"));
}

}  // namespace
}  // namespace pharos::tools
