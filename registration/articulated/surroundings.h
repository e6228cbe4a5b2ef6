// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/render/view.h"
#include "registration/scan.h"

namespace oikos::registration {

/// What stands about the model and is known, as the scan's camera sees it without the model: `depth_m` (CV_32FC1, NaN: nothing known),
/// `normal_camera` (CV_32FC3) and `sigma_m` (CV_32FC1, of where the surface is along its normal), of the scan's size. A wall explains its
/// readings, and no door need lie before it to do so; nothing is seen of what lies behind it. Where a reading lies behind one of these
/// surfaces, it is not there.
struct Surroundings {
  cv::Mat depth_m;
  cv::Mat normal_camera;
  cv::Mat sigma_m;

  [[nodiscard]] bool isEmpty() const { return depth_m.empty(); }
};

/// `view`: of the scan's camera, with normals and parts. Nobody has registered what is about a piece, and the camera is a little off, too:
/// each surface (what of a part faces one way) that the scan shows is brought to where most of its readings are, along its normal, by 3 cm
/// at the most, and is known to 1 cm then; else to 2 cm. A door before a wall is told from the wall by less than that.
[[nodiscard]] Surroundings surroundingsOf(const render::View& view, const Scan& scan);

[[nodiscard]] Surroundings cropped(const Surroundings& surroundings, const PixelBox& box);
/// Every `factor`-th pixel.
[[nodiscard]] Surroundings thinned(const Surroundings& surroundings, int factor);

}  // namespace oikos::registration
