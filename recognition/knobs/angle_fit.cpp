// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/angle_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>

namespace oikos::recognition {

namespace {

/// Brightness and two tints, which shades and shadows leave as they are.
cv::Mat brightnessAndTints(const cv::Mat& color) {
  constexpr float kDark = 0.25F;  // below it tints are noise
  cv::Mat channels(color.size(), CV_32FC3);
  for (int v = 0; v < color.rows; ++v) {
    for (int u = 0; u < color.cols; ++u) {
      const auto& bgr = color.ptr<cv::Vec3f>(v)[u];
      const float sum = bgr[0] + bgr[1] + bgr[2];
      channels.ptr<cv::Vec3f>(v)[u] = {sum / 3.0F, (bgr[2] - bgr[1]) / (sum + kDark), (bgr[0] - 0.5F * (bgr[1] + bgr[2])) / (sum + kDark)};
    }
  }
  return channels;
}

/// A piece of the face's plane as large as a ring's window, moved by up to `reach_px` each way.
class ShiftedWindows {
 public:
  struct Reach {
    Eigen::Vector2d centre_patch;
    int shift_px;
  };
  /// `mixture`: 1x3, of the colours; empty: brightness and tints.
  ShiftedWindows(const FitStart& start, const cv::Mat& mixture, const AngleRing& ring, const Reach& reach)
      : ring_(ring), reach_px_(reach.shift_px) {
    const int reach_px = reach.shift_px;
    PatchGrid grid;
    grid.size = {ring.columns() + 2 * reach_px, ring.rows() + 2 * reach_px};
    grid.px_per_m = ring.shape().radius_px / start.radius_m;
    grid.origin_px = Eigen::Vector2d(ring.originColumn() + reach_px, ring.originRow() + reach_px);
    grid.centre_patch = reach.centre_patch;
    cv::Mat patch = samplePatch(start.color, start.camera, start.view, grid);
    if (mixture.empty()) {
      patch = brightnessAndTints(patch);
    } else {
      cv::transform(patch, patch, mixture);
    }
    patch -= cv::mean(patch);  // keeps sums of squares exact
    cv::split(patch, channels_);
  }

  [[nodiscard]] std::size_t channels() const { return channels_.size(); }
  /// The energy of the first channel that lies outside the support, a pixel of the support.
  [[nodiscard]] double energyOutside(const Eigen::VectorXf& pixels) const {
    return (cv::norm(channels_[0], cv::NORM_L2SQR) - pixels.squaredNorm()) / static_cast<double>(pixels.size());
  }
  /// The pixels of the support; the mean of the whole piece is 0.
  [[nodiscard]] Eigen::VectorXf at(std::size_t channel, const Eigen::Vector2i& shift_px) const {
    const cv::Mat& image = channels_[channel];
    Eigen::VectorXf pixels(static_cast<Eigen::Index>(ring_.support().size()));
    for (std::size_t i = 0; i < ring_.support().size(); ++i) {
      const int row = ring_.support()[i] / ring_.columns() + reach_px_ + shift_px.y();
      const int column = ring_.support()[i] % ring_.columns() + reach_px_ + shift_px.x();
      pixels[static_cast<Eigen::Index>(i)] = image.ptr<float>(row)[column];
    }
    return pixels;
  }

