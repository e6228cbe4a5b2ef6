// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/landmark_refiner.h"

#include <algorithm>
#include <utility>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "registration/landmark/landmark_hypothesis.h"
#include "registration/landmark/prior_fusion.h"

namespace oikos::registration {

namespace {

/// Somewhere on the way, and how well it explains the scan.
struct Place {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  double explained = 0.0;
};

/// Two places are as good as each other unless the prior tells them apart by more squared deviations than these: odds of one to seven.
constexpr double kEqualDeviationsSq = 4.0;

class Refiner {
 public:
  Refiner(LandmarkScene& scene, const Scan& scan, const CameraPrior& prior, const LandmarkConfig& config, std::optional<int> only)
      : scene_(scene),
        scan_(scan),
        prior_(prior),
        config_(config),
        only_(only),
        tester_(scene, scan, prior, config),
        fusion_(scene, prior, config, only),
        start_(prior.T_map_camera) {}

  LandmarkRefinement run() {
    LandmarkRefinement answer = fusion_.priorAlone();
    best_.used = inView();
    best_.moved.assign(scene_.ids().size(), 0.0);
    if (std::count(best_.used.begin(), best_.used.end(), 1) == 0) {
      return answer;
    }
    tester_.evaluate(best_, prior_.T_map_camera);
    const bool is_doubtful = best_.contradictsAnywhere() || best_.fit.align.overlap < config_.good_overlap;
    if (isWide(prior_, config_.search) || (is_doubtful && hasOtherStarts(prior_, config_.search))) {
      tryOtherStarts();
    }
    answer.rounds = 1;
    while (best_.contradictsAnywhere() && answer.rounds < config_.max_rounds) {
      ++answer.rounds;
      leaveOneOut();
    }
    answer.status = judge();
    answer.rms_m = best_.fit.align.rms_m;
    answer.overlap = best_.fit.align.overlap;
    answer.landmarks = contributions();
    if (answer.status == RefinementStatus::kRefined) {
      fusion_.fuse(best_.fit, answer);
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

  /// Rows of equal fronts, and far turns, have false answers beside the true one.
  void tryOtherStarts() {
    scene_.show(best_.used);
    const std::vector<char> used = best_.used;
    std::vector<Place> fits = {placeOf(best_)};
    std::vector<Place> starts;
    for (const Eigen::Isometry3d& T_map_camera_start : findStarts(scene_, scan_, prior_, config_.align, config_.search)) {
      LandmarkHypothesis other;
      other.used = used;
      other.moved.assign(scene_.ids().size(), 0.0);
      tester_.evaluate(other, T_map_camera_start);
      fits.push_back(placeOf(other));
      LandmarkHypothesis unmoved = other;
      unmoved.fit.T_map_camera = T_map_camera_start;
      tester_.examine(unmoved);
      starts.push_back(placeOf(unmoved));
      if (other.explained > best_.explained) {
        best_ = std::move(other);
      }
    }
    start_ = best_.fit.T_map_camera;
    keepRivals(fits, best_.explained - kEqualDeviationsSq * config_.search.prior_share);
    keepRivals(starts, best_.explained);  // nothing has been fitted there: where the fit belongs, it is better than its start
  }

  static Place placeOf(const LandmarkHypothesis& h) { return {h.fit.T_map_camera, h.explained}; }

  void keepRivals(const std::vector<Place>& places, double least_explained) {
    for (const Place& place : places) {
      if (place.explained > least_explained) {
        rivals_.push_back(place.T_map_camera);
      }
    }
  }

  /// Whether a rival is somewhere else than the answer, as far as the answer was observed.
  [[nodiscard]] bool hasRival() const {
    return std::any_of(rivals_.begin(), rivals_.end(),
                       [this](const Eigen::Isometry3d& T_map_rival) { return fusion_.isElsewhere(best_.fit, T_map_rival); });
  }

  /// Of all that could be left out next, what leaves most agreement.
  void leaveOneOut() {
    LandmarkHypothesis next;
    for (const std::size_t suspect : suspectsOf(best_, scene_)) {
      LandmarkHypothesis without = best_;
      leaveOut(suspect, scene_, without);
      tester_.evaluate(without, start_);
      if (next.used.empty() || without.score > next.score) {
        next = std::move(without);
      }
    }
    best_ = std::move(next);
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
    if (best_.contradictsAnywhere() || moved >= agree || fusion_.deviations(best_.fit) > config_.max_deviations) {
      return RefinementStatus::kInconsistent;
    }
    if (hasRival()) {
      return RefinementStatus::kAmbiguous;
    }
    const AlignStatus status = best_.fit.align.status;
    const bool fits = status == AlignStatus::kConverged || status == AlignStatus::kDegenerate || status == AlignStatus::kIterationLimit;
    return fits ? RefinementStatus::kRefined : RefinementStatus::kNotConverged;
  }

  LandmarkScene& scene_;
  const Scan& scan_;
  const CameraPrior& prior_;
  const LandmarkConfig& config_;
  std::optional<int> only_;
  HypothesisTester tester_;
  PriorFusion fusion_;
  Eigen::Isometry3d start_;  ///< of fits without something
  /// T_map_camera of fits that explain the scan nearly as well as the best one, and of starts that do it better than what they came to: in
  /// a row of equal fronts whose end is not known, one place is as good as the next, and a fit may slide along to the neighbours.
  std::vector<Eigen::Isometry3d> rivals_;
  LandmarkHypothesis best_;
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
