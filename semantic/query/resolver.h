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
  // resolver_nouns.cpp
  [[nodiscard]] Lookup lookUp(const ThingPhrase& phrase) const;
  [[nodiscard]] Lookup lookUpNoun(const ThingPhrase& phrase) const;
  void dropWholes(const ThingPhrase& phrase, Lookup& lookup) const;
  [[nodiscard]] Things bestOf(const Lookup& lookup) const;
  // resolver_places.cpp
  void filterByPlaces(const ThingPhrase& phrase, Lookup& lookup, Resolution& resolution) const;
  void filterByPlace(const PlacePhrase& place, Lookup& lookup, Resolution& resolution) const;
  [[nodiscard]] bool filterByRoom(const PlacePhrase& place, Lookup& lookup, Resolution& resolution) const;
  struct PlaceMeant {
    const PlacePhrase* phrase = nullptr;
    Resolution places;
  };
  [[nodiscard]] std::vector<PlaceMeant> resolveEach(const PlacePhrase& place, Resolution& resolution) const;
  void dropPartsOfMatches(Lookup& lookup) const;
  void keepNextTo(const Thing& place, Lookup& lookup) const;
  /// "from the dishwasher", in a question about the past.
  [[nodiscard]] bool isOfNow(const PlacePhrase& place) const;
  [[nodiscard]] Resolution resolvePlace(const PlacePhrase& place) const;
  [[nodiscard]] Lookup carriedBy(const Things& places) const;
  [[nodiscard]] Lookup everything() const;
  // resolver.cpp
  [[nodiscard]] std::optional<ThingPhrase> withNounOfOthers(const ThingPhrase& phrase) const;
  void resolveOthers(const ThingPhrase& phrase, Resolution& resolution) const;
  [[nodiscard]] Resolution resolveFloor(const ThingPhrase& phrase) const;
  /// Where the phrase says "open" or "closed".
  void keepOpen(const ThingPhrase& phrase, Lookup& lookup) const;
  /// Where the phrase says "furniture".
  void keepFurniture(const ThingPhrase& phrase, Lookup& lookup) const;
  void sortByDistance(const ThingPhrase& phrase, Resolution& resolution) const;
  /// What the thing shall be nearest to; it is not among the things any more.
  [[nodiscard]] Things takeNearestTo(const ThingPhrase& phrase, Resolution& resolution) const;
  static void noteWords(const Lookup& lookup, Resolution& resolution);
  static void noteWords(const Resolution& more, Resolution& resolution);

  const HomeIndex& index_;
  const HomeIndex& present_;
  std::optional<Eigen::Vector2d> robot_map_;
};

}  // namespace oikos::semantic
