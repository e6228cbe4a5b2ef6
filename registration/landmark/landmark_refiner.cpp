// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/landmark_refiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "registration/edge_pairs.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Solution {
  AlignResult fit;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// Somewhere on the way, and how well it explains the scan.
struct Place {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  double explained = 0.0;
};

constexpr double kElsewhere_m = 0.1;
/// Two places are as good as each other unless the prior tells them apart by more squared deviations than these: odds of one to seven.
constexpr double kEqualDeviationsSq = 4.0;

/// What may be left out: a piece, or a part of it that moves.
struct Unit {
  int surface = 0;
  double contradiction = 0.0;
  int agreeing = 0;
};

/// Which surfaces are believed to stand where they are thought to, and what follows.
struct Hypothesis {
  std::vector<char> used;     ///< one a surface
  std::vector<double> moved;  ///< one a landmark: the contradiction that it was left out for, or 0
  std::vector<int> dropped;   ///< surfaces of pieces that stay
  Solution solution;
  std::vector<SurfaceCheck> checks;
  double score = 0.0;      ///< pixels that agree less those that contradict
  double explained = 0.0;  ///< as explains()

  [[nodiscard]] bool contradicts(std::size_t surface) const { return used[surface] != 0 && checks[surface].contradiction > 1.0; }
  [[nodiscard]] bool contradictsAnywhere() const {
    for (std::size_t s = 0; s < used.size(); ++s) {
      if (contradicts(s)) {
        return true;
      }
    }
    return false;
  }
};

class Refiner {
 public:
  Refiner(LandmarkScene& scene, const Scan& scan, const CameraPrior& prior, const LandmarkConfig& config, std::optional<int> only)
      : scene_(scene), scan_(scan), edges_(scan), prior_(prior), config_(config), only_(only), start_(prior.T_map_camera) {}

  LandmarkRefinement run() {
    LandmarkRefinement answer;
    answer.T_map_camera = prior_.T_map_camera;
    answer.covariance = covariance6(planarCovariance(prior_), prior_.T_map_camera);
    best_.used = inView();
    best_.moved.assign(scene_.ids().size(), 0.0);
    if (std::count(best_.used.begin(), best_.used.end(), 1) == 0) {
      return answer;
    }
    evaluate(best_, prior_.T_map_camera);
    const bool is_doubtful = best_.contradictsAnywhere() || best_.solution.fit.overlap < config_.good_overlap;
    if (isWide(prior_, config_.search) || (is_doubtful && hasOtherStarts(prior_, config_.search))) {
      tryOtherStarts();
    }
    answer.rounds = 1;
    while (best_.contradictsAnywhere() && answer.rounds < config_.max_rounds) {
      ++answer.rounds;
      leaveOneOut();
    }
    answer.status = judge();
    answer.rms_m = best_.solution.fit.rms_m;
    answer.overlap = best_.solution.fit.overlap;
    answer.landmarks = contributions();
    if (answer.status == RefinementStatus::kRefined) {
      fuse(best_.solution, answer);
    }
    scene_.show(std::vector<char>(scene_.surfaces().size(), 1));
    return answer;
  }

 private:
  /// Pieces that cover enough of the scan, with all of their parts.
  [[nodiscard]] std::vector<char> inView() const {
    const std::vector<int> pixels = scene_.countInView(scan_, prior_.T_map_camera, config_.align.threads);
    std::vector<int> of_piece(scene_.ids().size(), 0);
    for (std::size_t s = 0; s < pixels.size(); ++s) {
      of_piece[static_cast<std::size_t>(scene_.surfaces()[s].landmark)] += pixels[s];
    }
    std::vector<char> used(pixels.size(), 0);
    for (std::size_t s = 0; s < pixels.size(); ++s) {
      const int landmark = scene_.surfaces()[s].landmark;
      used[s] = of_piece[static_cast<std::size_t>(landmark)] >= leastPixels() && (!only_ || landmark == *only_) ? 1 : 0;
    }
    return used;
  }

  void evaluate(Hypothesis& h, const Eigen::Isometry3d& T_map_camera_start) {
    scene_.show(h.used);
    CameraMotion motion(scene_.scene(), T_map_camera_start, PoseFreedom::kPlanar, prior_.robot_camera);
    h.solution.fit = align(motion, scan_, config_.align);
    h.solution.T_map_camera = motion.T_map_camera();
    examine(h);
  }

