// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string_view>
#include <vector>

#include "semantic/xml/home_nodes.h"

namespace oikos::semantic {

/// What becomes of one element's children.
struct ChildrenPlan {
  static constexpr std::size_t kBeforeFirst = static_cast<std::size_t>(-1);

  std::vector<const XmlNode*> before;                        ///< of each child in the file: what it is
  std::vector<const XmlNode*> after;                         ///< what it becomes; null: it goes
  std::map<std::size_t, std::vector<const XmlNode*>> added;  ///< behind which child (kBeforeFirst: before the first) what comes in
};

/// `names`: of the children in the file, which are those of `before`. What stays in order stays in its place. The nodes must outlive the
/// plan.
[[nodiscard]] ChildrenPlan planChildren(const std::vector<std::string_view>& names, const XmlNode& before, const XmlNode& after);

}  // namespace oikos::semantic
