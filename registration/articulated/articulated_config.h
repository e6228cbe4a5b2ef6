// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "registration/articulated/joint_decision.h"
#include "registration/articulated/joint_solver.h"
#include "registration/articulated/pixel_mixture.h"

namespace oikos::registration {

enum class SolveOrder {
  kPartAfterPart,  ///< the base, then each joint down the tree (S228, S229, S235)
  kTogether,       ///< and then all of them at once
};
constexpr auto enumTable(SolveOrder) {
  return std::to_array<base::EnumName<SolveOrder>>({{SolveOrder::kPartAfterPart, "part after part"}, {SolveOrder::kTogether, "together"}});
}

struct ArticulatedConfig {
  MixtureConfig mixture;
  JointSolverConfig solver;
  JointDecisionConfig decision;
  SolveOrder order = SolveOrder::kTogether;
  double stride_m = 0.03;        ///< how far the outermost point of a part moves from one value to the next that is looked at
  int coarse_thinning = 2;       ///< these are compared in one scan point of so many rows and columns
  double coarse_sigma_m = 0.02;  ///< of surfaces before the base is registered,
  double fine_sigma_m = 0.010;   ///< and after it
  double profile_tempering = 0.1;
  int most_rivals = 3;          ///< local maxima of a joint's profile that are solved for, if they come near the best one,
  double rival_share = 0.5;     ///< which is to say, within this share of its log likelihood
  int min_base_pixels = 20;     ///< of the scan: fewer readings do not tell where the base is, nor that it is not there
  double min_base_share = 0.3;  ///< of the readings of the base and behind it, those of it
  double max_unseen_off =
      3.0;                   ///< deviations that a base of which nothing is seen, and the joint on it, may be from where they are believed
  double unlimited_m = 1.0;  ///< to both sides of the believed value, for a slide without limits
  int threads = 1;           ///< of the renderer

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("mixture", mixture);
    visitor("solver", solver);
    visitor("decision", decision);
    visitor("order", order);
    visitor("stride_m", stride_m);
    visitor("coarse_thinning", coarse_thinning);
    visitor("coarse_sigma_m", coarse_sigma_m);
    visitor("fine_sigma_m", fine_sigma_m);
    visitor("profile_tempering", profile_tempering);
    visitor("most_rivals", most_rivals);
    visitor("rival_share", rival_share);
    visitor("min_base_pixels", min_base_pixels);
    visitor("min_base_share", min_base_share);
    visitor("max_unseen_off", max_unseen_off);
    visitor("unlimited_m", unlimited_m);
    visitor("threads", threads);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace oikos::registration
