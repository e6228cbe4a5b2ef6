// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_values.h"

#include <algorithm>
#include <cmath>

namespace oikos::registration {

std::vector<double> valuesToLookAt(const model::ModelJoint& joint, double believed, double unlimited, double stride) {
  constexpr double kFewestSteps = 4.0;
  const double lower = std::isfinite(joint.lower) ? joint.lower : std::min(believed, joint.upper) - unlimited;
  const double upper = std::isfinite(joint.upper) ? joint.upper : std::max(believed, joint.lower) + unlimited;
  const auto steps = static_cast<int>(std::max(kFewestSteps, std::ceil((upper - lower) / stride)));
  std::vector<double> values;
  for (int i = 0; i <= steps; ++i) {
    values.push_back(lower + (upper - lower) * i / steps);
  }
  return values;
}

std::vector<double> localMaxima(const JointEvidence& evidence, double share, int most) {
  const std::vector<double>& score = evidence.log_likelihood;
  const double best = *std::max_element(score.begin(), score.end());
  std::vector<std::size_t> peaks;
  for (std::size_t i = 0; i < score.size(); ++i) {
    const bool is_peak = (i == 0 || score[i] > score[i - 1]) && (i + 1 == score.size() || score[i] >= score[i + 1]);
    if (is_peak && score[i] > std::max(0.0, (1.0 - share) * best)) {
      peaks.push_back(i);
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(), [&](std::size_t a, std::size_t b) { return score[a] > score[b]; });
  peaks.resize(std::min(peaks.size(), static_cast<std::size_t>(most)));
  std::vector<double> values;
  values.reserve(peaks.size());
  for (const std::size_t peak : peaks) {
    values.push_back(evidence.values[peak]);
  }
  return values;
}

}  // namespace oikos::registration
