// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/detection.h"

#include <tuple>
#include <vector>

#include "semantic/model/outline.h"
#include "semantic/model/placement.h"
#include "semantic/model/relations.h"

namespace oikos::semantic {

namespace {

/// Furniture farther off than this carries nothing: no piece is larger.
constexpr double kReach_m = 5.0;

/// The best carrier among those that were offered.
class Choice {
 public:
  Choice(const Eigen::Isometry3d& T_map_object, const std::optional<Box>& box_object)
      : T_map_object_(T_map_object), box_object_(box_object) {}

  void offer(const LargeObject& object, const std::string& parent, const std::vector<Box>& boxes) {
    const auto T_map_parent = findCarrierInMap(object, parent);
    if (!T_map_parent) {
      return;
    }
    const Eigen::Isometry3d T_parent_object = T_map_parent->inverse() * T_map_object_;
    for (const Box& box : boxes) {
      if (const auto relation = findRelation(box, T_parent_object, box_object_)) {
        offer({rankOf(*relation), costOf(box, *relation, T_parent_object)}, {parent, *relation, Pose::fromIsometry(T_parent_object)});
      }
    }
  }

  [[nodiscard]] const std::optional<Placement>& best() const { return best_; }

 private:
  using Cost = std::tuple<int, double>;

  static int rankOf(Relation relation) { return relation == Relation::kIn ? 0 : relation == Relation::kOn ? 1 : 2; }

  [[nodiscard]] double costOf(const Box& box, Relation relation, const Eigen::Isometry3d& T_parent_object) const {
    const double middle_m = (T_parent_object * (box_object_ ? box_object_->center.position_m : Eigen::Vector3d::Zero())).z();
    const double foot_m = middle_m - (box_object_ ? box_object_->size_m.z() / 2.0 : 0.0);
    switch (relation) {
      case Relation::kIn:
        return box.size_m.prod();
      case Relation::kOn:
        return std::abs(foot_m - box.center.position_m.z() - box.size_m.z() / 2.0);
      case Relation::kUnder:
        break;
    }
    return box.center.position_m.z() - middle_m;
  }

  void offer(const Cost& cost, const Placement& carrier) {
    if (!best_ || cost < cost_) {
      cost_ = cost;
      best_ = carrier;
    }
  }

  const Eigen::Isometry3d& T_map_object_;
  const std::optional<Box>& box_object_;
  Cost cost_;
  std::optional<Placement> best_;
};

void offerAll(const LargeObject& object, Choice& choice) {
  choice.offer(object, object.id.value, object.boxes_object);
  if (object.articulation) {
    for (const Part& part : object.articulation->parts) {
      choice.offer(object, part.id.value, part.boxes_part);
    }
  }
}

}  // namespace

Eigen::Vector3d markerInMap(const Eigen::Isometry3d& T_map_camera, double depth_m) {
  return T_map_camera * Eigen::Vector3d(0.0, 0.0, depth_m);
}

std::optional<Placement> findPlacement(const Home& home, const Eigen::Isometry3d& T_map_object, const std::optional<Box>& box_object) {
  Choice choice(T_map_object, box_object);
  for (const Room& room : home.rooms) {
    for (const LargeObject& object : room.objects) {
      if ((object.T_map_object.position_m - T_map_object.translation()).head<2>().norm() <= kReach_m) {
        offerAll(object, choice);
      }
    }
  }
  if (choice.best()) {
    return choice.best();
  }
  for (const Room& room : home.rooms) {
    if (isInside(T_map_object.translation().head<2>(), room.outline_map)) {
      return Placement{room.id.value, Relation::kOn, Pose::fromIsometry(T_map_object)};
    }
  }
  return std::nullopt;
}

}  // namespace oikos::semantic
