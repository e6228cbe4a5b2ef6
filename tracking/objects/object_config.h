// SPDX-License-Identifier: Apache-2.0
// When a small object counts as gone from its place.
#pragma once

#include <string>
#include <vector>

namespace oikos::tracking {

/// In which images an object is looked for. Neighbouring images repeat each other: a few from different places are enough.
struct ObjectViewConfig {
  double spacing_s = 0.3;    ///< between images that are thought of
  double max_range_m = 3.5;  ///< from the camera to the object's middle
  int min_pixels = 150;      ///< that show it, as the home is believed
  double min_side_px = 7.0;  ///< of the box around these
  double min_shown = 0.35;   ///< of these, in the rectangle around its box: less, and something known hides it
  double apart_m = 0.12;     ///< between the cameras of two images
  int first_views = 2;       ///< images that are looked at in any case,
  int more_views = 2;        ///< where it was hidden or not measured in these,
  int most_views = 6;        ///< and where one alone does not see it, or images do not agree
  double min_worth = 0.35;   ///< of an image, against the best of this object
  double read_anyway = 1.5;  ///< worth of an image that was read for something else
  double later_s = 2.0;      ///< what was there is looked for again in an image so much later

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("spacing_s", spacing_s);
    visitor("max_range_m", max_range_m);
    visitor("min_pixels", min_pixels);
    visitor("min_side_px", min_side_px);
    visitor("min_shown", min_shown);
    visitor("apart_m", apart_m);
    visitor("first_views", first_views);
    visitor("more_views", more_views);
    visitor("most_views", most_views);
    visitor("min_worth", min_worth);
    visitor("read_anyway", read_anyway);
    visitor("later_s", later_s);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// What a depth image says of an object's place, pixel by pixel, and then all together. Shares are of the pixels that would show the
/// object.
struct ObjectSightConfig {
  double sigmas = 3.0;             ///< of depth, pose and place: a reading farther behind the object has passed through its place
  double object_sigma_m = 0.010;   ///< of the object on what carries it, each axis,
  double fixed_sigma_m = 0.010;    ///< of that where it is fixed, as a tape measures it,
  double carried_sigma_m = 0.015;  ///< and where it can be pushed, and was found to stand as believed
  double height_sigma_m = 0.005;   ///< of the object's height where its carrier's top is seen beside it
  double max_sigma_m = 0.05;       ///< of all three: beyond, an image says nothing
  double min_facing = 0.2;         ///< cosine between ray and normal: less is grazing
  double near_m = 0.06;            ///< beside the object's box: what is found there may be the object, nudged
  double above_carrier_m = 0.02;   ///< lower readings are of what carries it
  double max_missing = 0.65;       ///< share without a reading
  double max_hidden = 0.4;         ///< share with something before it
  double min_telling = 0.5;        ///< share of its core that can tell the object from what is behind it,
  int min_telling_pixels = 35;     ///< and number
  double min_through = 0.85;       ///< of the pixels that tell: readings behind it. Half an object is an object
  double max_matter = 0.15;        ///< readings about the place that nothing else explains
  double min_matter = 0.35;        ///< from here on there is something
  double min_carrier = 0.6;        ///< share of readings of the carrier, beside the object, that are where it should be,
  int min_carrier_pixels = 30;     ///< and their number
  double max_edge_through = 0.25;  ///< along the edges of a carrier that can be pushed: readings past it, where it should be
  int min_edge_pixels = 25;        ///< in one of four columns of one of four rows

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("sigmas", sigmas);
    visitor("object_sigma_m", object_sigma_m);
    visitor("fixed_sigma_m", fixed_sigma_m);
    visitor("carried_sigma_m", carried_sigma_m);
    visitor("height_sigma_m", height_sigma_m);
    visitor("max_sigma_m", max_sigma_m);
    visitor("min_facing", min_facing);
    visitor("near_m", near_m);
    visitor("above_carrier_m", above_carrier_m);
    visitor("max_missing", max_missing);
    visitor("max_hidden", max_hidden);
    visitor("min_telling", min_telling);
    visitor("min_telling_pixels", min_telling_pixels);
    visitor("min_through", min_through);
    visitor("max_matter", max_matter);
    visitor("min_matter", min_matter);
    visitor("min_carrier", min_carrier);
    visitor("min_carrier_pixels", min_carrier_pixels);
    visitor("max_edge_through", max_edge_through);
    visitor("min_edge_pixels", min_edge_pixels);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// The hypothesis test over images. H0: it is there.
struct MissedTestConfig {
  int min_views = 2;         ///< from different places that do not see it
  double misread = 0.03;     ///< chance, at least, that an image does not see an object that is there
  double max_chance = 0.01;  ///< that all of them are wrong

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("min_views", min_views);
    visitor("misread", misread);
    visitor("max_chance", max_chance);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct ObjectWatchConfig {
  ObjectViewConfig views;
  ObjectSightConfig sight;
  MissedTestConfig missed;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("views", views);
    visitor("sight", sight);
    visitor("missed", missed);
  }
  [[nodiscard]] std::vector<std::string> validate() const { return {}; }
};

}  // namespace oikos::tracking
