// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/keyframe_reader.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "core/base/read_file.h"
#include "core/geometry/se3.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

constexpr camera::PinholeCamera kCamera{64, 48, 50.25, 51.5, 31.75, 23.125};

StoredKeyframe sampleKeyframe(int id) {
  StoredKeyframe k;
  k.id = id;
  k.frame = 7 * id + 2;
  k.stamp_ns = 1'700'000'000'123'456'789 + id;
  geometry::Vector6d xi;
  xi << 0.1 * id, -0.2, 0.3, 0.4, -0.5, 0.6;
  k.T_map_camera = geometry::expSe3(xi);
  k.color.create(48, 64, CV_8UC3);
  k.depth_m.create(48, 64, CV_32FC1);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      k.color.at<cv::Vec3b>(y, x) = {static_cast<unsigned char>(2 * x), static_cast<unsigned char>(3 * y),
                                     static_cast<unsigned char>(100 + id)};
      k.depth_m.at<float>(y, x) =
          (x + y) % 9 == 0 ? std::numeric_limits<float>::quiet_NaN() : 0.5F + 0.0123F * static_cast<float>(x + 2 * y);
    }
  }
  for (int i = 0; i < 3; ++i) {
    k.features.pixel.emplace_back(1.5 * i, 2.25 + id);
    k.features.point_camera.emplace_back(0.1 * i, 0.2, 1.0 / 3.0);
    k.features.descriptor.push_back({0xFFFFFFFFFFFFFFFFULL - static_cast<std::uint64_t>(i), 2, 3, static_cast<std::uint64_t>(id)});
  }
  k.landmarks.push_back({id, {10.5, 20.25}, 0.75, 0.75, 0.01, {0.001, -0.002}});
  k.landmarks.push_back({id, {30.0, 5.0}, 1.0 / 3.0, 1.0 / 3.0, 0.02, {0.0, 0.0}});
  return k;
}

void put(KeyframeStoreWriter& writer, const StoredKeyframe& keyframe) {
  writer.add(keyframe, encodePictures(keyframe.color, keyframe.depth_m));
}

void writeStore(const std::filesystem::path& file, int keyframes) {
  KeyframeStoreWriter writer(file, kCamera);
  for (int id = 0; id < keyframes; ++id) {
    put(writer, sampleKeyframe(3 * id));
  }
  writer.commit();
}

