// SPDX-License-Identifier: Apache-2.0
#include "registration/align.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/config_rules.h"
#include "core/render/view.h"
#include "registration/edge_pairs.h"
#include "registration/view_box.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLongestStep_m = 0.15;
constexpr double kLongestStep_rad = 0.15;
constexpr double kSmallStep = 2e-4;  ///< m, and rad
constexpr double kNearStep = 0.01;   ///< m, and rad: about a pixel
constexpr double kWithinAPixel = 0.002;
constexpr int kStepsOfALook = 3;
constexpr double kTurnLever_m = 0.5;  ///< a radian counts as much as half a metre

/// The loop, one level after the other.
class Aligner {
 public:
  Aligner(Motion& motion, const AlignConfig& config) : motion_(motion), config_(config) {}

  /// False: nothing to go on with.
  bool runLevel(const Scan& scan, int iterations, double first_gate_m, double last_gate_m, int min_pairs) {
    min_observability_ = first_gate_m > last_gate_m ? 1.0 : config_.min_observability;  // far off, a hint is worth following
    settled_ = false;
    window_.reset();
    for (int i = 0; i < iterations && !(settled_ && i > gateSteps(first_gate_m, last_gate_m)); ++i) {
      const double shrink = std::min(1.0, static_cast<double>(i) / std::max(1, gateSteps(first_gate_m, last_gate_m)));
      gate_m_ = first_gate_m * std::pow(last_gate_m / first_gate_m, shrink);
      look(scan, first_gate_m);
      if (static_cast<int>(pairing_.pairs.size()) < std::max(min_pairs, 6)) {
        return false;
      }
      takeStep();
      const bool is_within_a_pixel = last_step_m_ < kWithinAPixel;  // another picture would pair the same
      settled_ = last_step_m_ < kSmallStep;
      for (int k = 0; k < kStepsOfALook && last_step_m_ >= kSmallStep && last_step_m_ < kNearStep; ++k) {
        followPairs();
        takeStep();
      }
      settled_ = settled_ || (is_within_a_pixel && last_step_m_ < kSmallStep);
      ++iterations_;
    }
    return true;
  }

  /// A step too short to change which pixel is paired with which needs no new picture: the pairs go along with what moved.
  void followPairs() {
    const std::vector<render::ScenePart>& parts = motion_.scene().parts();
    const Eigen::Isometry3d T_scan_moved = motion_.T_map_camera() * looked_.T_map_camera.inverse();
    std::map<int, Eigen::Isometry3d> T_part_moved;
    for (std::size_t i = 0; i < pairing_.pairs.size(); ++i) {
      const Pair& before = looked_.pairs[i];
      const auto part = static_cast<std::size_t>(before.part);
      auto moved = T_part_moved.find(before.part);
      if (moved == T_part_moved.end()) {
        moved = T_part_moved.emplace(before.part, parts[part].T_map_part * looked_.T_map_part[part].inverse()).first;
      }
      Pair& now = pairing_.pairs[i];
      now.model_map = moved->second * before.model_map;
      now.normal_map = moved->second.linear() * before.normal_map;
      now.scan_map = T_scan_moved * before.scan_map;
    }
    sum();
  }

  /// Only where the model can be seen, and a little beside it, is looked at.
  void aim(const Scan& scan, double room_m) {
    const Eigen::Isometry3d T_map_camera = motion_.T_map_camera();
    const PixelBox least = boxInView(motion_.scene(), T_map_camera, scan.camera, config_.fine_gate_m);
    if (!window_ || !window_->box.contains(least)) {
      const PixelBox box = boxInView(motion_.scene(), T_map_camera, scan.camera, room_m);
      window_.emplace(box, cropped(scan, box));
    }
  }

  void look(const Scan& scan, double room_m) {
    aim(scan, room_m);
    const Scan& seen = window_->scan;
    render::ViewConfig view_config;
    view_config.with_normals = true;
    view_config.with_parts = true;
    view_config.threads = config_.threads;
    const Eigen::Isometry3d T_map_camera = motion_.T_map_camera();
    const render::View view = render::renderView(motion_.scene(), window_->rays, {T_map_camera, {}}, view_config);
    const PairRules rules{gate_m_, std::cos(config_.max_normal_deg * kDegree)};
    pairing_ = config_.association == Association::kProjective ? projectivePairs(view, seen, T_map_camera, rules)
                                                               : nearestPairs(view, seen, T_map_camera, rules);
    if (config_.has_edges) {
      outline_places_ = appendEdgePairs(view, seen, window_->edges, T_map_camera, gate_m_, pairing_.pairs);
    }
    looked_.pairs = pairing_.pairs;
    looked_.T_map_camera = T_map_camera;
    looked_.T_map_part.clear();
    for (const render::ScenePart& part : motion_.scene().parts()) {
      looked_.T_map_part.push_back(part.T_map_part);
    }
    sum();
  }

