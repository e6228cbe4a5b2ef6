// SPDX-License-Identifier: Apache-2.0
// How many boxes that were added to a room, removed or moved are found against its map, how many found ones are true, and what is found
// where nothing changed: random rooms before a simulated Kinect whose pose is off.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "bench/change/changed_room.h"

namespace {

using namespace oikos;
using mapping::Change;
using mapping::ChangeKind;

struct Options {
  int rooms = 20;
  int changed_pairs = 3;  ///< of each room, beside an unchanged one
  int events = 4;
  double pose_cm = 2.0;
  double pose_deg = 1.0;
  int threads = 2;
  std::uint64_t seed = 1;
  bool verbose = false;
};

/// Wilson's interval at 95 %, in per cent.
std::array<double, 2> interval(int successes, int n) {
  const double z = 1.96;
  const double p = static_cast<double>(successes) / n;
  const double middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {100.0 * (middle - half), 100.0 * (middle + half)};
}

struct Count {
  int good = 0;
  int all = 0;
  void add(bool is_good) {
    good += is_good ? 1 : 0;
    ++all;
  }
  void print(const char* name) const {
    if (all > 0) {
      const auto [low, high] = interval(good, all);
      std::printf("| %-14s | %4d of %4d | %5.1f %% (%.1f-%.1f) |\n", name, good, all, 100.0 * good / all, low, high);
    }
  }
};

struct Score {
  std::array<Count, 3> recall;  ///< by EventKind
  Count known;                  ///< recall without new pieces at places that the map knows to be free to less than half
  Count precision;
  std::vector<double> center_error_m;
  std::vector<double> size_error_m;  ///< of the worst side
  Count support_stated;
  Count support_true;  ///< of those stated: within 5 cm of the floor
  int unchanged_pairs = 0;
  int false_boxes = 0;  ///< in them
  int scans = 0;
  int scans_refused = 0;
  std::vector<double> ms;  ///< of a pair
};

bench::BoxM boxOf(const Change& change) {
  return {Eigen::Vector3d(change.center_map - 0.5 * change.size_m), Eigen::Vector3d(change.center_map + 0.5 * change.size_m)};
}

/// Reported where it is; it may be seen from one side only.
bool isPartOf(const Change& change, const bench::BoxM& truth) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.1);
  return bench::BoxM(truth.min() - margin, truth.max() + margin).contains(boxOf(change));
}

bool isFound(const bench::BoxM& truth, ChangeKind kind, const std::vector<Change>& changes, Score& score) {
  const Change* best = nullptr;
  for (const Change& change : changes) {
    const bool is_larger = best == nullptr || change.voxels.size() > best->voxels.size();
    if (change.kind == kind && isPartOf(change, truth) && is_larger) {
      best = &change;
    }
  }
  if (best == nullptr || best->size_m.norm() < 0.5 * truth.diagonal().norm()) {
    return false;
  }
  score.center_error_m.push_back((best->center_map - truth.center()).norm());
  score.size_error_m.push_back((best->size_m - truth.sizes()).cwiseAbs().maxCoeff());
  score.support_stated.add(best->support_height_m.has_value());
  if (best->support_height_m) {
    score.support_true.add(std::abs(*best->support_height_m) <= 0.05);
  }
  return true;
}

/// Of a grid of points in the box: what the map knows to be free.
double freeShare(const bench::BoxM& box, const mapping::SeenSpace& map) {
  constexpr int kSide = 12;
  Count free;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Eigen::Vector3d share = (Eigen::Vector3d(i % kSide, i / kSide % kSide, i / (kSide * kSide)).array() + 0.5) / kSide;
    const Eigen::Vector3d point_map = box.min() + share.cwiseProduct(box.sizes());
    const auto key = map.lattice().findKey(point_map.cast<float>());
    free.add(key && map.state(*key) == mapping::SpaceState::kFree);
  }
  return static_cast<double>(free.good) / free.all;
}

void judgeChanged(const bench::ChangedRoom& changed, const mapping::SeenSpace& map, const std::vector<Change>& changes,
                  const Options& options, Score& score) {
  for (const bench::RoomEvent& event : changed.events) {
    const bool is_gone_found = event.kind == bench::EventKind::kAdded || isFound(event.before, ChangeKind::kGone, changes, score);
    const bool is_new_found = event.kind == bench::EventKind::kRemoved || isFound(event.after, ChangeKind::kNew, changes, score);
    score.recall[static_cast<std::size_t>(event.kind)].add(is_gone_found && is_new_found);
    if (event.kind == bench::EventKind::kRemoved || freeShare(event.after, map) >= 0.5) {
      score.known.add(is_gone_found && is_new_found);
    }
    if (options.verbose && !(is_gone_found && is_new_found)) {
      const bench::BoxM& missed = is_gone_found ? event.after : event.before;
      std::printf("  missed %s at %.2f %.2f, %.2f x %.2f x %.2f, %.0f %% free in the map\n", is_gone_found ? "new" : "gone",
                  missed.center().x(), missed.center().y(), missed.sizes().x(), missed.sizes().y(), missed.sizes().z(),
                  100.0 * freeShare(missed, map));
    }
  }
  for (const Change& change : changes) {
    const bool is_true = std::any_of(changed.events.begin(), changed.events.end(), [&](const bench::RoomEvent& event) {
      const bench::BoxM& truth = change.kind == ChangeKind::kNew ? event.after : event.before;
      return !truth.isEmpty() && isPartOf(change, truth);
    });
    score.precision.add(is_true);
    if (options.verbose && !is_true) {
      const Eigen::Vector3d& c = change.center_map;
      std::printf("  false %s at %.2f %.2f %.2f, %.2f x %.2f x %.2f, %zu voxels\n", std::string(base::toString(change.kind)).c_str(), c.x(),
                  c.y(), c.z(), change.size_m.x(), change.size_m.y(), change.size_m.z(), change.voxels.size());
    }
  }
}