void alter(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* opened = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &opened), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(opened, &sqlite3_close);
  ASSERT_EQ(sqlite3_exec(opened, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(opened);
}

void expectSameDepth(const cv::Mat& stored, const cv::Mat& read) {
  ASSERT_EQ(stored.size(), read.size());
  ASSERT_EQ(read.type(), CV_32FC1);
  for (int y = 0; y < stored.rows; ++y) {
    for (int x = 0; x < stored.cols; ++x) {
      const float a = stored.at<float>(y, x);
      const float b = read.at<float>(y, x);
      EXPECT_TRUE((std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= 0.000101F) << a << " read as " << b;
    }
  }
}

TEST(KeyframeStore, EverythingComesBack) {
  const test::TemporaryFolder folder;
  writeStore(folder.path() / "k.sqlite", 3);
  const KeyframeStore store = readKeyframeStore(folder.path() / "k.sqlite");
  EXPECT_EQ(store.camera.width, 64);
  EXPECT_EQ(store.camera.height, 48);
  EXPECT_EQ(store.camera.fx, 50.25);
  EXPECT_EQ(store.camera.fy, 51.5);
  EXPECT_EQ(store.camera.cx, 31.75);
  EXPECT_EQ(store.camera.cy, 23.125);
  ASSERT_EQ(store.keyframes.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const StoredKeyframe expected = sampleKeyframe(3 * i);
    const StoredKeyframe& read = store.keyframes[static_cast<std::size_t>(i)];
    EXPECT_EQ(read.id, expected.id);
    EXPECT_EQ(read.frame, expected.frame);
    EXPECT_EQ(read.stamp_ns, expected.stamp_ns);
    EXPECT_LT((read.T_map_camera.matrix() - expected.T_map_camera.matrix()).norm(), 1e-14);
    EXPECT_LT(cv::norm(read.color, expected.color, cv::NORM_L1) / (64.0 * 48.0 * 3.0), 4.0);  // JPEG
    expectSameDepth(expected.depth_m, read.depth_m);
    EXPECT_EQ(read.features.pixel, expected.features.pixel);
    EXPECT_EQ(read.features.point_camera, expected.features.point_camera);
    EXPECT_EQ(read.features.descriptor, expected.features.descriptor);
    ASSERT_EQ(read.landmarks.size(), expected.landmarks.size());
    for (std::size_t l = 0; l < read.landmarks.size(); ++l) {
      EXPECT_EQ(read.landmarks[l].host, expected.id);
      EXPECT_EQ(read.landmarks[l].pixel, expected.landmarks[l].pixel);
      EXPECT_EQ(read.landmarks[l].inverse_depth, expected.landmarks[l].inverse_depth);
      EXPECT_EQ(read.landmarks[l].sigma, expected.landmarks[l].sigma);
      EXPECT_EQ(read.landmarks[l].inverse_depth_gradient, expected.landmarks[l].inverse_depth_gradient);
    }
  }
}

TEST(KeyframeStore, AKeyframeWithoutFeaturesOrLandmarksComesBack) {
  const test::TemporaryFolder folder;
  StoredKeyframe bare = sampleKeyframe(1);
  bare.features = {};
  bare.landmarks.clear();
  KeyframeStoreWriter writer(folder.path() / "k.sqlite", kCamera);
  put(writer, bare);
  writer.commit();
  const KeyframeStore store = readKeyframeStore(folder.path() / "k.sqlite");
  ASSERT_EQ(store.keyframes.size(), 1U);
  EXPECT_EQ(store.keyframes[0].features.size(), 0);
  EXPECT_TRUE(store.keyframes[0].landmarks.empty());
}

TEST(KeyframeStore, DepthBeyondWhatCanBeKeptIsNoReading) {
  const test::TemporaryFolder folder;
  StoredKeyframe k = sampleKeyframe(1);
  k.depth_m.at<float>(0, 1) = 13.2F;
  k.depth_m.at<float>(0, 2) = -1.0F;
  k.depth_m.at<float>(0, 3) = 13.0F;
  KeyframeStoreWriter writer(folder.path() / "k.sqlite", kCamera);
  put(writer, k);
  writer.commit();
  const cv::Mat depth_m = readKeyframeStore(folder.path() / "k.sqlite").keyframes[0].depth_m;
  EXPECT_TRUE(std::isnan(depth_m.at<float>(0, 1)));
  EXPECT_TRUE(std::isnan(depth_m.at<float>(0, 2)));
  EXPECT_NEAR(depth_m.at<float>(0, 3), 13.0F, 0.0002F);
}

TEST(KeyframeStore, SameBytesTwice) {
  const test::TemporaryFolder folder;
  writeStore(folder.path() / "a.sqlite", 4);
  writeStore(folder.path() / "b.sqlite", 4);
  EXPECT_EQ(base::readFile(folder.path() / "a.sqlite"), base::readFile(folder.path() / "b.sqlite"));
}

TEST(KeyframeStore, LeavesNoOtherFileBehind) {
  const test::TemporaryFolder folder;
  writeStore(folder.path() / "k.sqlite", 2);
  static_cast<void>(readKeyframeStore(folder.path() / "k.sqlite"));
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++files;
  }
  EXPECT_EQ(files, 1);
}

struct Damage {
  const char* name;
  std::string sql;
  std::vector<std::string> parts;
};

class DamagedStore : public testing::TestWithParam<Damage> {};

TEST_P(DamagedStore, IsNamed) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "k.sqlite";
  writeStore(file, 2);
  alter(file, GetParam().sql);
  std::vector<std::string> parts = GetParam().parts;
  parts.push_back(file.string());
  test::expectError(base::ErrorCode::kInput, parts, [&] { static_cast<void>(readKeyframeStore(file)); });
}