  /// What the scan says of the surfaces from where the solution stands.
  void examine(Hypothesis& h) {
    const CameraMotion motion(scene_.scene(), h.solution.T_map_camera, PoseFreedom::kPlanar, prior_.robot_camera);
    h.checks = checkSurfaces(scene_, motion, scan_, edges_, h.solution.fit.covariance, config_.check, config_.align.threads);
    h.score = 0.0;
    Readings readings{static_cast<int>(scan_.points.size())};
    for (std::size_t s = 0; s < h.used.size(); ++s) {
      readings.on += h.checks[s].agreeing;
      readings.through += h.checks[s].through;
      readings.before += h.checks[s].before + h.checks[s].just_before;
      h.score += h.contradicts(s) ? -h.checks[s].visible() : h.used[s] * h.checks[s].agreeing;
    }
    h.explained = explains(readings, h.solution.T_map_camera, prior_, config_.search);
  }

  /// Rows of equal fronts, and far turns, have false answers beside the true one.
  void tryOtherStarts() {
    scene_.show(best_.used);
    const std::vector<char> used = best_.used;
    std::vector<Place> fits = {placeOf(best_)};
    std::vector<Place> starts;
    for (const Eigen::Isometry3d& T_map_camera_start : findStarts(scene_, scan_, prior_, config_.align, config_.search)) {
      Hypothesis other;
      other.used = used;
      other.moved.assign(scene_.ids().size(), 0.0);
      evaluate(other, T_map_camera_start);
      fits.push_back(placeOf(other));
      Hypothesis unmoved = other;
      unmoved.solution.T_map_camera = T_map_camera_start;
      examine(unmoved);
      starts.push_back(placeOf(unmoved));
      if (other.explained > best_.explained) {
        best_ = std::move(other);
      }
    }
    start_ = best_.solution.T_map_camera;
    keepRivals(fits, best_.explained - kEqualDeviationsSq * config_.search.prior_share);
    keepRivals(starts, best_.explained);  // nothing has been fitted there: where the fit belongs, it is better than its start
  }

  static Place placeOf(const Hypothesis& h) { return {h.solution.T_map_camera, h.explained}; }

  void keepRivals(const std::vector<Place>& places, double least_explained) {
    for (const Place& place : places) {
      if (place.explained > least_explained) {
        rivals_.push_back(place.T_map_camera);
      }
    }
  }

  /// Whether a rival is somewhere else than the answer, as far as the answer was observed.
  [[nodiscard]] bool hasRival() const {
    const Solution& solution = best_.solution;
    return std::any_of(rivals_.begin(), rivals_.end(), [&](const Eigen::Isometry3d& T_map_rival) {
      CameraPrior rival = prior_;
      rival.T_map_camera = T_map_rival;
      const Step back = stepToPrior(rival, solution.T_map_camera);
      const double deviations = std::sqrt(back.dot(solution.fit.covariance.ldlt().solve(back)));
      return back.head<2>().norm() > kElsewhere_m && deviations > config_.max_deviations;
    });
  }

  /// Those that contradict most; and the one that most agrees, for it may have pulled the answer to itself.
  [[nodiscard]] std::vector<Unit> suspects() const {
    constexpr std::size_t kMost = 3;
    std::vector<Unit> contradicting;
    Unit heaviest;
    for (std::size_t s = 0; s < best_.used.size(); ++s) {
      const Unit unit{static_cast<int>(s), best_.checks[s].contradiction, best_.checks[s].agreeing};
      if (best_.contradicts(s)) {
        contradicting.push_back(unit);
      } else if (best_.used[s] != 0 && scene_.surfaces()[s].is_base && unit.agreeing > heaviest.agreeing) {
        heaviest = unit;
      }
    }
    std::stable_sort(contradicting.begin(), contradicting.end(),
                     [](const Unit& a, const Unit& b) { return a.contradiction > b.contradiction; });
    contradicting.resize(std::min(contradicting.size(), kMost));
    if (heaviest.agreeing > 0) {
      contradicting.push_back(heaviest);
    }
    return contradicting;
  }

  /// Of all that could be left out next, what leaves most agreement.
  void leaveOneOut() {
    Hypothesis next;
    for (const Unit& suspect : suspects()) {
      Hypothesis without = best_;
      leaveOut(static_cast<std::size_t>(suspect.surface), without);
      evaluate(without, start_);
      if (next.used.empty() || without.score > next.score) {
        next = std::move(without);
      }
    }
    best_ = std::move(next);
  }