 private:
  const AngleRing& ring_;
  int reach_px_;
  std::vector<cv::Mat> channels_;
};

constexpr double kNoise = 1e-5;  // mean square of what is no picture, so that an empty one is explained by nothing

/// Of each template, the weighted energy of the pixels about their mean, and what of it is left over.
struct Residuals {
  Eigen::ArrayXXd left;   ///< templates x pictures
  Eigen::ArrayXXd total;  ///< the same
};

/// `pictures`: a column each, pixels of the ring's support.
Residuals residualsOf(const AngleRing& ring, const Eigen::MatrixXf& pictures) {
  const Eigen::MatrixXf parts = (ring.bases() * pictures).cwiseAbs2();
  Residuals residuals;
  residuals.total = (ring.weights() * pictures.cwiseAbs2()).cast<double>().array() + kNoise * static_cast<double>(pictures.rows());
  residuals.left = residuals.total;
  for (int i = 0; i < ring.shape().angles; ++i) {
    const int first = ring.firstRow()[static_cast<std::size_t>(i)];
    const int count = ring.firstRow()[static_cast<std::size_t>(i) + 1] - first;
    residuals.total.row(i) -= parts.row(first).cast<double>().array();
    residuals.left.row(i) -= parts.middleRows(first, count).colwise().sum().cast<double>().array();
  }
  return residuals;
}

struct Place {
  Eigen::Vector2i shift_px = Eigen::Vector2i::Zero();
  Eigen::Index angle = 0;
  double outside = 0.0;  ///< energy that no template is asked to explain
  double cost = 0.0;
};
constexpr int kPlaces = 5;
// What lies outside the support counts, too, though less: else the best place would be where there is nothing to explain.
constexpr double kCoarseOutside = 0.6;
constexpr double kFineOutside = 0.2;

constexpr double kEvidence = 30.0;  // independent pixels, as far as places are concerned

/// What a place costs: half of the residuals' part of the likelihood (state_belief.h), and how far it is from the start and from where the
/// knob is believed to be. `residual`: mean square over all of the picture about the start, explained or not.
double costOf(double residual, const FitStart& start, const Eigen::Vector2d& centre_patch) {
  constexpr double kStartSigma = 0.22;  // in radii
  // Where its sides can be seen, what looks like the middle of a knob may be below the middle of its face.
  const double along_tilt = std::hypot(kStartSigma, 0.3 * std::tan(start.view.tilt_rad));
  const Eigen::Vector2d off = (centre_patch - start.centre_patch) / start.radius_m;
  const double off_start = std::pow(off.x() / kStartSigma, 2) + std::pow(off.y() / along_tilt, 2);
  const double off_belief = centre_patch.squaredNorm() / std::pow(start.belief_sigma_m, 2);
  return 0.5 * (kEvidence * std::log(std::max(1e-9, residual)) + off_start + off_belief);
}

/// The mixture of the colours that varies most about the start: a red knob on grey has no outline in brightness.
cv::Mat strongestMixture(const FitStart& start) {
  constexpr int kRadius_px = 7;
  PatchGrid grid;
  grid.size = {2 * kRadius_px + 1, 2 * kRadius_px + 1};
  grid.origin_px = Eigen::Vector2d::Constant(kRadius_px);
  grid.px_per_m = kRadius_px / (1.2 * start.radius_m);
  grid.centre_patch = start.centre_patch;
  const cv::Mat patch = samplePatch(start.color, start.camera, start.view, grid);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto at = [&](int i) {
    const auto& pixel = patch.at<cv::Vec3f>(i / grid.size.width, i % grid.size.width);
    return Eigen::Vector3d(pixel[0], pixel[1], pixel[2]);
  };
  const int count = grid.size.area();
  for (int i = 0; i < count; ++i) {
    mean += at(i) / count;
  }
  for (int i = 0; i < count; ++i) {
    covariance += (at(i) - mean) * (at(i) - mean).transpose();
  }
  const Eigen::Vector3d direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(2);
  return (cv::Mat_<float>(1, 3) << static_cast<float>(direction[0]), static_cast<float>(direction[1]), static_cast<float>(direction[2]));
}

/// The start and the best places of the small templates, two pixels apart: all shifts in one product.
std::vector<Place> findPlaces(const FitStart& start, const ShiftedWindows& windows, const AngleRing& ring, int reach_px) {
  const double px_per_m = ring.shape().radius_px / start.radius_m;
  const int side = 2 * reach_px + 1;
  Eigen::MatrixXf pixels(static_cast<Eigen::Index>(ring.support().size()), side * side);
  for (int i = 0; i < side * side; ++i) {
    pixels.col(i) = windows.at(0, {i % side - reach_px, i / side - reach_px});
  }
  const Residuals residuals = residualsOf(ring, pixels);
  std::vector<Place> places;
  for (int i = 0; i < side * side; ++i) {
    Place place;
    place.shift_px = {i % side - reach_px, i / side - reach_px};
    const double least = residuals.left.col(i).minCoeff(&place.angle);
    place.outside = windows.energyOutside(pixels.col(i));
    place.cost = costOf(least / static_cast<double>(pixels.rows()) + kCoarseOutside * place.outside, start,
                        start.centre_patch + place.shift_px.cast<double>() / px_per_m);
    places.push_back(place);
  }
  const Place middle = places[places.size() / 2];
  std::stable_sort(places.begin(), places.end(), [](const Place& one, const Place& other) { return one.cost < other.cost; });
  std::vector<Place> apart = {middle};
  for (const Place& place : places) {
    if (static_cast<int>(apart.size()) < kPlaces && std::all_of(apart.begin(), apart.end(), [&](const Place& other) {
          return (other.shift_px - place.shift_px).cwiseAbs().maxCoeff() >= 2;
        })) {
      apart.push_back(place);
    }
  }
  return apart;
}

struct Refined {
  Eigen::Vector2i shift_px = Eigen::Vector2i::Zero();
  double residual = 1e9;  ///< mean square
};

/// The best shift of the large templates about one angle.
Refined refinePlace(const ShiftedWindows& windows, const AngleRing& ring, int middle_angle, int reach_px) {
  constexpr int kNeighbours = 2;
  Refined best;
  for (int y = -reach_px; y <= reach_px; ++y) {
    for (int x = -reach_px; x <= reach_px; ++x) {
      const Eigen::VectorXf pixels = windows.at(0, {x, y});
      const Eigen::VectorXf squares = pixels.cwiseAbs2();
      for (int step = -kNeighbours; step <= kNeighbours; ++step) {
        const int angle = (middle_angle + step + ring.shape().angles) % ring.shape().angles;
        const int first = ring.firstRow()[static_cast<std::size_t>(angle)];
        const int count = ring.firstRow()[static_cast<std::size_t>(angle) + 1] - first;
        const double explained = (ring.bases().middleRows(first, count) * pixels).squaredNorm();
        const double residual = (ring.weights().row(angle).dot(squares) - explained) / static_cast<double>(pixels.size()) + kNoise;
        if (residual < best.residual) {
          best = {{x, y}, residual};
        }
      }
    }
  }
  return best;
}

/// The large templates at one place. Each channel has residuals of its own size: their logarithms are averaged.
AngleFit fitThere(const FitStart& start, const AngleRing& ring, const Eigen::Vector2d& centre_patch) {
  AngleFit fit;
  fit.centre_patch = centre_patch;
  const ShiftedWindows window(start, {}, ring, {centre_patch, 0});
  Eigen::ArrayXd shares = Eigen::ArrayXd::Zero(ring.shape().angles);
  for (std::size_t channel = 0; channel < window.channels(); ++channel) {
    const Residuals residuals = residualsOf(ring, window.at(channel, Eigen::Vector2i::Zero()));
    shares += (residuals.left.col(0) / residuals.total.col(0).mean()).max(1e-6).log();
  }
  shares /= static_cast<double>(window.channels());
  for (Eigen::Index i = 0; i < shares.size(); ++i) {
    fit.unexplained.push_back(std::clamp(std::exp(shares[i]), 1e-6, 1.0));
  }
  return fit;
}

double leastOf(const AngleFit& fit) {
  return *std::min_element(fit.unexplained.begin(), fit.unexplained.end());
}

int bestAngle(const AngleFit& fit) {
  return static_cast<int>(std::min_element(fit.unexplained.begin(), fit.unexplained.end()) - fit.unexplained.begin());
}

/// What the large templates are held against.
struct FineSearch {
  const FitStart& start;
  const cv::Mat& mixture;
  const AngleRing& ring;
};

/// A place and what it costs with the angle that is best there.
struct Candidate {
  AngleFit fit;
  double outside = 0.0;  ///< as a Place's
  double cost = 0.0;
};

/// From a place and an angle to the best place for that angle, a pixel away at most, and to all angles there.
Candidate refine(const FineSearch& search, const Eigen::Vector2d& centre_patch, int angle, double outside) {
  constexpr int kReach_px = 1;
  const ShiftedWindows windows(search.start, search.mixture, search.ring, {centre_patch, kReach_px});
  const Refined refined = refinePlace(windows, search.ring, angle, kReach_px);
  const double px_per_m = search.ring.shape().radius_px / search.start.radius_m;
  Candidate candidate{fitThere(search.start, search.ring, centre_patch + refined.shift_px.cast<double>() / px_per_m), outside, 0.0};
  const double residual = std::sqrt(leastOf(candidate.fit) * (refined.residual + kFineOutside * outside));
  candidate.cost = costOf(residual, search.start, candidate.fit.centre_patch);
  return candidate;
}

bool isCheaper(const Candidate& one, const Candidate& other) {
  return one.cost < other.cost;
}

/// The angle that is best at a place is often not the one that the place was found with: from there once more, for the few that may be
/// the best.
void refineAgain(const FineSearch& search, std::vector<Candidate>& candidates) {
  constexpr std::size_t kAgain = 3;
  std::stable_sort(candidates.begin(), candidates.end(), isCheaper);
  for (std::size_t i = 0; i < std::min(kAgain, candidates.size()); ++i) {
    Candidate again = refine(search, candidates[i].fit.centre_patch, bestAngle(candidates[i].fit), candidates[i].outside);
    if (isCheaper(again, candidates[i])) {
      candidates[i] = std::move(again);
    }
  }
}

/// Half a pixel aside of the best place.
std::vector<Candidate> besides(const FitStart& start, const AngleRing& ring, const Candidate& best) {
  std::vector<Candidate> found;
  const double step_m = 0.5 * start.radius_m / ring.shape().radius_px;
  for (const Eigen::Vector2d& side : {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)}) {
    Candidate candidate{fitThere(start, ring, best.fit.centre_patch + step_m * side), best.outside, 0.0};
    candidate.cost = best.cost + 0.5 * kEvidence * std::log(leastOf(candidate.fit) / leastOf(best.fit));
    found.push_back(std::move(candidate));
  }
  return found;
}

/// The best place; of each angle what the place that suits it best leaves unexplained, made worse by what that place costs more.
AngleFit merge(const std::vector<Candidate>& candidates) {
  const auto best = std::min_element(candidates.begin(), candidates.end(), isCheaper);
  AngleFit merged = best->fit;
  for (const Candidate& candidate : candidates) {
    const double dearer = std::exp((candidate.cost - best->cost) / (0.5 * kEvidence)) * leastOf(best->fit) / leastOf(candidate.fit);
    for (std::size_t i = 0; i < merged.unexplained.size(); ++i) {
      merged.unexplained[i] = std::min(merged.unexplained[i], dearer * candidate.fit.unexplained[i]);
    }
  }
  return merged;
}

}  // namespace

AngleFit fitAngle(const FitStart& start, const RingPair& rings) {
  const cv::Mat mixture = strongestMixture(start);
  const double coarse_px_per_m = rings.coarse.shape().radius_px / start.radius_m;
  const int reach_px = static_cast<int>(std::ceil(start.reach_m * coarse_px_per_m));
  const ShiftedWindows coarse(start, mixture, rings.coarse, {start.centre_patch, reach_px});
  const FineSearch search{start, mixture, rings.fine};
  std::vector<Candidate> candidates;
  for (const Place& place : findPlaces(start, coarse, rings.coarse, reach_px)) {
    const Eigen::Vector2d centre_patch = start.centre_patch + place.shift_px.cast<double>() / coarse_px_per_m;
    const int angle = static_cast<int>(place.angle) * rings.fine.shape().angles / rings.coarse.shape().angles;
    candidates.push_back(refine(search, centre_patch, angle, place.outside));
  }
  refineAgain(search, candidates);
  std::vector<Candidate> aside = besides(start, rings.fine, *std::min_element(candidates.begin(), candidates.end(), isCheaper));
  std::move(aside.begin(), aside.end(), std::back_inserter(candidates));
  return merge(candidates);
}

}  // namespace oikos::recognition
