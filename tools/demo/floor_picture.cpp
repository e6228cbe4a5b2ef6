// SPDX-License-Identifier: Apache-2.0
#include "tools/demo/floor_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "semantic/model/home_models.h"
#include "semantic/model/placement.h"

namespace oikos::demo {

namespace {

using namespace semantic;

constexpr double kPixelsPerMetre = 110.0;
constexpr double kMargin_m = 0.4;
constexpr float kLowest_m = -0.1F;
constexpr float kHighest_m = 2.1F;

const cv::Scalar kOutline(60, 60, 60);
const cv::Scalar kFurniture(150, 60, 20);
const cv::Scalar kMoving(30, 90, 230);
const cv::Scalar kSmall(40, 160, 40);
const cv::Scalar kPath(200, 80, 180);

class Canvas {
 public:
  explicit Canvas(const Home& home) {
    for (const Room& room : home.rooms) {
      for (const Eigen::Vector2d& corner : room.outline_map) {
        bounds_.extend(corner);
      }
    }
    bounds_.min().array() -= kMargin_m;
    bounds_.max().array() += kMargin_m;
    const Eigen::Vector2d size = kPixelsPerMetre * bounds_.sizes();
    image = cv::Mat(static_cast<int>(size.y()), static_cast<int>(size.x()), CV_8UC3, cv::Scalar::all(255));
  }

  [[nodiscard]] cv::Point at(const Eigen::Vector2d& place_map) const {
    return {static_cast<int>(std::lround(kPixelsPerMetre * (place_map.x() - bounds_.min().x()))),
            static_cast<int>(std::lround(kPixelsPerMetre * (bounds_.max().y() - place_map.y())))};
  }

  void polygon(const std::vector<Eigen::Vector2d>& corners_map, const cv::Scalar& color, int thickness) {
    std::vector<cv::Point> pixels;
    std::transform(corners_map.begin(), corners_map.end(), std::back_inserter(pixels), [&](const auto& corner) { return at(corner); });
    cv::polylines(image, pixels, true, color, thickness, cv::LINE_AA);
  }

  void text(const std::string& words, const Eigen::Vector2d& place_map) {
    constexpr double kScale = 0.38;
    const cv::Size size = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, kScale, 1, nullptr);
    const cv::Point left = at(place_map) - cv::Point(size.width / 2, -size.height / 2);
    cv::putText(image, words, left, cv::FONT_HERSHEY_SIMPLEX, kScale, cv::Scalar::all(255), 3, cv::LINE_AA);
    cv::putText(image, words, left, cv::FONT_HERSHEY_SIMPLEX, kScale, cv::Scalar::all(20), 1, cv::LINE_AA);
  }

  cv::Mat image;

 private:
  Eigen::AlignedBox2d bounds_;
};

void drawCloud(const geometry::ColoredCloud& cloud_map, Canvas& canvas) {
  cv::Mat height(canvas.image.size(), CV_32FC1, cv::Scalar(-1e9));
  for (std::size_t i = 0; i < cloud_map.points.size(); ++i) {
    const Eigen::Vector3f& point = cloud_map.points[i];
    const cv::Point pixel = canvas.at(point.head<2>().cast<double>());
    if (point.z() < kLowest_m || point.z() > kHighest_m || !cv::Rect({}, canvas.image.size()).contains(pixel)) {
      continue;
    }
    for (const cv::Point offset : {cv::Point(0, 0), cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1)}) {
      const cv::Point place = pixel + offset;
      if (cv::Rect({}, canvas.image.size()).contains(place) && point.z() > height.at<float>(place)) {
        height.at<float>(place) = point.z();
        const geometry::Rgb color = cloud_map.colors.empty() ? geometry::Rgb{120, 120, 120} : cloud_map.colors[i];
        canvas.image.at<cv::Vec3b>(place) = {color[2], color[1], color[0]};
      }
    }
  }
  canvas.image.convertTo(canvas.image, -1, 0.75, 64.0);  // paler, so that what is drawn over it can be read
}

std::vector<Eigen::Vector2d> footprint(const Eigen::AlignedBox3f& bounds_part, const Eigen::Isometry3d& T_map_part) {
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [x, y] :
       {std::pair(bounds_part.min().x(), bounds_part.min().y()), std::pair(bounds_part.max().x(), bounds_part.min().y()),
        std::pair(bounds_part.max().x(), bounds_part.max().y()), std::pair(bounds_part.min().x(), bounds_part.max().y())}) {
    corners.emplace_back((T_map_part * Eigen::Vector3d(x, y, bounds_part.min().z())).head<2>());
  }
  return corners;
}

void drawObject(const LargeObject& object, ModelMaker& maker, Canvas& canvas) {
  const model::ArticulatedModel model = maker.make(object);
  const std::vector<double> values = jointValues(object);
  const std::vector<Eigen::Isometry3d> T_model_parts = model::Kinematics(model).solve(values);
  const Eigen::Isometry3d T_map_object = object.T_map_object.toIsometry();
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    if (model.parts[i].mesh_part) {
      const bool is_base = i == 0;
      canvas.polygon(footprint(model.parts[i].mesh_part->bounds(), T_map_object * T_model_parts[i]), is_base ? kFurniture : kMoving,
                     is_base ? 2 : 1);
    }
  }
}

void drawSmallObjects(const LargeObject& object, Canvas& canvas) {
  for (const SmallObject& small : object.small_objects) {
    if (const auto T_map_parent = findCarrierInMap(object, small.parent)) {
      const Eigen::Vector3d place_map = *T_map_parent * small.T_parent_object.position_m;
      cv::circle(canvas.image, canvas.at(place_map.head<2>()), 4, kSmall, -1, cv::LINE_AA);
    }
  }
}

}  // namespace

cv::Mat drawFloor(const FloorPicture& picture) {
  Canvas canvas(picture.home);
  drawCloud(picture.cloud_map, canvas);
  ModelMaker maker({});
  for (std::size_t i = 1; i < picture.T_map_base.size(); ++i) {
    cv::line(canvas.image, canvas.at(picture.T_map_base[i - 1].T_map_camera.translation().head<2>()),
             canvas.at(picture.T_map_base[i].T_map_camera.translation().head<2>()), kPath, 2, cv::LINE_AA);
  }
  for (const Room& room : picture.home.rooms) {
    canvas.polygon(room.outline_map, kOutline, 2);
    for (const LargeObject& object : room.objects) {
      drawObject(object, maker, canvas);
      drawSmallObjects(object, canvas);
    }
  }
  for (const Room& room : picture.home.rooms) {
    for (const LargeObject& object : room.objects) {
      if (object.type != "picture" && object.type != "rug") {
        canvas.text(object.label.empty() ? object.type : object.label, object.T_map_object.position_m.head<2>());
      }
    }
  }
  return canvas.image;
}

}  // namespace oikos::demo