  /// With its base a piece goes as a whole.
  void leaveOut(std::size_t surface, Hypothesis& h) const {
    const LandmarkSurface& out = scene_.surfaces()[surface];
    h.used[surface] = 0;
    if (!out.is_base) {
      h.dropped.push_back(static_cast<int>(surface));
      return;
    }
    h.moved[static_cast<std::size_t>(out.landmark)] = std::max(1.0, h.checks[surface].contradiction);
    for (std::size_t s = 0; s < h.used.size(); ++s) {
      if (scene_.surfaces()[s].landmark == out.landmark) {
        h.used[s] = 0;
      }
    }
  }

  [[nodiscard]] double leastPixels() const {
    const auto readings =
        std::count_if(scan_.points.begin(), scan_.points.end(), [](const ScanPoint& p) { return p.point_camera.z() > 0.0F; });
    return std::max(1.0, config_.min_share * static_cast<double>(readings));
  }

  [[nodiscard]] std::vector<LandmarkContribution> contributions() const {
    std::vector<LandmarkContribution> all(scene_.ids().size());
    double agreeing = 0.0;
    for (std::size_t s = 0; s < best_.checks.size(); ++s) {
      LandmarkContribution& piece = all[static_cast<std::size_t>(scene_.surfaces()[s].landmark)];
      piece.pixels += best_.checks[s].pixels;
      piece.agreeing += best_.checks[s].agreeing;
      piece.contradiction = std::max(piece.contradiction, best_.used[s] != 0 ? best_.checks[s].contradiction : 0.0);
      agreeing += best_.checks[s].agreeing;
    }
    for (const int surface : best_.dropped) {
      const LandmarkSurface& part = scene_.surfaces()[static_cast<std::size_t>(surface)];
      all[static_cast<std::size_t>(part.landmark)].dropped_parts.push_back(part.part);
    }
    std::vector<LandmarkContribution> in_view;
    const double least = leastPixels();
    for (std::size_t i = 0; i < all.size(); ++i) {
      LandmarkContribution& piece = all[i];
      piece.id = scene_.ids()[i];
      if (best_.moved[i] > 0.0) {
        piece.verdict = LandmarkVerdict::kMoved;
        piece.contradiction = best_.moved[i];
      } else if (piece.agreeing >= least) {
        piece.verdict = piece.dropped_parts.empty() ? LandmarkVerdict::kUsed : LandmarkVerdict::kChanged;
      } else if (!piece.dropped_parts.empty() && piece.agreeing < config_.check.min_pixels) {
        piece.verdict = LandmarkVerdict::kMoved;  // its fronts are not where they were, and nothing else of it is seen
      }
      piece.weight = agreeing > 0.0 ? piece.agreeing / agreeing : 0.0;
      if (piece.pixels >= least || best_.moved[i] > 0.0) {
        in_view.push_back(std::move(piece));
      }
    }
    return in_view;
  }

  [[nodiscard]] RefinementStatus judge() const {
    int agree = 0;
    int moved = 0;
    for (const LandmarkContribution& piece : contributions()) {
      agree += piece.verdict == LandmarkVerdict::kUsed || piece.verdict == LandmarkVerdict::kChanged ? 1 : 0;
      moved += piece.verdict == LandmarkVerdict::kMoved ? 1 : 0;
    }
    if (agree < (only_ ? 1 : config_.min_landmarks)) {
      return moved > 0 ? RefinementStatus::kInconsistent : RefinementStatus::kTooFewLandmarks;
    }
    if (best_.contradictsAnywhere() || moved >= agree || deviations(best_.solution) > config_.max_deviations) {
      return RefinementStatus::kInconsistent;
    }
    if (hasRival()) {
      return RefinementStatus::kAmbiguous;
    }
    const AlignStatus status = best_.solution.fit.status;
    const bool fits = status == AlignStatus::kConverged || status == AlignStatus::kDegenerate || status == AlignStatus::kIterationLimit;
    return fits ? RefinementStatus::kRefined : RefinementStatus::kNotConverged;
  }

