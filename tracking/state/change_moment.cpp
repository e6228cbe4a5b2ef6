// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/change_moment.h"

#include "core/base/error.h"
#include "registration/articulated/joint_moment.h"

namespace oikos::tracking {

ChangeMoment momentOf(const JointChange& change, const JointReading& reading, const registration::JointFusionConfig& config) {
  OIKOS_CHECK(change.stay < reading.stays.size() && reading.frames.size() == reading.sightings.size());
  const JointStay& stay = reading.stays[change.stay];
  const JointStay* const stay_before = change.stay_before ? &reading.stays[*change.stay_before] : nullptr;
  const std::size_t first = stay_before != nullptr ? stay_before->span.first : 0;
  OIKOS_CHECK(first <= stay.span.last && stay.span.last < reading.sightings.size());
  const auto begin = reading.sightings.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = reading.sightings.begin() + static_cast<std::ptrdiff_t>(stay.span.last) + 1;
  const registration::JointStep step{stay_before != nullptr ? stay_before->span.value : change.before, stay.span.value};
  const auto moment = registration::findMoment({begin, end}, step, config);
  if (!moment) {
    return {{stay.first_ns, stay.first_frame}, std::nullopt};
  }
  const auto timeOf = [&](std::size_t i) { return ImageTime{reading.sightings[first + i].stamp_ns, reading.frames[first + i]}; };
  return {timeOf(moment->first_after), moment->last_before ? std::optional(timeOf(*moment->last_before)) : std::nullopt};
}

}  // namespace oikos::tracking
