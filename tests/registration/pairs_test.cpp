// SPDX-License-Identifier: Apache-2.0
#include "registration/pairs.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "core/model/primitives.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/enum_table_check.h"

namespace oikos::registration {
namespace {

/// A wall 2 m before the camera, 1 m wide, rendered in the pixels of a scan.
struct WallView {
  render::Scene scene;
  render::View view;
  explicit WallView(const camera::PinholeCamera& camera) {
    scene.add(std::make_shared<const model::TriangleMesh>(model::makeBox({1.0F, 1.0F, 0.2F})),
              Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 2.1)));
    scene.commit();
    view = test::viewOf(scene, camera);
  }
};

Scan flatScan(double depth_m) {
  return makeScan(cv::Mat(480, 640, CV_32FC1, cv::Scalar(depth_m)), test::kinectCamera(), {});
}

class PairsTest : public testing::TestWithParam<Association> {
 protected:
  static Pairing pair(const WallView& wall, const Scan& scan, const PairRules& rules = {}) {
    return GetParam() == Association::kProjective ? projectivePairs(wall.view, scan, Eigen::Isometry3d::Identity(), rules)
                                                  : nearestPairs(wall.view, scan, Eigen::Isometry3d::Identity(), rules);
  }
};

TEST_P(PairsTest, ResidualIsTheDistanceInFrontOfTheSurface) {
  const WallView wall(flatScan(2.0).camera);
  for (const double offset_m : {-0.03, 0.0, 0.02}) {
    const Pairing found = pair(wall, flatScan(2.0 - offset_m));
    ASSERT_GT(found.pairs.size(), 3000U);
    for (const Pair& p : found.pairs) {
      ASSERT_NEAR(p.residual_m(), offset_m, 1e-4);
      ASSERT_GT(p.sigma_m, 0.002);
      ASSERT_LT(p.sigma_m, 0.02);
    }
  }
}

TEST_P(PairsTest, CountsWhatIsHiddenAndWhatIsNotThere) {
  const WallView wall(flatScan(2.0).camera);
  const Pairing there = pair(wall, flatScan(2.0));
  EXPECT_EQ(there.counts.unread + there.counts.occluded + there.counts.seen_through, 0);
  EXPECT_NEAR(there.counts.model, 65.6 * 65.6, 140.0);  // 1 m at 2 m, 131 px focal length
  const Pairing hidden = pair(wall, flatScan(1.0));
  EXPECT_EQ(hidden.counts.occluded, hidden.counts.model);
  EXPECT_TRUE(hidden.pairs.empty());
  const Pairing gone = pair(wall, flatScan(3.0));
  EXPECT_EQ(gone.counts.seen_through, gone.counts.model);
  EXPECT_TRUE(gone.pairs.empty());
  const Pairing dark = pair(wall, flatScan(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(dark.counts.unread, dark.counts.model);
  EXPECT_TRUE(dark.pairs.empty());
}

TEST_P(PairsTest, SurfacesThatFaceAnotherWayAreNoPair) {
  const WallView wall(flatScan(2.0).camera);
  Scan scan = flatScan(2.0);
  for (ScanPoint& point : scan.points) {
    point.normal_camera = Eigen::Vector3f(0.8F, 0.0F, -0.6F);
  }
  const Pairing found = pair(wall, scan);
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_EQ(found.counts.turned, found.counts.model);
  EXPECT_EQ(found.counts.seen_through, 0);
}

TEST_P(PairsTest, AModelOutOfViewHasNoPairs) {
  render::Scene empty;
  empty.commit();
  WallView wall(flatScan(2.0).camera);
  wall.view = test::viewOf(empty, flatScan(2.0).camera);
  const Pairing found = pair(wall, flatScan(2.0));
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_EQ(found.counts.model, 0);
}

INSTANTIATE_TEST_SUITE_P(Each, PairsTest, testing::Values(Association::kProjective, Association::kNearest),
                         [](const auto& test) { return std::string(base::toString(test.param)); });

TEST(Association, EveryValueHasAName) {
  test::checkEnumTable(Association::kNearest);
}

}  // namespace
}  // namespace oikos::registration