mapping::ChangeResult compare(const mapping::SeenSpace& map, const std::vector<mapping::LocatedScan>& scans, const Options& options,
                              Score& score) {
  mapping::ChangeConfig config;
  config.threads = options.threads;
  const auto begin = std::chrono::steady_clock::now();
  mapping::ChangeResult result = mapping::findChanges(map, scans, config);
  score.ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  score.scans += static_cast<int>(scans.size());
  score.scans_refused += static_cast<int>(std::count_if(
      result.scans.begin(), result.scans.end(), [](mapping::ChangeStatus status) { return status != mapping::ChangeStatus::kCompared; }));
  return result;
}

void runRoom(int number, const Options& options, Score& score) {
  std::mt19937_64 random(options.seed * 1'000'003 + static_cast<std::uint64_t>(number));
  const bench::Room room = bench::randomRoom(6, random);
  mapping::SeenSpace map({}, {}, options.threads);
  for (const mapping::LocatedScan& scan : bench::drive(room, {36, 48}, {0.005, 0.2 * std::numbers::pi / 180.0}, random)) {
    camera::RgbdFrame frame;
    frame.depth_m = scan.depth_m;
    map.insert({frame, scan.camera, scan.T_map_camera});
  }
  const bench::PoseNoise noise{options.pose_cm / 100.0, options.pose_deg * std::numbers::pi / 180.0};
  const bench::DriveSize live{12, 8};
  const mapping::ChangeResult unchanged = compare(map, bench::drive(room, live, noise, random), options, score);
  ++score.unchanged_pairs;
  score.false_boxes += static_cast<int>(unchanged.changes.size());
  for (int pair = 0; pair < options.changed_pairs; ++pair) {
    const bench::ChangedRoom changed = bench::changeRoom(room, options.events, random);
    judgeChanged(changed, map, compare(map, bench::drive(changed.room, live, noise, random), options, score).changes, options, score);
  }
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return std::nan("");
  }
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void report(const Score& score) {
  std::printf("| | n | share (95 %%) |\n|---|---|---|\n");
  constexpr std::array<const char*, 3> kNames = {"added", "removed", "moved"};
  Count all;
  for (std::size_t kind = 0; kind < kNames.size(); ++kind) {
    score.recall[kind].print(kNames[kind]);
    all.good += score.recall[kind].good;
    all.all += score.recall[kind].all;
  }
  all.print("recall");
  score.known.print("of known");
  score.precision.print("precision");
  score.support_stated.print("support stated");
  score.support_true.print("support right");
  std::printf("unchanged pairs: %d, false boxes %d: %.2f a pair\n", score.unchanged_pairs, score.false_boxes,
              static_cast<double>(score.false_boxes) / score.unchanged_pairs);
  std::printf("centre off by %.1f cm (p95 %.1f), worst side by %.1f cm (p95 %.1f)\n", 100.0 * quantile(score.center_error_m, 0.5),
              100.0 * quantile(score.center_error_m, 0.95), 100.0 * quantile(score.size_error_m, 0.5),
              100.0 * quantile(score.size_error_m, 0.95));
  std::printf("scans refused: %d of %d; a pair takes %.0f ms (median)\n", score.scans_refused, score.scans, quantile(score.ms, 0.5));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Added, removed and moved boxes against the map");
  app.add_option("--rooms", options.rooms);
  app.add_option("--changed-pairs", options.changed_pairs, "of each room");
  app.add_option("--events", options.events, "of each changed pair, at most 6");
  app.add_option("--pose-cm", options.pose_cm, "error of a scan's position, root mean square");
  app.add_option("--pose-deg", options.pose_deg, "error of a scan's rotation, root mean square");
  app.add_option("--threads", options.threads);
  app.add_option("--seed", options.seed);
  app.add_flag("--verbose", options.verbose);
  CLI11_PARSE(app, argc, argv);
  Score score;
  for (int room = 0; room < options.rooms; ++room) {
    runRoom(room, options, score);
    if (options.verbose) {
      std::printf("room %d: false boxes so far %d\n", room, score.false_boxes);
      std::fflush(stdout);
    }
  }
  report(score);
  return 0;
}
