// SPDX-License-Identifier: Apache-2.0
#include "bench/routes/route_table.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

namespace oikos::bench {

namespace {

constexpr double kMustAverage_m = 0.02;
constexpr double kAimAverage_m = 0.01;

/// Sums over the routes that were driven in one way.
struct Average {
  int routes = 0;
  int below_paper = 0;
  int frames = 0;
  int lost = 0;
  double ate_m = 0.0;
  double paper_ate_m = 0.0;
  double simulate_s = 0.0;
  double map_s = 0.0;

  void add(const RouteScore& score) {
    ++routes;
    below_paper += score.ate_m < score.route_case.route.paper_ate_m ? 1 : 0;
    frames += score.frames;
    lost += score.lost;
    ate_m += score.ate_m;
    paper_ate_m += score.route_case.route.paper_ate_m;
    simulate_s += score.frames / score.simulate_fps;
    map_s += score.frames / score.map_fps;
  }
};

const char* verdict(bool is_met) {
  return is_met ? "met" : "NOT MET";
}

void printAverage(const std::string& sensor, double belief_m, const Average& sum) {
  const double ate_m = sum.ate_m / sum.routes;
  std::printf("| average of %d | %s | %.0f | – | %d | %d | %.4f | %.4f | %.1f | %.1f |\n", sum.routes, sensor.c_str(), belief_m * 1e3,
              sum.frames, sum.lost, ate_m, sum.paper_ate_m / sum.routes, sum.frames / sum.simulate_s, sum.frames / sum.map_s);
}

void printVerdicts(const std::string& sensor, double belief_m, const Average& sum) {
  const double ate_m = sum.ate_m / sum.routes;
  std::printf("%s, belief %.0f mm: must: %d of %d routes below the paper's %s, average %.4f m <= %.2f %s; aim: <= %.2f %s\n",
              sensor.c_str(), belief_m * 1e3, sum.below_paper, sum.routes, verdict(sum.below_paper == sum.routes), ate_m, kMustAverage_m,
              verdict(ate_m <= kMustAverage_m), kAimAverage_m, verdict(ate_m <= kAimAverage_m));
}

}  // namespace

void printRouteHeader() {
  std::printf("\n| route | sensor | belief mm | path m | frames | lost | ATE RMSE m | paper 003 m | simulate frames/s | map frames/s |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
}

void printRoute(const RouteScore& score) {
  const RouteCase& route_case = score.route_case;
  std::printf("| %s | %s | %.0f | %.2f | %d | %d | %.4f | %.4f | %.1f | %.1f |\n", route_case.route.name.c_str(),
              std::string(base::toString(route_case.sensor)).c_str(), route_case.belief_m * 1e3, score.path_m, score.frames, score.lost,
              score.ate_m, route_case.route.paper_ate_m, score.simulate_fps, score.map_fps);
  std::fflush(stdout);
}

void printRouteBars(const std::vector<RouteScore>& scores) {
  std::map<std::pair<double, std::string>, Average> averages;
  for (const RouteScore& score : scores) {
    averages[{score.route_case.belief_m, std::string(base::toString(score.route_case.sensor))}].add(score);
  }
  for (const auto& [way, average] : averages) {
    printAverage(way.second, way.first, average);
  }
  std::printf("\n");
  for (const auto& [way, average] : averages) {
    printVerdicts(way.second, way.first, average);
  }
}

}  // namespace oikos::bench
