// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/mapping/mapping_run.h"
#include "core/camera/sensor/depth_sensor.h"

namespace oikos::bench {

/// A drive of paper 003, table "Visual odometry evaluation", and its scene in homes/demo.
struct Route {
  std::string name;          ///< of the scene
  double paper_ate_m = 0.0;  ///< what the paper measured on its own robot
};
[[nodiscard]] const std::vector<Route>& paperRoutes();

/// One way to drive a route.
struct RouteCase {
  Route route;
  camera::DepthSensorKind sensor = camera::DepthSensorKind::kKinect1;
  double belief_m = 0.0;  ///< how far the camera's true mount is from the one that camera.toml states; calibration errs with it
};

struct RouteScore {
  RouteCase route_case;
  int frames = 0;
  int lost = 0;
  double ate_m = 0.0;   ///< RMSE, after alignment by a rigid motion
  double path_m = 0.0;  ///< along the true positions of the camera
  double simulate_fps = 0.0;
  double map_fps = 0.0;
};

/// Simulates the case into `scratch` and maps it, both by the program as it is. Throws std::runtime_error if either fails or gives nothing
/// that can be compared with the truth.
[[nodiscard]] RouteScore runRoute(const RouteCase& route_case, const MapCommand& command, const std::filesystem::path& home,
                                  const std::filesystem::path& scratch);

}  // namespace oikos::bench
