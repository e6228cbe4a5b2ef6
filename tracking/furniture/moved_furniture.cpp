// SPDX-License-Identifier: Apache-2.0
#include "tracking/furniture/moved_furniture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/geometry/se3.h"
#include "core/model/triangle_mesh.h"
#include "semantic/model/home_models.h"
#include "tracking/furniture/changed_pieces.h"

namespace oikos::tracking {

namespace {

using mapping::Change;
using mapping::ChangeKind;
using mapping::LocatedScan;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

double yawBetween_rad(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

double distance_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

/// A piece with its model.
struct Piece {
  const semantic::LargeObject& object;
  model::ArticulatedModel model;
  std::vector<double> joint_values;
  Eigen::AlignedBox3d box_model;
  Eigen::Isometry3d T_map_believed;
};

bool isInPicture(const LocatedScan& scan, const Eigen::Vector3d& point_map) {
  const Eigen::Vector3d point_camera = scan.T_map_camera.inverse() * point_map;
  return point_camera.z() > 0.3 && scan.camera.contains(scan.camera.project(point_camera));
}

/// Scans that look at the piece there, the most useful first, from directions apart.
std::vector<const LocatedScan*> viewsOf(const Eigen::Vector3d& middle_map, const std::vector<LocatedScan>& scans,
                                        const MovedFurnitureConfig& config) {
  std::vector<std::pair<double, const LocatedScan*>> in_view;
  for (const LocatedScan& scan : scans) {
    const double away_m = (scan.T_map_camera.translation() - middle_map).norm();
    if (away_m <= config.max_distance_m && isInPicture(scan, middle_map)) {
      in_view.emplace_back(std::abs(away_m - config.best_distance_m), &scan);
    }
  }
  std::stable_sort(in_view.begin(), in_view.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const LocatedScan*> chosen;
  const auto bearing = [&](const LocatedScan& scan) {
    return Eigen::Vector3d((scan.T_map_camera.translation() - middle_map).normalized());
  };
  const double max_cosine = std::cos(config.view_apart_deg * kRadPerDeg);
  for (const auto& [rank, scan] : in_view) {
    const bool is_apart = std::all_of(chosen.begin(), chosen.end(), [&, view = scan](const LocatedScan* other) {
      return bearing(*view).dot(bearing(*other)) < max_cosine;
    });
    if (is_apart && static_cast<int>(chosen.size()) < config.views) {
      chosen.push_back(scan);
    }
  }
  return chosen;
}

/// Where one view has the piece.
struct Answer {
  Eigen::Isometry3d T_map_piece = Eigen::Isometry3d::Identity();
  double fit = 0.0;
};

std::optional<Answer> ask(const Piece& piece, const Eigen::Isometry3d& T_map_start, const LocatedScan& view,
                          const MovedFurnitureConfig& config) {
  render::Scene scene;
  const int number = scene.add(piece.model, T_map_start, piece.joint_values);
  scene.commit();
  registration::ModelMotion motion(scene, number, piece.model, view.T_map_camera, {T_map_start, piece.joint_values}, {});
  registration::SearchConfig search = config.search;
  search.align.threads = 1;
  const registration::AlignResult result =
      registration::searchPose(motion, registration::makeScan(view.depth_m, view.camera, config.scan), search);
  if (result.status != registration::AlignStatus::kConverged || result.fit < config.min_fit) {
    return std::nullopt;
  }
  return Answer{motion.pose().T_map_model, result.fit};
}

bool agrees(const Answer& a, const Answer& b, const MovedFurnitureConfig& config) {
  return distance_m(a.T_map_piece, b.T_map_piece) <= config.agree_m &&
         yawBetween_rad(a.T_map_piece, b.T_map_piece) <= config.agree_deg * kRadPerDeg;
}

/// The answers that most others agree with; the first of equals.
std::vector<Answer> largestAgreement(const std::vector<Answer>& answers, const MovedFurnitureConfig& config) {
  std::vector<Answer> largest;
  for (const Answer& one : answers) {
    std::vector<Answer> agreeing;
    std::copy_if(answers.begin(), answers.end(), std::back_inserter(agreeing),
                 [&](const Answer& other) { return agrees(one, other, config); });
    if (agreeing.size() > largest.size()) {
      largest = std::move(agreeing);
    }
  }
  return largest;
}

/// The mean of poses that are near to each other, and differ in place and yaw only.
Eigen::Isometry3d meanOf(const std::vector<Answer>& answers) {
  const Eigen::Isometry3d& first = answers.front().T_map_piece;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (const Answer& answer : answers) {
    position += answer.T_map_piece.translation() / static_cast<double>(answers.size());
    turn += geometry::logSo3(answer.T_map_piece.linear() * first.linear().transpose()) / static_cast<double>(answers.size());
  }
  Eigen::Isometry3d mean = Eigen::Isometry3d::Identity();
  mean.linear() = geometry::expSo3(turn) * first.linear();
  mean.translation() = position;
  return mean;
}

MovedPiece summarise(const Piece& piece, const std::vector<Answer>& answers) {
  MovedPiece moved{piece.object.id, piece.T_map_believed, meanOf(answers), static_cast<int>(answers.size()), 0.0, 1.0};
  for (const Answer& answer : answers) {
    moved.spread_m += std::pow(distance_m(answer.T_map_piece, moved.T_map_after), 2) / static_cast<double>(answers.size());
    moved.fit = std::min(moved.fit, answer.fit);
  }
  moved.spread_m = std::sqrt(moved.spread_m);
  return moved;
}

/// Where the piece may stand: where it is believed to, and in the place of something new that is about as high, turned by quarters.
std::vector<Eigen::Isometry3d> startsOf(const Piece& piece, const std::vector<Change>& changes) {
  constexpr double kHeightOff_m = 0.25;
  std::vector<Eigen::Isometry3d> starts = {piece.T_map_believed};
  const double top_m = (piece.T_map_believed * piece.box_model.max()).z();
  for (const Change& change : changes) {
    const double change_top_m = change.center_map.z() + 0.5 * change.size_m.z();
    if (change.kind != ChangeKind::kNew || std::abs(change_top_m - top_m) > kHeightOff_m) {
      continue;
    }
    for (int quarter = 0; quarter < 4; ++quarter) {
      Eigen::Isometry3d start = piece.T_map_believed;
      start.prerotate(Eigen::AngleAxisd(0.5 * std::numbers::pi * quarter, Eigen::Vector3d::UnitZ()));
      const Eigen::Vector3d middle = start * piece.box_model.center();
      start.pretranslate(Eigen::Vector3d(change.center_map.x() - middle.x(), change.center_map.y() - middle.y(),
                                         piece.T_map_believed.translation().z() - start.translation().z()));
      starts.push_back(start);
    }
  }
  return starts;
}

bool isBelieved(const std::vector<Answer>& answers, const MovedFurnitureConfig& config) {
  return answers.size() >= 2 || (answers.size() == 1 && answers.front().fit >= config.lone_fit);
}

/// What most of the views agree on that have a place near the start in sight.
std::vector<Answer> locateFrom(const Piece& piece, const Eigen::Isometry3d& T_map_start, const std::vector<LocatedScan>& scans,
                               const MovedFurnitureConfig& config) {
  const std::vector<const LocatedScan*> views = viewsOf(T_map_start * piece.box_model.center(), scans, config);
  std::vector<std::optional<Answer>> asked(views.size());
  base::parallelFor(static_cast<int>(views.size()), config.threads, [&](int i) {
    const auto v = static_cast<std::size_t>(i);
    asked[v] = ask(piece, T_map_start, *views[v], config);
  });
  std::vector<Answer> answers;
  for (const std::optional<Answer>& answer : asked) {
    if (answer) {
      answers.push_back(*answer);
    }
  }
  return largestAgreement(answers, config);
}

/// How much the views explain altogether.
double weightOf(const std::vector<Answer>& answers) {
  return std::accumulate(answers.begin(), answers.end(), 0.0, [](double sum, const Answer& answer) { return sum + answer.fit; });
}

/// Near where it is believed if it is there, else where the views explain most of it: turned by a quarter a table half fits, too.
std::vector<Answer> locate(const Piece& piece, const std::vector<LocatedScan>& scans, const std::vector<Change>& changes,
                           const MovedFurnitureConfig& config) {
  const std::vector<Eigen::Isometry3d> starts = startsOf(piece, changes);
  std::vector<Answer> best = locateFrom(piece, starts.front(), scans, config);
  if (isBelieved(best, config)) {
    return best;
  }
  best.clear();
  for (std::size_t s = 1; s < starts.size(); ++s) {
    std::vector<Answer> answers = locateFrom(piece, starts[s], scans, config);
    if (weightOf(answers) > weightOf(best)) {
      best = std::move(answers);
    }
  }
  return best;
}

}  // namespace

std::vector<std::string> MovedFurnitureConfig::validate() const {
  base::ConfigRules rules;
  rules.atLeast("views", views, 1).atLeast("view_apart_deg", view_apart_deg, 0.0).greater("best_distance_m", best_distance_m, 0.0);
  rules.greater("max_distance_m", max_distance_m, 0.0).between("min_fit", min_fit, 0.0, 1.0).between("lone_fit", lone_fit, 0.0, 1.0);
  rules.atLeast("agree_m", agree_m, 0.0).atLeast("agree_deg", agree_deg, 0.0);
  rules.atLeast("min_moved_m", min_moved_m, 0.0).atLeast("min_moved_deg", min_moved_deg, 0.0).atLeast("threads", threads, 1);
  return rules.messages();
}

std::vector<MovedPiece> findMovedFurniture(const semantic::Home& home, const std::filesystem::path& home_folder,
                                           const std::vector<LocatedScan>& scans, const std::vector<Change>& changes,
                                           const MovedFurnitureConfig& config) {
  OIKOS_CHECK(config.validate().empty());
  std::vector<MovedPiece> moved;
  semantic::ModelMaker maker(home_folder);
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (object.movability != semantic::Movability::kShiftable) {
        continue;
      }
      Piece piece{object, maker.make(object), semantic::jointValues(object), {}, object.T_map_object.toIsometry()};
      piece.box_model = boxOf(piece.model, {piece.joint_values});
      const std::vector<Answer> answers = locate(piece, scans, changes, config);
      if (!isBelieved(answers, config)) {
        continue;
      }
      const MovedPiece found = summarise(piece, answers);
      if (distance_m(found.T_map_before, found.T_map_after) >= config.min_moved_m ||
          yawBetween_rad(found.T_map_before, found.T_map_after) >= config.min_moved_deg * kRadPerDeg) {
        moved.push_back(found);
      }
    }
  }
  return moved;
}

}  // namespace oikos::tracking