  void sum() {
    equations_ = sumUp(pairing_.pairs, motion_, {config_.surface_sigma_m, config_.normal_sigma_deg * kDegree, gate_m_ / 3.0});
    observability_ = observe(equations_);
  }

  void lookClosely(const Scan& scan) {
    gate_m_ = config_.fine_gate_m;
    min_observability_ = config_.min_observability;
    window_.reset();
    look(scan, config_.fine_gate_m);
  }

  /// What the last picture of the whole scan says; the last step was too short to change it.
  void finish() { followPairs(); }
  [[nodiscard]] bool isSettled() const { return settled_; }

  [[nodiscard]] AlignResult result() const {
    AlignResult result;
    const PairCounts& counts = pairing_.counts;
    const int readings = counts.model - counts.unread;
    result.iterations = iterations_;
    result.inliers = equations_.inliers;
    result.before = counts.occluded;
    result.through = counts.seen_through;
    result.overlap = equations_.inliers / std::max(1.0, static_cast<double>(readings - counts.occluded));
    result.fit = equations_.inliers / std::max(1.0, static_cast<double>(readings));
    result.outline = equations_.edge_inliers / std::max(1.0, static_cast<double>(outline_places_));
    result.rms_m = equations_.weight > 0.0 ? std::sqrt(equations_.squares_m / equations_.weight) : 0.0;
    result.covariance = covariance();
    if (readings < config_.min_inliers || counts.occluded > config_.max_hidden * readings) {
      result.status = AlignStatus::kNotInView;
    } else if (equations_.inliers < config_.min_inliers || result.overlap < config_.min_overlap) {
      result.status = AlignStatus::kTooLittleOverlap;
    } else if (!isObserved(0)) {
      result.status = AlignStatus::kDegenerate;
      result.unobserved = unobserved();
    } else {
      result.status = settled_ ? AlignStatus::kConverged : AlignStatus::kIterationLimit;
    }
    return result;
  }

  void settle() { settled_ = true; }

 private:
  static int gateSteps(double first_gate_m, double last_gate_m) { return first_gate_m > last_gate_m ? 5 : 0; }

  [[nodiscard]] bool isObserved(std::size_t direction) const { return observability_.ratio[direction] >= min_observability_; }

  /// Along what is observed only (Zhang, Kaess & Singh, "On degeneracy of optimization-based state estimation problems", ICRA 2016): of
  /// all steps that solve the observed part, the shortest.
  void takeStep() {
    Step step = Step::Zero(equations_.g.size());
    Eigen::MatrixXd free(equations_.g.size(), 0);
    const Eigen::VectorXd lever = levers();
    for (std::size_t i = 0; i < observability_.ratio.size(); ++i) {
      const auto v = observability_.directions.col(static_cast<Eigen::Index>(i));
      if (isObserved(i)) {
        step -= v * (v.dot(equations_.g) / observability_.ratio[i]);
      } else {
        free.conservativeResize(Eigen::NoChange, free.cols() + 1);
        free.col(free.cols() - 1) = lever.asDiagonal() * v;
      }
    }
    if (free.cols() > 0) {
      const Eigen::VectorXd scaled = lever.asDiagonal() * step;
      const Eigen::VectorXd needless = free * free.colPivHouseholderQr().solve(scaled);
      step -= lever.cwiseInverse().asDiagonal() * needless;
    }
    const double length = lengthOf(step);
    if (length > 1.0) {
      step /= length;
    }
    motion_.apply(step);
    last_step_m_ = length * kLongestStep_m;
  }

  /// What makes a turn as long as a way.
  [[nodiscard]] Eigen::VectorXd levers() const {
    Eigen::VectorXd lever(equations_.g.size());
    for (Eigen::Index i = 0; i < lever.size(); ++i) {
      lever[i] = isTurn(i) ? kTurnLever_m : 1.0;
    }
    return lever;
  }

  /// In longest steps.
  [[nodiscard]] double lengthOf(const Step& step) const {
    double longest = 0.0;
    for (Eigen::Index i = 0; i < step.size(); ++i) {
      longest = std::max(longest, std::abs(step[i]) / (isTurn(i) ? kLongestStep_rad : kLongestStep_m));
    }
    return longest;
  }

  [[nodiscard]] bool isTurn(Eigen::Index i) const { return motion_.freedoms()[static_cast<std::size_t>(i)].is_turn; }

  [[nodiscard]] StepMatrix covariance() const {
    const Eigen::Index size = equations_.g.size();
    StepMatrix inverse = StepMatrix::Zero(size, size);
    StepMatrix unknown = StepMatrix::Zero(size, size);
    for (std::size_t i = 0; i < observability_.ratio.size(); ++i) {
      const auto v = observability_.directions.col(static_cast<Eigen::Index>(i));
      if (isObserved(i)) {
        inverse += v * v.transpose() / observability_.ratio[i];
      } else {
        unknown += v * v.transpose() / v.squaredNorm();
      }
    }
    const double scale = equations_.weight > 0.0 ? std::max(1.0, equations_.squares / equations_.weight) : 1.0;
    return scale * inverse + inverse * equations_.surfaces * inverse + unknown;
  }

