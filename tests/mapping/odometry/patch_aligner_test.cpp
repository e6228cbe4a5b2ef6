// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/patch_aligner.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/mapping/odometry/wave_texture.h"

namespace oikos::mapping {
namespace {

const cv::Size kSize(320, 240);
const Eigen::Vector2d kCentre(160.0, 120.0);
constexpr int kLevels = 4;
constexpr double kTolerance_px = 0.08;  ///< a step of 0.02 px ends the search; bilinear interpolation of waves of 9 px, 8-bit grey values

/// How the target image came about: target(y) = gain * host(target_from_host^-1 (y - centre - shift) + centre) + bias.
struct Change {
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d target_from_host = Eigen::Matrix2d::Identity();
  double gain = 1.0;
  double bias = 0.0;
};

class PatchAligner : public ::testing::Test {
 protected:
  [[nodiscard]] ImagePyramid targetOf(const Change& change) const {
    const Eigen::Matrix2d host_from_target = change.target_from_host.inverse();
    return {WaveTexture::sample(kSize,
                                [&](const Eigen::Vector2d& px) {
                                  return change.gain * texture_.at(host_from_target * (px - kCentre - change.shift_px) + kCentre) +
                                         change.bias;
                                }),
            kLevels};
  }
  /// Where the host's pixel went.
  static Eigen::Vector2d moved(const Change& change, const Eigen::Vector2d& host_px) {
    return change.target_from_host * (host_px - kCentre) + kCentre + change.shift_px;
  }

  const WaveTexture texture_{3};
  const ImagePyramid host_{texture_.image(kSize), kLevels};
  const PatchAlignerConfig config_;
};

Eigen::Matrix2d turn(double angle_rad, double scale) {
  return scale * Eigen::Rotation2D<double>(angle_rad).toRotationMatrix();
}

TEST_F(PatchAligner, FindsSubPixelShifts) {
  for (const Eigen::Vector2d& shift_px :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.25, -0.4), Eigen::Vector2d(7.5, 3.1), Eigen::Vector2d(-12.3, 0.9)}) {
    const Change change{.shift_px = shift_px};
    const ImagePyramid target = targetOf(change);
    for (const Eigen::Vector2d& host_px : {kCentre, Eigen::Vector2d(60.0, 180.0), Eigen::Vector2d(250.25, 51.75)}) {
      const PatchQuery query{host_px, moved(change, host_px) + Eigen::Vector2d(0.7, -0.6), Eigen::Matrix2d::Identity(), 0};
      const PatchMatch match = alignPatch(host_, target, query, config_);
      ASSERT_TRUE(match.found);
      EXPECT_LT((match.target_px - moved(change, host_px)).norm(), kTolerance_px);
      EXPECT_GT(match.correlation, 0.99);
      EXPECT_EQ(match.level, 0);
    }
  }
}

TEST_F(PatchAligner, StartAtTheAnswerStaysThere) {
  const PatchMatch match = alignPatch(host_, host_, {kCentre, kCentre, Eigen::Matrix2d::Identity(), 2}, config_);
  ASSERT_TRUE(match.found);
  EXPECT_LT((match.target_px - kCentre).norm(), 0.01);
  EXPECT_GT(match.correlation, 0.9999);
}

TEST_F(PatchAligner, FollowsAKnownAffinity) {
  Eigen::Matrix2d shear;
  shear << 1.1, 0.35, -0.1, 0.85;
  for (const Eigen::Matrix2d& affinity : {turn(0.4, 1.0), turn(-0.3, 1.4), turn(0.0, 2.2), turn(0.6, 0.7), turn(0.0, 0.45), shear}) {
    const Change change{.shift_px = {4.4, -2.7}, .target_from_host = affinity};
    const ImagePyramid target = targetOf(change);
    for (const Eigen::Vector2d& host_px : {kCentre, Eigen::Vector2d(130.0, 140.0)}) {
      const PatchQuery query{host_px, moved(change, host_px) + Eigen::Vector2d(0.8, 0.5), affinity, 1};
      const PatchMatch match = alignPatch(host_, target, query, config_);
      ASSERT_TRUE(match.found) << affinity;
      EXPECT_LT((match.target_px - moved(change, host_px)).norm(), 2.0 * kTolerance_px) << affinity;
      // Magnified beyond two, the texture is so soft on the target's grid that level 0 counts as plain.
      EXPECT_LE(match.level, affinity.determinant() > 4.0 ? 1 : 0) << affinity;
    }
  }
}

TEST_F(PatchAligner, GainAndBiasDoNotMatter) {
  for (const auto& [gain, bias] : {std::pair(0.6, 40.0), std::pair(0.8, -20.0), std::pair(1.2, -20.0), std::pair(0.4, 0.0)}) {
    const Change change{.shift_px = {2.3, 1.6}, .gain = gain, .bias = bias};
    const PatchQuery query{kCentre, moved(change, kCentre) + Eigen::Vector2d(-0.8, 0.6), Eigen::Matrix2d::Identity(), 1};
    const PatchMatch match = alignPatch(host_, targetOf(change), query, config_);
    ASSERT_TRUE(match.found) << "gain " << gain;
    EXPECT_LT((match.target_px - moved(change, kCentre)).norm(), kTolerance_px) << "gain " << gain;
    EXPECT_GT(match.correlation, 0.99);
  }
}

