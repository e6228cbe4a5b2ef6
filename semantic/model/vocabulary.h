// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"

namespace oikos::semantic {

/// One thing that the home can speak of, and other words for it.
struct Term {
  std::string name;
  std::vector<std::string> synonyms;
  std::optional<double> stays_for_h = std::nullopt;  ///< of a type of object: after that time half of them lie elsewhere
  bool operator==(const Term&) const = default;
};

enum class TermKind { kRoomType, kObjectType, kAffordance, kColor, kSurplus };
constexpr auto enumTable(TermKind) {
  return std::to_array<base::EnumName<TermKind>>({{TermKind::kRoomType, "room"},
                                                  {TermKind::kObjectType, "object"},
                                                  {TermKind::kAffordance, "affordance"},
                                                  {TermKind::kColor, "color"},
                                                  {TermKind::kSurplus, "surplus"}});
}

/// The words of a home (S360). Data, so that a home can have its own without a build.
struct Vocabulary {
  std::vector<Term> room_types;
  std::vector<Term> object_types;
  std::vector<Term> affordances;
  std::vector<Term> colors;
  std::vector<Term> surplus;  ///< what people say around a question and mean nothing by: "could you tell me", "sweetheart"

  [[nodiscard]] std::vector<Term>& of(TermKind kind);
  [[nodiscard]] const std::vector<Term>& of(TermKind kind) const;
  /// The term with this name, or with this synonym where no name matches; case matters. Null: none.
  [[nodiscard]] const Term* find(TermKind kind, std::string_view word) const;
  /// A name that is there already gets the further synonyms, and the time if there is one.
  void add(TermKind kind, const Term& term);
  /// How long an object of this type stays where it is: after that time half of them lie elsewhere.
  [[nodiscard]] double halfLife_s(std::string_view object_type) const;
  bool operator==(const Vocabulary&) const = default;
};

/// What every home knows without a line about it.
[[nodiscard]] Vocabulary builtInVocabulary();

}  // namespace oikos::semantic
