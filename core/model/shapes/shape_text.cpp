// SPDX-License-Identifier: Apache-2.0
#include "core/model/shapes/shape_text.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string_view>
#include <type_traits>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/model/furniture/furniture.h"
#include "core/model/shape_fields.h"
#include "core/model/small_objects.h"

namespace oikos::model {

namespace {

std::string faultOf(const ShapeField& field, const std::string& value) {
  return std::string(field.name) + " = '" + value + "': " + field.rule();
}

/// Sets the fields; returns what is wrong with the text.
std::vector<std::string> assign(std::string_view kind, const std::vector<ShapeField>& fields, const Dimensions& dimensions) {
  std::vector<std::string> faults;
  std::set<std::string_view> seen;
  for (const auto& [name, value] : dimensions) {
    const auto field = std::find_if(fields.begin(), fields.end(), [&name = name](const ShapeField& f) { return f.name == name; });
    if (field == fields.end()) {
      std::vector<std::string> names;
      std::transform(fields.begin(), fields.end(), std::back_inserter(names), [](const ShapeField& f) { return std::string(f.name); });
      faults.push_back("'" + std::string(kind) + "' has no dimension '" + name + "'" + base::didYouMean(name, names));
    } else if (!seen.insert(name).second) {
      faults.push_back(name + " is given twice");
    } else if (!field->set(value)) {
      faults.push_back(faultOf(*field, value));
    }
  }
  return faults;
}

/// The rules' messages without their owner: `furniture.width_m = -1: must be > 0` becomes `width_m = -1: …`.
std::vector<std::string> withoutOwner(std::vector<std::string> messages) {
  for (std::string& message : messages) {
    message.erase(0, message.find('.') + 1);
  }
  return messages;
}

template <class Shape>
std::vector<std::string> read(std::string_view kind, const Dimensions& dimensions, Shape& shape) {
  const std::vector<std::string> faults = assign(kind, listFields(shape), dimensions);
  return faults.empty() ? withoutOwner(shape.validate()) : faults;
}

/// A shape, the name of its kind and what makes its model.
struct ShapeKind {
  std::string_view name;
  std::vector<std::string> (*validate)(std::string_view kind, const Dimensions& dimensions);
  ArticulatedModel (*make)(std::string_view kind, const Dimensions& dimensions);  ///< of dimensions that are valid
  Dimensions (*defaults)();
  bool is_small;
};

ArticulatedModel asModel(std::string_view /*kind*/, ArticulatedModel model) {
  return model;
}

ArticulatedModel asModel(std::string_view kind, TriangleMesh mesh) {
  ArticulatedModel model;
  model.name = kind;
  model.parts.push_back({"body", std::make_shared<const TriangleMesh>(std::move(mesh))});
  return model;
}

template <class Shape>
std::vector<std::string> validateAs(std::string_view kind, const Dimensions& dimensions) {
  Shape shape;
  return read(kind, dimensions, shape);
}

template <class Shape, auto kMake>
ArticulatedModel makeAs(std::string_view kind, const Dimensions& dimensions) {
  Shape shape;
  OIKOS_CHECK(read(kind, dimensions, shape).empty());
  return asModel(kind, kMake(shape));
}

template <class Shape>
Dimensions defaultsOf() {
  Shape shape;
  Dimensions dimensions;
  for (const ShapeField& field : listFields(shape)) {
    dimensions.emplace_back(field.name, field.text());
  }
  return dimensions;
}

template <class Shape, auto kMake>
constexpr ShapeKind kindOf(std::string_view name) {
  constexpr bool kIsSmall = std::is_same_v<decltype(kMake(std::declval<const Shape&>())), TriangleMesh>;
  return {name, validateAs<Shape>, makeAs<Shape, kMake>, defaultsOf<Shape>, kIsSmall};
}

constexpr auto kKinds = std::to_array<ShapeKind>({
    kindOf<CabinetShape, makeCabinet>("cabinet"),
    kindOf<DrawerUnitShape, makeDrawerUnit>("drawer_unit"),
    kindOf<FridgeShape, makeFridge>("fridge"),
    kindOf<OvenShape, makeOven>("oven"),
    kindOf<DishwasherShape, makeDishwasher>("dishwasher"),
    kindOf<RoomDoorShape, makeRoomDoor>("room_door"),
    kindOf<TableShape, makeTable>("table"),
    kindOf<ChairShape, makeChair>("chair"),
    kindOf<SofaShape, makeSofa>("sofa"),
    kindOf<BedShape, makeBed>("bed"),
    kindOf<ShelfShape, makeShelf>("shelf"),
    kindOf<CounterShape, makeCounter>("counter"),
    kindOf<LampShape, makeLamp>("lamp"),
    kindOf<TvShape, makeTv>("tv"),
    kindOf<RugShape, makeRug>("rug"),
    kindOf<SinkUnitShape, makeSinkUnit>("sink_unit"),
    kindOf<ToiletShape, makeToilet>("toilet"),
    kindOf<BathtubShape, makeBathtub>("bathtub"),
    kindOf<WashbasinShape, makeWashbasin>("washbasin"),
    kindOf<CupShape, makeCup>("cup"),
    kindOf<BowlShape, makeBowl>("bowl"),
    kindOf<PlateShape, makePlate>("plate"),
    kindOf<BottleShape, makeBottle>("bottle"),
    kindOf<TinShape, makeTin>("tin"),
    kindOf<JarShape, makeJar>("jar"),
    kindOf<BoxShape, makeSmallBox>("box"),
    kindOf<CartonShape, makeCarton>("carton"),
    kindOf<BookShape, makeBook>("book"),
});

const ShapeKind* findKind(const std::string& name) {
  const auto* const found = std::find_if(kKinds.begin(), kKinds.end(), [&](const ShapeKind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : found;
}

std::string unknownKind(const std::string& name) {
  return "no shape of kind '" + name + "'" + base::didYouMean(name, shapeKinds());
}

}  // namespace

std::vector<std::string> validateShape(const std::string& kind, const Dimensions& dimensions) {
  const ShapeKind* const found = findKind(kind);
  return found == nullptr ? std::vector<std::string>{unknownKind(kind)} : found->validate(kind, dimensions);
}

ArticulatedModel makeShape(const std::string& kind, const Dimensions& dimensions, const std::string& where) {
  const std::vector<std::string> faults = validateShape(kind, dimensions);
  if (!faults.empty()) {
    throw base::Error(base::ErrorCode::kInput, faults.front(), where);
  }
  return findKind(kind)->make(kind, dimensions);
}

bool isSmallShape(const std::string& kind) {
  const ShapeKind* const found = findKind(kind);
  return found != nullptr && found->is_small;
}

std::vector<std::string> shapeKinds() {
  std::vector<std::string> names;
  for (const ShapeKind& kind : kKinds) {
    names.emplace_back(kind.name);
  }
  return names;
}

Dimensions shapeDimensions(const std::string& kind) {
  const ShapeKind* const found = findKind(kind);
  if (found == nullptr) {
    throw base::Error(base::ErrorCode::kUsage, unknownKind(kind));
  }
  return found->defaults();
}

}  // namespace oikos::model