/// Of many patches and many wrong starts at one distance.
struct Basin {
  int tried = 0;
  int right = 0;
  int wrong = 0;  ///< "found", but elsewhere
};

// The basin grows with the coarsest level: one and a half pixels of it. What is said to be found must be the patch itself.
TEST_F(PatchAligner, WrongStartsWithinTheBasinComeBack) {
  constexpr double kReach_px = 1.5;  // of the coarsest level
  const Change change{.shift_px = {3.3, -1.8}};
  const ImagePyramid target = targetOf(change);
  for (int level = 0; level < kLevels; ++level) {
    Basin basin;
    for (double x = 70.0; x < 260.0; x += 23.7) {
      for (double y = 70.0; y < 180.0; y += 23.7) {
        for (int k = 0; k < 8; ++k) {
          const double angle_rad = 2.0 * std::numbers::pi * k / 8;
          const Eigen::Vector2d off_px = kReach_px * (1 << level) * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
          const Eigen::Vector2d truth_px = moved(change, {x, y});
          const PatchMatch match = alignPatch(host_, target, {{x, y}, truth_px + off_px, Eigen::Matrix2d::Identity(), level}, config_);
          const double error_px = (match.target_px - truth_px).norm();
          ++basin.tried;
          basin.right += match.found && match.level == 0 && error_px < kTolerance_px ? 1 : 0;
          basin.wrong += match.found && error_px > 0.3 * (1 << match.level) ? 1 : 0;
        }
      }
    }
    EXPECT_GT(basin.tried, 300);
    EXPECT_GE(basin.right, 0.95 * basin.tried) << "coarsest level " << level << ": " << basin.right << " of " << basin.tried;
    EXPECT_LE(basin.wrong, 0.02 * basin.tried) << "coarsest level " << level << ": " << basin.wrong << " of " << basin.tried;
  }
}

TEST_F(PatchAligner, BeyondTheBasinIsNotFound) {
  const PatchMatch match =
      alignPatch(host_, host_, {kCentre, kCentre + Eigen::Vector2d(45.0, 0.0), Eigen::Matrix2d::Identity(), 0}, config_);
  EXPECT_FALSE(match.found);
}

// Cramér-Rao: the covariance of the shift is sigma^2 (J^T J)^-1 over the patch; the bound is met but for interpolation.
TEST_F(PatchAligner, NoiseBlursTheAnswerAsMuchAsTheTextureAllows) {
  constexpr double kSigma = 6.0;
  constexpr int kHalfPatch_px = 5;
  const Change change{.shift_px = {0.4, 0.3}};
  const cv::Mat clean = targetOf(change).level(0);
  cv::Mat noise(kSize, CV_32FC1);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::NORMAL, 0.0, kSigma);
  cv::Mat noisy;
  cv::add(clean, noise, noisy, cv::noArray(), CV_8U);
  const ImagePyramid target(noisy, kLevels);
  double squares = 0.0;
  double expected = 0.0;
  int found = 0;
  for (double x = 30.0; x < 290.0; x += 13.0) {
    for (double y = 30.0; y < 210.0; y += 13.0) {
      Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
      for (int v = -kHalfPatch_px; v <= kHalfPatch_px; ++v) {
        for (int u = -kHalfPatch_px; u <= kHalfPatch_px; ++u) {
          const Eigen::Vector2d px(x + u, y + v);
          const Eigen::Vector2d J(texture_.at(px + Eigen::Vector2d(0.5, 0.0)) - texture_.at(px - Eigen::Vector2d(0.5, 0.0)),
                                  texture_.at(px + Eigen::Vector2d(0.0, 0.5)) - texture_.at(px - Eigen::Vector2d(0.0, 0.5)));
          normal += J * J.transpose();
        }
      }
      const PatchMatch match = alignPatch(host_, target, {{x, y}, moved(change, {x, y}), Eigen::Matrix2d::Identity(), 0}, config_);
      if (match.found) {
        ++found;
        squares += (match.target_px - moved(change, {x, y})).squaredNorm();
        expected += kSigma * kSigma * normal.inverse().trace();
      }
    }
  }
  EXPECT_GT(found, 250);
  EXPECT_LT(std::sqrt(squares / found), 1.4 * std::sqrt(expected / found));
  EXPECT_GT(std::sqrt(squares / found), 0.5 * std::sqrt(expected / found));
}

TEST_F(PatchAligner, PlainPatchesAreRefused) {
  const ImagePyramid plain(cv::Mat(kSize, CV_8UC1, cv::Scalar(120)), kLevels);
  EXPECT_FALSE(alignPatch(plain, plain, {kCentre, kCentre, Eigen::Matrix2d::Identity(), 3}, config_).found);
}

