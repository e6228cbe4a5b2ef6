// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "core/base/enum_table.h"

namespace oikos::model {

/// What a hand takes hold of: a bar or lever, a knob, or a grip that does not stand out of its front.
enum class HandleKind { kBar, kKnob, kRecessed };
constexpr auto enumTable(HandleKind) {
  return std::to_array<base::EnumName<HandleKind>>(
      {{HandleKind::kBar, "bar"}, {HandleKind::kKnob, "knob"}, {HandleKind::kRecessed, "recessed"}});
}

}  // namespace oikos::model
