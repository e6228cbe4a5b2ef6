// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "registration/motion.h"
#include "registration/normal_equations.h"
#include "registration/pairs.h"
#include "registration/scan.h"

namespace oikos::registration {

struct AlignConfig {
  Association association = Association::kProjective;
  bool has_edges = true;            ///< outlines count beside surfaces
  int coarse_columns = 80;          ///< the coarse steps see a scan thinned to at most so many columns
  int coarse_iterations = 16;       ///< at most
  int fine_iterations = 20;         ///< at most
  double coarse_gate_m = 0.30;      ///< distance from the model's plane beyond which nothing is paired, at first
  double fine_gate_m = 0.05;        ///< and in the end
  double max_normal_deg = 40.0;     ///< between the normals of a pair
  double surface_sigma_m = 0.005;   ///< what the model may be wrong by: dimensions taken with a tape
  double normal_sigma_deg = 0.7;    ///< and its planes be turned by
  double min_observability = 10.0;  ///< information over what turned normals would feign; below it a direction is not observed
  int min_inliers = 60;
  double min_overlap = 0.25;  ///< inliers / pixels of the model with a reading and nothing in front
  double max_hidden = 0.8;    ///< share of the model\'s pixels with a reading that may lie behind something; above it: kNotInView
  int threads = 1;            ///< of the renderer

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("association", association);
    visitor("has_edges", has_edges);
    visitor("coarse_columns", coarse_columns);
    visitor("coarse_iterations", coarse_iterations);
    visitor("fine_iterations", fine_iterations);
    visitor("coarse_gate_m", coarse_gate_m);
    visitor("fine_gate_m", fine_gate_m);
    visitor("max_normal_deg", max_normal_deg);
    visitor("surface_sigma_m", surface_sigma_m);
    visitor("normal_sigma_deg", normal_sigma_deg);
    visitor("min_observability", min_observability);
    visitor("min_inliers", min_inliers);
    visitor("min_overlap", min_overlap);
    visitor("max_hidden", max_hidden);
    visitor("threads", threads);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class AlignStatus {
  kNotInView,         ///< the camera sees nothing of the model, has no depth there, or something stands before it
  kTooLittleOverlap,  ///< too few of the model's pixels are where the scan is
  kDegenerate,        ///< converged, but not in the directions named
  kAmbiguous,         ///< another pose explains the scan as well
  kIterationLimit,
  kConverged,
};
constexpr auto enumTable(AlignStatus) {
  return std::to_array<base::EnumName<AlignStatus>>({{AlignStatus::kNotInView, "not in view"},
                                                     {AlignStatus::kTooLittleOverlap, "too little overlap"},
                                                     {AlignStatus::kDegenerate, "degenerate"},
                                                     {AlignStatus::kAmbiguous, "ambiguous"},
                                                     {AlignStatus::kIterationLimit, "iteration limit"},
                                                     {AlignStatus::kConverged, "converged"}});
}

struct [[nodiscard]] AlignResult {
  AlignStatus status = AlignStatus::kNotInView;
  std::vector<std::string> unobserved;  ///< of a degenerate result: the degrees of freedom that mostly make up what was not observed
  int iterations = 0;
  int inliers = 0;
  int before = 0;          ///< pixels of the model with a reading in front of it,
  int through = 0;         ///< and with one behind it
  double overlap = 0.0;    ///< inliers / pixels of the model with a reading and nothing in front
  double fit = 0.0;        ///< inliers / pixels of the model with a reading: what is hidden counts against a pose
  double outline = 0.0;    ///< share of the model\'s outline that is one in the scan
  double rms_m = 0.0;      ///< of the distances from the planes, weighted as the kernel has it
  double moved_m = 0.0;    ///< how far the estimate went: the pivot,
  double moved_rad = 0.0;  ///< and its turn
  StepMatrix covariance;   ///< of the degrees of freedom (m, rad) about the pivot: readings, scaled by their residuals, and surfaces that
                           ///< are off as a whole; (1 m)^2 and (1 rad)^2 along what was not observed
};

/// Brings model and scan together from where `motion` stands: Gauss-Newton on point-to-plane distances, the model rendered again after
/// each step (S213-S218: reference is the rendered model, source the scan; whichever of them `motion` moves, the scan is brought onto
/// the model). `motion` is left at the last estimate; a direction that is not observed is not moved along.
AlignResult align(Motion& motion, const Scan& scan, const AlignConfig& config);

/// How well scan and model agree where `motion` stands; nothing is moved.
AlignResult judge(Motion& motion, const Scan& scan, const AlignConfig& config);

}  // namespace oikos::registration
