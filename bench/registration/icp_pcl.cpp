// SPDX-License-Identifier: Apache-2.0
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>

#include "bench/registration/icp_peers.h"

namespace oikos::bench {

namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

Cloud::Ptr toPcl(const std::vector<Eigen::Vector3d>& points) {
  const Cloud::Ptr cloud(new Cloud);
  cloud->resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    (*cloud)[i].getVector3fMap() = points[i].cast<float>();
  }
  return cloud;
}

void estimateNormals(const Cloud::Ptr& cloud) {
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setKSearch(20);
  estimation.setViewPoint(0.0F, 0.0F, 0.0F);
  Cloud normals;
  estimation.compute(normals);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].getNormalVector3fMap() = normals[i].getNormalVector3fMap();
  }
}

}  // namespace

Eigen::Isometry3d alignByPcl(const IcpClouds& clouds, double correspondence_m) {
  const Cloud::Ptr source = toPcl(clouds.scan);
  const Cloud::Ptr target = toPcl(clouds.model);
  for (std::size_t i = 0; i < target->size(); ++i) {
    (*target)[i].getNormalVector3fMap() = clouds.model_normals[i].cast<float>();
  }
  estimateNormals(source);
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaxCorrespondenceDistance(correspondence_m);
  icp.setMaximumIterations(50);
  icp.setTransformationEpsilon(1e-8);
  Cloud moved;
  icp.align(moved);
  return Eigen::Isometry3d(icp.getFinalTransformation().cast<double>());
}

}  // namespace oikos::bench
