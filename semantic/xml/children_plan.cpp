// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/children_plan.h"

#include <algorithm>
#include <unordered_map>

#include "core/base/error.h"

namespace oikos::semantic {

namespace {

constexpr std::size_t kNone = ChildrenPlan::kBeforeFirst;  // also: no such element

/// The numbers of a longest strictly increasing subsequence; kNone is never in it.
std::vector<bool> longestIncreasing(const std::vector<std::size_t>& values) {
  std::vector<std::size_t> last_of_length;  // the position whose value ends the increasing run of this length at the least
  std::vector<std::size_t> previous(values.size(), kNone);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == kNone) {
      continue;
    }
    const auto slot = std::lower_bound(last_of_length.begin(), last_of_length.end(), values[i],
                                       [&](std::size_t position, std::size_t value) { return values[position] < value; });
    previous[i] = slot == last_of_length.begin() ? kNone : *(slot - 1);
    if (slot == last_of_length.end()) {
      last_of_length.push_back(i);
    } else {
      *slot = i;
    }
  }
  std::vector<bool> chosen(values.size(), false);
  for (std::size_t i = last_of_length.empty() ? kNone : last_of_length.back(); i != kNone; i = previous[i]) {
    chosen[i] = true;
  }
  return chosen;
}

/// Elements that form one list share a name here: furniture stands in one order, whether it is articulated or not.
std::string_view listOf(std::string_view element) {
  return element == "largeArticulatedObject" ? "largeObject" : element;
}

/// Each list's name once, in the order that the schema may ask for.
std::vector<std::string_view> listsOf(const XmlNode& before, const XmlNode& after) {
  std::vector<std::string_view> lists;
  for (const XmlNode* parent : {&after, &before}) {
    for (const XmlNode& child : parent->children) {
      if (std::find(lists.begin(), lists.end(), listOf(child.name)) == lists.end()) {
        lists.push_back(listOf(child.name));
      }
    }
  }
  return lists;
}

/// One list among the children of an element.
struct ListInFile {
  std::string_view name;
  std::size_t rank;
  const std::vector<std::size_t>& rank_of_child;
};

struct ListPlaces {
  std::vector<std::size_t> places;                  ///< of its elements among the children
  std::size_t behind = ChildrenPlan::kBeforeFirst;  ///< which child a new first element comes; without any: what the schema has before
};

ListPlaces placesOf(const ListInFile& children) {
  ListPlaces list;
  for (std::size_t i = 0; i < children.rank_of_child.size(); ++i) {
    if (children.rank_of_child[i] == children.rank) {
      list.places.push_back(i);
    }
    if (children.rank_of_child[i] < children.rank) {
      list.behind = i;
    }
  }
  if (!list.places.empty()) {
    list.behind = list.places.front() == 0 ? ChildrenPlan::kBeforeFirst : list.places.front() - 1;
  }
  return list;
}

std::vector<const XmlNode*> named(const XmlNode& node, std::string_view name) {
  std::vector<const XmlNode*> children;
  for (const XmlNode& child : node.children) {
    if (listOf(child.name) == name) {
      children.push_back(&child);
    }
  }
  return children;
}

/// Which of the new ones is which of the old ones: by id, those without by position.
std::vector<std::size_t> oldOnes(const std::vector<const XmlNode*>& before, const std::vector<const XmlNode*>& after) {
  std::unordered_map<std::string_view, std::size_t> old_of_id;
  for (std::size_t i = 0; i < before.size(); ++i) {
    old_of_id.emplace(before[i]->id, i);
  }
  std::vector<std::size_t> old(after.size(), kNone);
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i]->id.empty()) {
      old[i] = i < before.size() ? i : kNone;
    } else if (const auto found = old_of_id.find(after[i]->id); found != old_of_id.end()) {
      old[i] = found->second;
    }
  }
  return old;
}

void planList(const ListInFile& children, const XmlNode& before, const XmlNode& after, ChildrenPlan& plan) {
  const std::vector<const XmlNode*> old = named(before, children.name);
  const std::vector<const XmlNode*> wanted = named(after, children.name);
  const ListPlaces list = placesOf(children);
  const std::vector<std::size_t>& places = list.places;
  OIKOS_CHECK(places.size() == old.size());
  for (std::size_t i = 0; i < old.size(); ++i) {
    plan.before[places[i]] = old[i];
  }
  const std::vector<std::size_t> old_of_wanted = oldOnes(old, wanted);
  const std::vector<bool> stays = longestIncreasing(old_of_wanted);
  std::size_t behind = list.behind;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (stays[i]) {
      behind = places[old_of_wanted[i]];
      plan.after[behind] = wanted[i];
    } else {
      plan.added[behind].push_back(wanted[i]);
    }
  }
}

}  // namespace

ChildrenPlan planChildren(const std::vector<std::string_view>& names, const XmlNode& before, const XmlNode& after) {
  ChildrenPlan plan{std::vector<const XmlNode*>(names.size()), std::vector<const XmlNode*>(names.size()), {}};
  const std::vector<std::string_view> lists = listsOf(before, after);
  std::vector<std::size_t> rank_of_child;
  rank_of_child.reserve(names.size());
  for (const std::string_view name : names) {
    rank_of_child.push_back(static_cast<std::size_t>(std::find(lists.begin(), lists.end(), listOf(name)) - lists.begin()));
  }
  for (std::size_t rank = 0; rank < lists.size(); ++rank) {
    planList({lists[rank], rank, rank_of_child}, before, after, plan);
  }
  return plan;
}

}  // namespace oikos::semantic
