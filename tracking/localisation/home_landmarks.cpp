// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/home_landmarks.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "semantic/model/home_models.h"

namespace oikos::tracking {

registration::LandmarkScene makeLandmarks(const semantic::Home& home, const std::filesystem::path& home_folder) {
  registration::LandmarkScene landmarks;
  semantic::ModelMaker maker(home_folder);
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (object.movability == semantic::Movability::kFixed) {
        landmarks.add(object.id.value, maker.make(object), object.T_map_object.toIsometry(), semantic::jointValues(object));
      }
    }
  }
  return landmarks;
}

int getLandmark(const registration::LandmarkScene& landmarks, const semantic::Home& home, const std::string& id) {
  const auto found = std::find(landmarks.ids().begin(), landmarks.ids().end(), id);
  if (found != landmarks.ids().end()) {
    return static_cast<int>(found - landmarks.ids().begin());
  }
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (object.id.value == id) {
        throw base::Error(base::ErrorCode::kUsage,
                          "'" + id + "' is " + std::string(base::toString(object.movability)) + ": only fixed furniture can be a landmark",
                          "--object");
      }
    }
  }
  throw base::Error(base::ErrorCode::kUsage, "no furniture '" + id + "'" + base::didYouMean(id, landmarks.ids()), "--object");
}

}  // namespace oikos::tracking