INSTANTIATE_TEST_SUITE_P(
    KeyframeStore, DamagedStore,
    testing::Values(Damage{"NewerVersion", "UPDATE meta SET value = 2 WHERE key = 'version'", {"version 2", "up to 1"}},
                    Damage{"NoVersion", "DELETE FROM meta WHERE key = 'version'", {"'version'"}},
                    Damage{"OtherFormat", "UPDATE meta SET value = 'bookmarks' WHERE key = 'format'", {"'bookmarks'", "oikos-keyframes"}},
                    Damage{"NoFormat", "DELETE FROM meta WHERE key = 'format'", {"'format'"}},
                    Damage{"NoCamera", "DELETE FROM meta WHERE key = 'fx_px'", {"'fx_px'"}}, Damage{"NoMeta", "DROP TABLE meta", {"meta"}},
                    Damage{"NoKeyframes", "DROP TABLE keyframe", {"keyframe"}},
                    Damage{"ShortPose", "UPDATE keyframe SET t_map_camera = zeroblob(48) WHERE id = 3", {"keyframe 3", "6 numbers", "7"}},
                    Damage{"CutPose", "UPDATE keyframe SET t_map_camera = zeroblob(50) WHERE id = 3", {"keyframe 3", "50 bytes"}},
                    Damage{"NoRotation", "UPDATE keyframe SET t_map_camera = zeroblob(56) WHERE id = 3", {"keyframe 3", "quaternion"}},
                    Damage{"NoPicture", "UPDATE keyframe SET color_jpeg = x'' WHERE id = 3", {"keyframe 3", "empty"}},
                    Damage{"BrokenPicture", "UPDATE keyframe SET color_jpeg = x'FFD8FF00' WHERE id = 3", {"keyframe 3", "corrupt image"}},
                    Damage{"DepthIsNoDepth", "UPDATE keyframe SET depth_png = color_jpeg WHERE id = 3", {"keyframe 3", "16-bit grey PNG"}},
                    Damage{"CutFeatures", "UPDATE keyframe SET features = x'0102' WHERE id = 3", {"keyframe 3", "2 bytes"}},
                    Damage{"CutLandmarks", "UPDATE keyframe SET landmarks = x'010203' WHERE id = 3", {"keyframe 3", "3 bytes"}}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(KeyframeStore, ATextFileIsNotAStore) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("k.sqlite", std::string(5000, 'x'));
  test::expectError(base::ErrorCode::kInput, {file.string(), "not a database"}, [&] { static_cast<void>(readKeyframeStore(file)); });
}

TEST(KeyframeStore, AnEmptyFileIsNotAStore) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("k.sqlite", "");
  test::expectError(base::ErrorCode::kInput, {file.string()}, [&] { static_cast<void>(readKeyframeStore(file)); });
}

TEST(KeyframeStore, ACutFileIsDamaged) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "k.sqlite";
  writeStore(file, 4);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2 / 4096 * 4096);
  test::expectError(base::ErrorCode::kInput, {file.string()}, [&] { static_cast<void>(readKeyframeStore(file)); });
}

TEST(KeyframeStore, AMissingFileIsAnIoErrorAndIsNotMade) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "k.sqlite";
  test::expectError(base::ErrorCode::kIo, {file.string()}, [&] { static_cast<void>(readKeyframeStore(file)); });
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(KeyframeStore, AFolderThatIsNotThereIsAnIoError) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "no-such" / "k.sqlite";
  test::expectError(base::ErrorCode::kIo, {file.string()}, [&] { KeyframeStoreWriter(file, kCamera); });
}

TEST(KeyframeStore, TwoKeyframesOfOneIdAreRefused) {
  const test::TemporaryFolder folder;
  KeyframeStoreWriter writer(folder.path() / "k.sqlite", kCamera);
  put(writer, sampleKeyframe(1));
  EXPECT_THROW(put(writer, sampleKeyframe(1)), base::Error);
}

/// Files may not grow past a few pages: what a full disk looks like from inside.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(KeyframeStore, AFullDiskIsAnIoErrorThatNamesTheFile) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "k.sqlite";
  test::expectError(base::ErrorCode::kIo, {file.string()}, [&] {
    const FileSizeLimit limit(16384);
    writeStore(file, 40);
  });
}

/// The same while the pages do not fit into the cache and are written before the commit.
TEST(KeyframeStore, ADiskThatFillsBeforeTheCommitIsAnIoError) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "k.sqlite";
  test::expectError(base::ErrorCode::kIo, {file.string()}, [&] {
    const FileSizeLimit limit(16384);
    KeyframeStoreWriter writer(file, kCamera);
    StoredKeyframe large = sampleKeyframe(0);
    cv::theRNG().state = 1;
    large.color.create(480, 640, CV_8UC3);
    cv::randu(large.color, 0, 256);
    for (int id = 0; id < 40; ++id) {
      large.id = id;
      put(writer, large);
    }
    ADD_FAILURE() << "40 noisy pictures fit into 16 kB";
  });
}

}  // namespace
}  // namespace oikos::mapping
