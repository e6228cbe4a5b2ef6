// SPDX-License-Identifier: Apache-2.0
#include "core/recording/content_digest.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.h"
#include "tests/support/synthetic_recording.h"
#include "tests/support/temporary_folder.h"

namespace oikos::recording {
namespace {

namespace fs = std::filesystem;

class ContentDigest : public ::testing::Test {
 protected:
  ContentDigest() {
    fs::create_directory(folder_.path() / "one");
    test::writeTumRecording(folder_.path() / "one", 3);
    digest_ = contentDigest(folder_.path() / "one");
  }
  [[nodiscard]] fs::path copy(const char* name) const {
    fs::copy(folder_.path() / "one", folder_.path() / name, fs::copy_options::recursive);
    return folder_.path() / name;
  }
  test::TemporaryFolder folder_;
  std::string digest_;
};

TEST_F(ContentDigest, IsThatOfTheContentAndNotOfTheFolder) {
  EXPECT_EQ(digest_.size(), 64U);
  const fs::path other = copy("other");
  test::append(other / "odometry.txt", "0 0 0 0 0 0 0 1\n");
  fs::create_directory(other / "truth");
  test::append(other / "truth" / "states.csv", "t,id,value,unit\n");
  EXPECT_EQ(contentDigest(other), digest_);
}

TEST_F(ContentDigest, EveryPartOfTheContentCounts) {
  const fs::path image = copy("image");
  cv::imwrite((image / "depth" / "1.png").string(), test::tinyDepth(1002));
  const fs::path calibration = copy("calibration");
  test::append(calibration / "camera.toml", "rate_hz = 10.0\n");
  const fs::path shorter = copy("shorter");
  fs::remove(shorter / "rgb.txt");
  test::append(shorter / "rgb.txt", "# stamp file\n0.0 rgb/0.jpg\n0.1 rgb/1.jpg\n");
  for (const fs::path& other : {image, calibration, shorter}) {
    EXPECT_NE(contentDigest(other), digest_) << other;
  }
}

TEST_F(ContentDigest, WhatIsListedAndMissingIsSaid) {
  fs::remove(folder_.path() / "one" / "rgb" / "1.jpg");
  try {
    (void)contentDigest(folder_.path() / "one");
    FAIL() << "no error";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("1.jpg"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace oikos::recording
