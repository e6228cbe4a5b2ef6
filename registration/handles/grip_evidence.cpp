// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/grip_evidence.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace oikos::registration {

std::optional<EvidencePeak> sumEvidence(const std::vector<const GripEvidence*>& images, double share, double place_sigma_m,
                                        double max_height_m) {
  std::vector<PlaceEvidence> sums;
  for (const GripEvidence* image : images) {
    sums = sums.empty() ? std::vector<PlaceEvidence>(image->places.size()) : std::move(sums);
    OIKOS_CHECK(image->places.size() == sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i].along_m = image->places[i].along_m;
      sums[i].across_m = image->places[i].across_m;
      sums[i].standing_out += share * image->places[i].standing_out;
      sums[i].seen += share * image->places[i].seen;
    }
  }
  if (sums.empty()) {
    return std::nullopt;
  }
  EvidencePeak peak;
  std::vector<double> scores;
  for (const PlaceEvidence& place : sums) {
    const double height_m = place.seen > 0.0 ? std::clamp(place.standing_out / place.seen, 0.0, max_height_m) : 0.0;
    const double gain = height_m * (place.standing_out - 0.5 * height_m * place.seen);
    peak.gain = std::max(peak.gain, gain);
    scores.push_back(gain - 0.5 * (place.along_m * place.along_m + place.across_m * place.across_m) / (place_sigma_m * place_sigma_m));
  }
  const double best = *std::max_element(scores.begin(), scores.end());
  double whole = 0.0;
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double probability = std::exp(scores[i] - best);
    const Eigen::Vector2d at(sums[i].across_m, sums[i].along_m);
    whole += probability;
    peak.place_m += probability * at;
    squares += probability * at * at.transpose();
  }
  peak.place_m /= whole;
  peak.covariance = squares / whole - peak.place_m * peak.place_m.transpose();
  return peak;
}

}  // namespace oikos::registration
