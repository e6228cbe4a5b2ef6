// SPDX-License-Identifier: Apache-2.0
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/pipelines/registration/TransformationEstimation.h>

#include "bench/registration/icp_peers.h"

namespace oikos::bench {

Eigen::Isometry3d alignByOpen3d(const IcpClouds& clouds, double correspondence_m) {
  namespace o3d = open3d::pipelines::registration;
  open3d::geometry::PointCloud source(clouds.scan);
  open3d::geometry::PointCloud target(clouds.model);
  target.normals_ = clouds.model_normals;
  source.EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(20));
  source.OrientNormalsTowardsCameraLocation();
  const o3d::RegistrationResult result =
      o3d::RegistrationICP(source, target, correspondence_m, Eigen::Matrix4d::Identity(), o3d::TransformationEstimationPointToPlane(),
                           o3d::ICPConvergenceCriteria(1e-6, 1e-6, 50));
  return Eigen::Isometry3d(result.transformation_);
}

}  // namespace oikos::bench