  /// For each direction that is not observed the degree of freedom that most of it is.
  [[nodiscard]] std::vector<std::string> unobserved() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < observability_.ratio.size(); ++i) {
      if (isObserved(i)) {
        continue;
      }
      const auto v = observability_.directions.col(static_cast<Eigen::Index>(i));
      Eigen::Index most = 0;
      double most_share = 0.0;
      for (Eigen::Index k = 0; k < v.size(); ++k) {
        const double share = std::abs(v[k]) * (isTurn(k) ? kTurnLever_m : 1.0);
        if (share > most_share) {
          most_share = share;
          most = k;
        }
      }
      const std::string& name = motion_.freedoms()[static_cast<std::size_t>(most)].name;
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
    return names;
  }

  Motion& motion_;
  const AlignConfig& config_;
  double gate_m_ = 0.0;
  double min_observability_ = 0.0;
  /// The part of a scan that is looked at.
  struct Window {
    Window(const PixelBox& in_scan, Scan part) : box(in_scan), scan(std::move(part)), edges(scan), rays(scan.camera) {}
    PixelBox box;
    Scan scan;
    ScanEdges edges;
    render::CameraRays rays;
  };
  std::optional<Window> window_;
  struct Looked {
    std::vector<Pair> pairs;
    Eigen::Isometry3d T_map_camera;
    std::vector<Eigen::Isometry3d> T_map_part;
  };
  Looked looked_;  ///< as the last picture was taken
  Pairing pairing_;
  int outline_places_ = 0;
  NormalEquations equations_;
  Observability observability_;
  int iterations_ = 0;
  double last_step_m_ = 0.0;
  bool settled_ = false;
};

}  // namespace

std::vector<std::string> AlignConfig::validate() const {
  base::ConfigRules rules;
  rules.atLeast("coarse_columns", coarse_columns, 8)
      .atLeast("coarse_iterations", coarse_iterations, 0)
      .atLeast("fine_iterations", fine_iterations, 1)
      .greater("fine_gate_m", fine_gate_m, 0.0)
      .atLeast("coarse_gate_m", coarse_gate_m, fine_gate_m);
  rules.require(max_normal_deg > 0.0 && max_normal_deg <= 90.0, "max_normal_deg", max_normal_deg, "must be > 0 and <= 90");
  return rules.atLeast("surface_sigma_m", surface_sigma_m, 0.0)
      .greater("normal_sigma_deg", normal_sigma_deg, 0.0)
      .greater("min_observability", min_observability, 1.0)
      .atLeast("min_inliers", min_inliers, 6)
      .between("min_overlap", min_overlap, 0.0, 1.0)
      .between("max_hidden", max_hidden, 0.0, 1.0)
      .atLeast("threads", threads, 1)
      .messages();
}

AlignResult align(Motion& motion, const Scan& scan, const AlignConfig& config) {
  const Eigen::Isometry3d T_map_before = motion.T_map_moving();
  const Eigen::Vector3d pivot_moving = T_map_before.inverse() * motion.pivot_map();
  const std::vector<double> before = motion.saved();
  Aligner aligner(motion, config);
  const int thinning = std::max(1, (scan.camera.width + config.coarse_columns - 1) / config.coarse_columns);
  bool found = config.coarse_iterations == 0 || aligner.runLevel(thinned(scan, thinning), config.coarse_iterations, config.coarse_gate_m,
                                                                 config.fine_gate_m, config.min_inliers / (thinning * thinning));
  for (int between = thinning / 2; found && config.coarse_iterations > 0 && between > 1; between /= 2) {  // most steps where points are few
    found = aligner.runLevel(thinned(scan, between), config.fine_iterations, config.fine_gate_m, config.fine_gate_m,
                             config.min_inliers / (4 * between * between));
  }
  const bool fits = found && aligner.runLevel(scan, config.fine_iterations, config.fine_gate_m, config.fine_gate_m, config.min_inliers / 4);
  if (!found) {
    motion.restore(before);
  }
  if (fits && aligner.isSettled()) {
    aligner.finish();
  } else {
    aligner.lookClosely(scan);
  }
  AlignResult result = aligner.result();
  const Eigen::Isometry3d T_map_after = motion.T_map_moving();
  result.moved_m = (T_map_after * pivot_moving - T_map_before * pivot_moving).norm();
  result.moved_rad = Eigen::AngleAxisd(T_map_before.linear().transpose() * T_map_after.linear()).angle();
  return result;
}

AlignResult judge(Motion& motion, const Scan& scan, const AlignConfig& config) {
  Aligner aligner(motion, config);
  aligner.lookClosely(scan);
  aligner.settle();
  return aligner.result();
}

}  // namespace oikos::registration