  [[nodiscard]] double deviations(const Solution& solution) const {
    const Step back = stepToPrior(prior_, solution.T_map_camera);
    return std::sqrt(back.dot((solution.fit.covariance + planarCovariance(prior_)).ldlt().solve(back)));
  }

  /// The prior answers for what was not observed.
  void fuse(const Solution& solution, LandmarkRefinement& answer) const {
    const StepMatrix fit = solution.fit.covariance + ownPlacement(solution.T_map_camera);
    const StepMatrix gain = fit * (fit + planarCovariance(prior_)).inverse();
    const Step step = gain * stepToPrior(prior_, solution.T_map_camera);
    CameraMotion motion(scene_.scene(), solution.T_map_camera, PoseFreedom::kPlanar, prior_.robot_camera);
    motion.apply(step);
    answer.T_map_camera = motion.T_map_camera();
    answer.covariance = covariance6(fit - gain * fit, answer.T_map_camera);
    answer.unobserved = solution.fit.unobserved;
    answer.moved_m = (answer.T_map_camera * prior_.robot_camera - prior_.T_map_camera * prior_.robot_camera).norm();
    answer.moved_rad = Eigen::AngleAxisd(prior_.T_map_camera.linear().transpose() * answer.T_map_camera.linear()).angle();
  }

  /// How a single piece that stands a little elsewhere, and turned, moves the robot's x, y and yaw: of many, each has its own error; of
  /// one, all surfaces are wrong together.
  [[nodiscard]] StepMatrix ownPlacement(const Eigen::Isometry3d& T_map_camera) const {
    StepMatrix covariance = StepMatrix::Zero(3, 3);
    if (!only_) {
      return covariance;
    }
    const auto is_its = [this](const LandmarkSurface& surface) { return surface.landmark == *only_; };
    const auto first = std::find_if(scene_.surfaces().begin(), scene_.surfaces().end(), is_its) - scene_.surfaces().begin();
    const Eigen::Vector3d piece_map = scene_.scene().parts()[static_cast<std::size_t>(first)].T_map_part.translation();
    const Eigen::Vector3d arm = T_map_camera * prior_.robot_camera - piece_map;
    const double shift_sq = config_.align.surface_sigma_m * config_.align.surface_sigma_m;
    const double turn_rad = config_.align.normal_sigma_deg * kDegree;
    const Eigen::Vector3d turned(-turn_rad * arm.y(), turn_rad * arm.x(), turn_rad);
    covariance.diagonal() << shift_sq, shift_sq, 0.0;
    covariance += turned * turned.transpose();
    return covariance;
  }

  [[nodiscard]] geometry::Matrix6d covariance6(const StepMatrix& planar, const Eigen::Isometry3d& T_map_camera) const {
    return cameraCovariance(planar, {config_.upright_sigma_m, config_.upright_sigma_deg * kDegree}, T_map_camera, prior_.robot_camera);
  }

  LandmarkScene& scene_;
  const Scan& scan_;
  ScanEdges edges_;
  const CameraPrior& prior_;
  const LandmarkConfig& config_;
  std::optional<int> only_;
  Eigen::Isometry3d start_;  ///< of fits without something
  /// T_map_camera of fits that explain the scan nearly as well as the best one, and of starts that do it better than what they came to: in
  /// a row of equal fronts whose end is not known, one place is as good as the next, and a fit may slide along to the neighbours.
  std::vector<Eigen::Isometry3d> rivals_;
  Hypothesis best_;
};

}  // namespace

std::vector<std::string> LandmarkConfig::validate() const {
  base::ConfigRules rules;
  rules.between("min_share", min_share, 0.0, 1.0)
      .atLeast("min_landmarks", min_landmarks, 1)
      .atLeast("max_rounds", max_rounds, 1)
      .between("good_overlap", good_overlap, 0.0, 1.0)
      .greater("max_deviations", max_deviations, 0.0)
      .atLeast("upright_sigma_m", upright_sigma_m, 0.0)
      .atLeast("upright_sigma_deg", upright_sigma_deg, 0.0);
  return rules.messages();
}

LandmarkRefinement refineByLandmarks(LandmarkScene& scene, const Scan& scan, const CameraPrior& prior, const LandmarkConfig& config,
                                     std::optional<int> only) {
  OIKOS_CHECK(!only || (*only >= 0 && *only < static_cast<int>(scene.ids().size())));
  return Refiner(scene, scan, prior, config, only).run();
}

}  // namespace oikos::registration
