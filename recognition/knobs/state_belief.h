// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/model/articulated_model.h"

namespace oikos::recognition {

/// What a picture says about an angle: a density over a whole turn, one value a degree, their sum 1.
struct AngleBelief {
  std::vector<double> density;
  double angle_rad = 0.0;  ///< the likeliest, in [0, 2 pi)
  double sigma_rad = 0.0;  ///< root of the mean square distance from it, on the circle
};

/// Where the templates were turned to, and how much a picture counts.
struct BeliefRule {
  double zero_rad = 0.0;   ///< the angle of the knob that template 0 shows
  double turn_sign = 1.0;  ///< 1: the angle grows with the template's number
  double evidence = 50.0;  ///< independent pixels
};

/// Residuals that are normal with an unknown deviation have the likelihood (sum of squares)^(-n/2); between templates its logarithm is
/// interpolated.
[[nodiscard]] AngleBelief believeAngle(const std::vector<double>& unexplained, const BeliefRule& rule);

struct StateRule {
  double detent_sigma_rad = 0.05;  ///< how far a knob rests from the angle of its state
  double between_share = 0.02;     ///< prior probability that it is in none
};

/// One probability a state; what is missing to 1 is "in none of them".
[[nodiscard]] std::vector<double> believeStates(const AngleBelief& belief, const std::vector<model::ModelKnobState>& states,
                                                const StateRule& rule);

}  // namespace oikos::recognition
