// SPDX-License-Identifier: Apache-2.0
// From phrases to the things of a home that they mean.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "semantic/query/home_index.h"
#include "semantic/query/question.h"

namespace oikos::semantic {

using Things = std::vector<const Thing*>;

/// What a phrase means; the things point into the index.
struct Resolution {
  Things things;                       ///< the best matches, in the order of the index; the nearest first where that was asked
  std::size_t elsewhere = 0;           ///< how many more would fit without the places that were named
  std::string missing_place;           ///< as it was said: that nothing fits
  bool floor = false;                  ///< the floor of the rooms in `things`
  bool known = true;                   ///< false: a word of it means nothing here
  std::vector<std::string> unknown;    ///< these
  std::vector<std::string> corrected;  ///< "was -> taken for"
};

class Resolver {
 public:
  /// `present`: where "from the dishwasher" is looked up, in a question about the past; may be the same. Both must outlive it.
  Resolver(const HomeIndex& index, const HomeIndex& present, std::optional<Eigen::Vector2d> robot_map)
      : index_(index), present_(present), robot_map_(std::move(robot_map)) {}

  [[nodiscard]] Resolution resolve(const ThingPhrase& phrase) const;
  /// Everything that lies in the places: furniture and small objects of rooms, small objects of furniture.
  [[nodiscard]] Resolution contents(const ThingPhrase& phrase) const;
  /// Whether the thing is in that relation to one of the places.
  [[nodiscard]] static bool isAt(const Thing& thing, PlaceRelation relation, const Resolution& places);

 private:
  [[nodiscard]] Lookup lookUp(const ThingPhrase& phrase) const;
  void dropWholes(const ThingPhrase& phrase, Lookup& lookup) const;
  void filterByPlaces(const ThingPhrase& phrase, Lookup& lookup, Resolution& resolution) const;
  void filterByPlace(const PlacePhrase& place, Lookup& lookup, Resolution& resolution) const;
  [[nodiscard]] Resolution resolvePlace(const PlacePhrase& place) const;
  /// Where the phrase says "open" or "closed".
  void keepOpen(const ThingPhrase& phrase, Lookup& lookup) const;
  void sortByDistance(const ThingPhrase& phrase, Resolution& resolution) const;
  void noteWords(const Lookup& lookup, Resolution& resolution) const;

  const HomeIndex& index_;
  const HomeIndex& present_;
  std::optional<Eigen::Vector2d> robot_map_;
};

}  // namespace oikos::semantic
