// SPDX-License-Identifier: Apache-2.0
#include "registration/view_box.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/model/primitives.h"
#include "tests/registration/furniture_scan.h"

namespace oikos::registration {
namespace {

/// A box of half a metre, `x_m` to the right and `z_m` ahead.
render::Scene boxAt(double x_m, double z_m) {
  render::Scene scene;
  scene.add(std::make_shared<const model::TriangleMesh>(model::makeBox({0.5F, 0.5F, 0.5F})),
            Eigen::Isometry3d(Eigen::Translation3d(x_m, 0.0, z_m)));
  scene.commit();
  return scene;
}

TEST(ViewBox, HoldsWhatIsRenderedAndTheMargin) {
  const camera::PinholeCamera camera = test::kinectCamera();
  const render::Scene scene = boxAt(0.2, 2.25);
  const render::View view = test::viewOf(scene, camera);
  const PixelBox box = boxInView(scene, Eigen::Isometry3d::Identity(), camera, 0.1);
  int pixels = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (view.part.at<int>(v, u) >= 0) {
        ++pixels;
        ASSERT_TRUE(u >= box.left && u < box.right && v >= box.top && v < box.bottom);
      }
    }
  }
  EXPECT_GT(pixels, 10000);
  EXPECT_NEAR(box.left, 319.5 - 0.05 / 2.0 * 525.0 - 0.1 / 2.0 * 525.0 - 8.0, 1.0);
  EXPECT_NEAR(box.bottom, 239.5 + 0.25 / 2.0 * 525.0 + 0.1 / 2.0 * 525.0 + 8.0, 2.0);
}

TEST(ViewBox, IsEmptyBesideThePictureAndAllOfItAroundTheCamera) {
  const camera::PinholeCamera camera = test::kinectCamera();
  const PixelBox beside = boxInView(boxAt(20.0, 2.0), Eigen::Isometry3d::Identity(), camera, 0.1);
  EXPECT_LE(beside.right, beside.left);
  const PixelBox around = boxInView(boxAt(0.0, 0.0), Eigen::Isometry3d::Identity(), camera, 0.1);
  EXPECT_TRUE(around.contains({0, 0, 640, 480}));
}

}  // namespace
}  // namespace oikos::registration
