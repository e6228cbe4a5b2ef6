// SPDX-License-Identifier: Apache-2.0
// The choices that several kinds of furniture share.
#pragma once

#include <array>

#include "core/base/enum_table.h"

namespace oikos::model {

/// The edge that a front turns about. Left and right are those of a person who stands before it.
enum class HingeEdge { kLeft, kRight, kTop, kBottom };
constexpr auto enumTable(HingeEdge) {
  return std::to_array<base::EnumName<HingeEdge>>(
      {{HingeEdge::kLeft, "left"}, {HingeEdge::kRight, "right"}, {HingeEdge::kTop, "top"}, {HingeEdge::kBottom, "bottom"}});
}

/// `kRecessed` is a dark grip strip that does not stand out; `kNone` has nothing to take hold of.
enum class HandleStyle { kNone, kBarVertical, kBarHorizontal, kKnob, kRecessed };
constexpr auto enumTable(HandleStyle) {
  return std::to_array<base::EnumName<HandleStyle>>({{HandleStyle::kNone, "none"},
                                                     {HandleStyle::kBarVertical, "bar_vertical"},
                                                     {HandleStyle::kBarHorizontal, "bar_horizontal"},
                                                     {HandleStyle::kKnob, "knob"},
                                                     {HandleStyle::kRecessed, "recessed"}});
}

}  // namespace oikos::model
