// SPDX-License-Identifier: Apache-2.0
// What a recording shows that the map does not, or no longer, and that nothing else said of the recording explains.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mapping/change/change_finder.h"
#include "registration/scan.h"
#include "semantic/model/home.h"
#include "tracking/objects/believed_scene.h"
#include "tracking/objects/missed_test.h"

namespace oikos::tracking {

/// A frame that is held against the map.
struct ChangeView {
  int frame = 0;  ///< of the recording
  std::int64_t stamp_ns = 0;
  mapping::LocatedScan scan;  ///< of any size
};

/// A change with a picture of it.
struct ChangeBox {
  mapping::Change change;
  std::string piece;            ///< of the home that it is of; empty: of none that the home knows
  int frame = 0;                ///< that shows most of it,
  registration::PixelBox crop;  ///< and where it is in that, in pixels of the recording's camera
};

/// What the recording has said of the home already.
struct ExplainedBy {
  const semantic::Home& home;
  std::filesystem::path home_folder;
  CarrierReadings carriers;  ///< joints, and furniture that was found, moved or not
  const std::vector<ObjectReading>& objects;
};

/// findChanges() without what is explained: new surfaces where the home, with the joints and the furniture that were found, has a surface
/// itself; and surfaces that are gone within the reach of doors and drawers that were read, where furniture stood that was found elsewhere,
/// and where a small object was missed. What is gone of a movable piece (a chair) is named after it; where it went, its box is new and
/// has no name. Throws as findChanges() and BelievedScene.
[[nodiscard]] std::vector<ChangeBox> findChangeBoxes(const mapping::SeenSpace& map, const std::vector<ChangeView>& views,
                                                     const ExplainedBy& by, const camera::PinholeCamera& camera,
                                                     const mapping::ChangeConfig& config);

}  // namespace oikos::tracking
