// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/observed_places.h"

#include <variant>

#include "core/base/error.h"
#include "semantic/model/detection.h"

namespace oikos::daemon {

semantic::Placement ObservedPlaces::get(const std::string& subject, const semantic::Pose& T_map_object, const std::string& where) const {
  const semantic::Thing* const thing = ids_.findById(subject);
  if (thing == nullptr || thing->kind != semantic::ThingKind::kSmallObject) {
    throw base::Error(base::ErrorCode::kInput,
                      "'" + subject.substr(0, 64) + "' is no small object of the home; only these are placed by it", where);
  }
  const auto placement =
      semantic::findPlacement(changed_ ? changed_->home() : home_->home, T_map_object.toIsometry(), thing->small_object->box_model);
  if (!placement) {
    throw base::Error(base::ErrorCode::kInput, "expected a pose in map that is at some furniture or in a room with an outline", where);
  }
  return *placement;
}

void ObservedPlaces::take(const semantic::Event& event) {
  const bool moves_carriers = event.after && (std::holds_alternative<semantic::FurniturePose>(*event.after) ||
                                              std::holds_alternative<semantic::JointValue>(*event.after));
  if (moves_carriers && event.kind != semantic::EventKind::kMissed) {
    if (!changed_) {
      changed_.emplace(home_->home);
    }
    changed_->set(event.subject, *event.after);
  }
}

}  // namespace oikos::daemon
