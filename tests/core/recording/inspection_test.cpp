// SPDX-License-Identifier: Apache-2.0
#include "core/recording/inspect/inspection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "tests/support/expect_error.h"

namespace oikos::recording {
namespace {

constexpr double kHeight_m = 1.1;
constexpr double kPitchDown_rad = 0.5;

/// A camera that pans over a textured floor with posts on it; what is wrong with the drive can be chosen.
class SimulatedDrive : public Recording {
 public:
  struct Faults {
    double turn_per_frame_rad = 0.005;
    int depth_shift_px = 0;  ///< depth this far to the right of colour
    int smear_px = 0;
    bool has_floor = true;
    double missing_depth = 0.0;  ///< share of the rows without depth
    std::set<int> unreadable = {};
    std::set<int> lost = {};  ///< numbers that are not in the list
    int frames = 40;
  };

  explicit SimulatedDrive(const Faults& faults) : faults_(faults) {
    for (int i = 0; i < faults.frames; ++i) {
      if (!faults.lost.contains(i)) {
        numbers_.push_back(i);
      }
    }
  }

  [[nodiscard]] const camera::PinholeCamera& camera() const override { return camera_; }
  [[nodiscard]] int frameCount() const override { return static_cast<int>(numbers_.size()); }
  [[nodiscard]] std::int64_t stampNs(int index) const override { return numbers_[static_cast<std::size_t>(index)] * 50'000'000LL; }
  [[nodiscard]] camera::RgbdFrame read(int index, Channels channels) const override;

 private:
  /// Distance along the axis to the floor, or to a post before it; `gray` is what is seen there.
  [[nodiscard]] float look(double u, double v, double yaw, double& gray) const;