// A covered lens must not look like every patch.
TEST_F(PatchAligner, PlainTargetsAreRefused) {
  for (const int gray : {0, 77, 128, 255}) {
    const ImagePyramid plain(cv::Mat(kSize, CV_8UC1, cv::Scalar(gray)), kLevels);
    for (double x = 40.0; x < 280.0; x += 30.0) {
      EXPECT_FALSE(alignPatch(host_, plain, {{x, 120.0}, {x + 0.3, 120.4}, Eigen::Matrix2d::Identity(), 2}, config_).found) << gray;
    }
  }
}

// An edge alone can be located across, not along: the aperture problem.
TEST_F(PatchAligner, EdgesAreRefused) {
  const ImagePyramid stripes(WaveTexture::sample(kSize, [](const Eigen::Vector2d& px) { return 128.0 + 80.0 * std::sin(0.3 * px.x()); }),
                             kLevels);
  EXPECT_FALSE(alignPatch(stripes, stripes, {kCentre, kCentre, Eigen::Matrix2d::Identity(), 0}, config_).found);
}

TEST_F(PatchAligner, OccludedPatchesAreRefused) {
  const WaveTexture other(99);
  int found = 0;
  int tried = 0;
  const ImagePyramid target(other.image(kSize), kLevels);
  for (double x = 40.0; x < 280.0; x += 12.0) {
    for (double y = 40.0; y < 200.0; y += 12.0) {
      ++tried;
      found += alignPatch(host_, target, {{x, y}, {x, y}, Eigen::Matrix2d::Identity(), 0}, config_).found ? 1 : 0;
    }
  }
  EXPECT_GT(tried, 250);
  EXPECT_LE(found, tried / 10) << "of " << tried;  // chance resemblance of smooth patches
}

TEST_F(PatchAligner, HalfOccludedPatchIsRefused) {
  cv::Mat covered = host_.level(0).clone();
  covered(cv::Rect(160, 0, 160, 240)).setTo(255);
  covered(cv::Rect(160, 0, 160, 60)).setTo(0);
  const PatchMatch match = alignPatch(host_, ImagePyramid(covered, kLevels), {kCentre, kCentre, Eigen::Matrix2d::Identity(), 0}, config_);
  EXPECT_FALSE(match.found && (match.target_px - kCentre).norm() > 1.0);
  EXPECT_LT(match.correlation, 0.95);
}

TEST_F(PatchAligner, PatchesThatLeaveTheImageAreRefused) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  for (const Eigen::Vector2d& outside : {Eigen::Vector2d(3.0, 120.0), Eigen::Vector2d(317.0, 120.0), Eigen::Vector2d(160.0, 2.0),
                                         Eigen::Vector2d(160.0, 238.0), Eigen::Vector2d(-50.0, 120.0), Eigen::Vector2d(160.0, 1e9)}) {
    EXPECT_FALSE(alignPatch(host_, host_, {outside, kCentre, I, 3}, config_).found) << "host " << outside.transpose();
    EXPECT_FALSE(alignPatch(host_, host_, {kCentre, outside, I, 0}, config_).found) << "target " << outside.transpose();
  }
}

TEST_F(PatchAligner, NanIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  EXPECT_FALSE(alignPatch(host_, host_, {{nan, 120.0}, kCentre, I, 2}, config_).found);
  EXPECT_FALSE(alignPatch(host_, host_, {kCentre, {160.0, nan}, I, 2}, config_).found);
  EXPECT_FALSE(alignPatch(host_, host_, {kCentre, kCentre, nan * I, 2}, config_).found);
  EXPECT_FALSE(alignPatch(host_, host_, {kCentre, kCentre, 0.0 * I, 2}, config_).found);
}

// A picture blurred by turning fast still gives a coarse answer, and says that it is one. The sharp patch does not look quite like
// the blurred one: one in three answers is off by more than three quarters of a pixel of its level.
TEST_F(PatchAligner, BlurGivesACoarseAnswer) {
  const Change change{.shift_px = {5.0, 2.0}};
  cv::Mat blurred;
  cv::GaussianBlur(targetOf(change).level(0), blurred, cv::Size(0, 0), 4.5);
  const ImagePyramid target(blurred, kLevels);
  int coarse = 0;
  int near = 0;
  int refused = 0;
  PatchAlignerConfig fine_only = config_;
  fine_only.coarsest_answer = 0;
  for (double x = 80.0; x < 240.0; x += 16.0) {
    for (double y = 80.0; y < 160.0; y += 16.0) {
      const PatchQuery query{{x, y}, moved(change, {x, y}) + Eigen::Vector2d(2.0, -1.0), Eigen::Matrix2d::Identity(), 3};
      const PatchMatch match = alignPatch(host_, target, query, config_);
      if (match.found && match.level > 0) {
        ++coarse;
        EXPECT_LE(match.level, config_.coarsest_answer);
        near += (match.target_px - moved(change, {x, y})).norm() < 0.75 * (1 << match.level) ? 1 : 0;
        refused += alignPatch(host_, target, query, fine_only).found ? 0 : 1;
      }
    }
  }
  EXPECT_GT(coarse, 10);
  EXPECT_GE(near, 0.6 * coarse) << near << " of " << coarse;
  EXPECT_EQ(refused, coarse);
}

}  // namespace
}  // namespace oikos::mapping