  camera::PinholeCamera camera_{320, 240, 262.0, 262.0, 159.5, 119.5};
  Faults faults_;
  std::vector<int> numbers_;
};

float SimulatedDrive::look(double u, double v, double yaw, double& gray) const {
  const Eigen::Vector3d ray = camera_.ray(u, v);
  // gravity is (0, cos p, sin p) in the camera; azimuth and range of the ray on the ground
  const double down = ray.y() * std::cos(kPitchDown_rad) + ray.z() * std::sin(kPitchDown_rad);
  const double ahead = ray.z() * std::cos(kPitchDown_rad) - ray.y() * std::sin(kPitchDown_rad);
  const double azimuth = std::atan2(ray.x(), ahead) + yaw;
  constexpr double kPostEvery_rad = 0.3;
  constexpr double kPostWidth_rad = 0.08;
  constexpr double kPostRange_m = 1.0;
  const double phase = azimuth - kPostEvery_rad * std::floor(azimuth / kPostEvery_rad);
  const double range_per_depth = std::hypot(ray.x(), ahead);
  const double height_at_post_m = kHeight_m - down / range_per_depth * kPostRange_m;
  if (phase < kPostWidth_rad && height_at_post_m > 0.0 && height_at_post_m < 0.9) {
    gray = 220.0;
    return static_cast<float>(kPostRange_m / range_per_depth);
  }
  if (!faults_.has_floor || down < 0.05) {
    gray = 60.0 + 25.0 * std::sin(40.0 * azimuth + 9.0 * v / 240.0);
    return static_cast<float>(4.0 / range_per_depth);
  }
  const double range_m = kHeight_m / down * range_per_depth;
  gray = 70.0 + 30.0 * std::sin(31.0 * azimuth) * std::cos(13.0 * range_m) + 12.0 * std::sin(170.0 * azimuth + 50.0 * range_m);
  return static_cast<float>(kHeight_m / down);
}

camera::RgbdFrame SimulatedDrive::read(int index, Channels /*channels*/) const {
  const int number = numbers_[static_cast<std::size_t>(index)];
  if (faults_.unreadable.contains(number)) {
    throw base::Error(base::ErrorCode::kInput, "truncated", "frame " + std::to_string(number));
  }
  camera::RgbdFrame frame;
  frame.index = index;
  frame.stamp_ns = stampNs(index);
  frame.gray.create(camera_.height, camera_.width, CV_8UC1);
  frame.depth_m.create(camera_.height, camera_.width, CV_32FC1);
  const double yaw = number * faults_.turn_per_frame_rad;
  for (int v = 0; v < camera_.height; ++v) {
    for (int u = 0; u < camera_.width; ++u) {
      double gray = 0.0;
      double ignored = 0.0;
      (void)look(u, v, yaw, gray);
      const bool missing = v < faults_.missing_depth * camera_.height;
      frame.depth_m.at<float>(v, u) = missing ? std::numeric_limits<float>::quiet_NaN() : look(u - faults_.depth_shift_px, v, yaw, ignored);
      frame.gray.at<uchar>(v, u) = cv::saturate_cast<uchar>(gray);
    }
  }
  if (faults_.smear_px > 0) {
    cv::blur(frame.gray, frame.gray, {faults_.smear_px, 1});
  }
  return frame;
}

Inspection inspectDrive(const SimulatedDrive::Faults& faults) {
  return inspect(SimulatedDrive(faults));
}

bool complains(const Inspection& inspection, Severity severity, const std::string& part) {
  return std::any_of(inspection.findings.begin(), inspection.findings.end(),
                     [&](const Finding& finding) { return finding.severity == severity && finding.what.find(part) != std::string::npos; });
}

TEST(Inspection, AGoodDrive) {
  const Inspection inspection = inspectDrive({});
  EXPECT_EQ(inspection.verdict, Verdict::kGood) << toText(inspection);
  EXPECT_EQ(inspection.inspected, 40);
  EXPECT_EQ(inspection.unreadable, 0);
  EXPECT_NEAR(inspection.rate.rate_hz, 20.0, 1e-9);
  EXPECT_EQ(inspection.rate.lost, 0);
  EXPECT_NEAR(inspection.rate.length_s, 39 * 0.05, 1e-9);
  EXPECT_NEAR(inspection.motion.median_rad_s, 0.1, 0.03);  // the image moves less below the horizon than the camera turns
  EXPECT_EQ(inspection.valid_depth_share, 1.0);
  ASSERT_TRUE(inspection.edges.is_known_u);
  EXPECT_NEAR(inspection.edges.shift_u_px, 0.0, 0.7);
  ASSERT_TRUE(inspection.floor.is_seen);
  EXPECT_NEAR(inspection.floor.camera_height_m, kHeight_m, 0.01);
  EXPECT_NEAR(inspection.floor.camera_pitch_rad, -kPitchDown_rad, 0.01);
}

TEST(Inspection, DepthBesideColour) {
  for (const int shift : {-8, 5}) {
    const Inspection inspection = inspectDrive({.depth_shift_px = shift});
    EXPECT_EQ(inspection.verdict, Verdict::kBad) << toText(inspection);
    EXPECT_NEAR(inspection.edges.shift_u_px, -shift, 0.7);
    EXPECT_TRUE(complains(inspection, Severity::kFault, "depth edges lie beside"));
  }
  const Inspection little = inspectDrive({.depth_shift_px = 3});
  EXPECT_EQ(little.verdict, Verdict::kUsable) << toText(little);
}

TEST(Inspection, TooFast) {
  const Inspection inspection = inspectDrive({.turn_per_frame_rad = 0.08});
  EXPECT_EQ(inspection.verdict, Verdict::kUsable) << toText(inspection);
  EXPECT_TRUE(complains(inspection, Severity::kWarning, "the camera turns"));
}

TEST(Inspection, Blurred) {
  const Inspection inspection = inspectDrive({.smear_px = 25});
  EXPECT_EQ(inspection.blurred.size(), 40U);
  EXPECT_TRUE(complains(inspection, Severity::kFault, "blurred"));
  EXPECT_NE(inspection.blurred[1].reason.find("smeared"), std::string::npos);
}

TEST(Inspection, LostAndUnreadable) {
  const Inspection inspection = inspectDrive({.unreadable = {4}, .lost = {10, 11, 12, 20, 30, 31}});
  EXPECT_EQ(inspection.rate.lost, 6);
  EXPECT_NEAR(inspection.rate.longest_gap_s, 0.2, 1e-9);
  EXPECT_EQ(inspection.unreadable, 1);
  ASSERT_EQ(inspection.first_messages.size(), 1U);
  EXPECT_EQ(inspection.first_messages[0], "frame 4: truncated");
  EXPECT_TRUE(complains(inspection, Severity::kWarning, "1 frames cannot be read"));
  EXPECT_TRUE(complains(inspection, Severity::kWarning, "6 frames were lost"));
  EXPECT_TRUE(complains(inspectDrive({.unreadable = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}), Severity::kFault, "cannot be read"));
}

TEST(Inspection, LittleDepthAndNoFloor) {
  const Inspection little = inspectDrive({.missing_depth = 0.7});
  EXPECT_NEAR(little.valid_depth_share, 0.3, 1e-9);
  EXPECT_TRUE(complains(little, Severity::kWarning, "30 % of the depth pixels"));
  const Inspection none = inspectDrive({.missing_depth = 1.0});
  EXPECT_TRUE(complains(none, Severity::kFault, "0 % of the depth pixels"));
  EXPECT_TRUE(complains(none, Severity::kNote, "too few depth edges"));
  EXPECT_FALSE(none.floor.is_seen);
  EXPECT_FALSE(inspectDrive({.has_floor = false}).floor.is_seen);
}

TEST(Inspection, EverythingUnreadableIsAVerdict) {
  const Inspection inspection = inspectDrive({.unreadable = {0, 1, 2}, .frames = 3});
  EXPECT_EQ(inspection.verdict, Verdict::kBad);
  EXPECT_EQ(inspection.unreadable, 3);
  EXPECT_EQ(inspect(SimulatedDrive({.frames = 1})).inspected, 1);
}

TEST(Inspection, LongDrivesAreLookedAtInBursts) {
  InspectionConfig config;
  config.max_frames = 48;
  const Inspection inspection = inspect(SimulatedDrive({.frames = 300}), config);
  EXPECT_EQ(inspection.frames, 300);
  EXPECT_EQ(inspection.inspected, 48);
  EXPECT_NEAR(inspection.motion.median_rad_s, 0.1, 0.03);
}

TEST(Inspection, TheSameForAnyNumberOfThreads) {
  InspectionConfig config;
  config.threads = 1;
  const std::string serial = toJson(inspect(SimulatedDrive({}), config));
  config.threads = 3;
  EXPECT_EQ(toJson(inspect(SimulatedDrive({}), config)), serial);
}

TEST(Inspect, SaysHowFarItHasCome) {
  std::set<int> done;
  std::mutex mutex;
  (void)inspect(SimulatedDrive({.frames = 30}), {}, [&](const base::Progress& progress) {
    const std::lock_guard lock(mutex);
    EXPECT_EQ(progress.total, 30);
    done.insert(progress.done);
  });
  EXPECT_EQ(done.size(), 30U);
  EXPECT_EQ(*done.rbegin(), 30);
}

TEST(Inspection, Reports) {
  const Inspection inspection = inspectDrive({.depth_shift_px = 8});
  const auto json = nlohmann::json::parse(toJson(inspection));
  EXPECT_EQ(json["verdict"], "bad");
  EXPECT_NEAR(json["floor"]["cameraHeight_m"].get<double>(), kHeight_m, 0.01);
  EXPECT_EQ(json["findings"][0]["severity"], "fault");
  const std::string text = toText(inspection);
  for (const char* part : {"bad", "20.0 Hz", "100 %", "camera 1.10 m above it", "pitch -29 deg", "fault", "T_color_depth"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
}

TEST(Inspection, WrongConfiguration) {
  InspectionConfig config;
  config.max_frames = 0;
  config.threads = 0;
  EXPECT_EQ(config.validate().size(), 2U);
  test::expectError(base::ErrorCode::kUsage, {"max_frames"}, [&] { (void)inspect(SimulatedDrive({}), config); });
}

}  // namespace
}  // namespace oikos::recording
