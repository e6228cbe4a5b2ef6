// SPDX-License-Identifier: Apache-2.0
#include "tools/demo/demo_home.h"

#include <sstream>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "semantic/model/home_models.h"

namespace oikos::demo {

namespace {

using namespace semantic;

/// On the floor: x, y (m), heading (degrees), height above the floor.
struct Spot {
  double x_m;
  double y_m;
  double yaw_deg;
  double z_m = 0.0;
};

Pose poseOf(const Spot& spot) {
  Pose pose;
  pose.position_m = {spot.x_m, spot.y_m, spot.z_m};
  pose.roll_pitch_yaw_rad = {0.0, 0.0, spot.yaw_deg * kRadPerDeg};
  return pose;
}

/// "cabinet width_m=0.8 door_count=2"
Shape shapeOf(const std::string& text) {
  std::istringstream words(text);
  Shape shape;
  words >> shape.kind;
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    shape.dimensions.push_back({word.substr(0, equals), word.substr(equals + 1)});
  }
  return shape;
}

/// What a piece is, beside where it stands.
struct Kind {
  std::string id;
  std::string type;
  std::string label;
  std::string shape;
  Movability movability = Movability::kFixed;
  std::vector<std::string> affordances = {};
};

/// What a small object is.
struct SmallKind {
  std::string id;
  std::string type;
  std::string label;
  std::string shape;
  std::vector<Property> properties = {};
};

class RoomMaker {
 public:
  RoomMaker(const std::string& id, const std::string& name, std::vector<Eigen::Vector2d> outline_map) {
    room_.id.value = id;
    room_.name = name;
    room_.type = id;
    room_.outline_map = std::move(outline_map);
  }

  /// Furniture; later small objects go onto, into or under it.
  RoomMaker& put(const Kind& kind, const Spot& spot) {
    LargeObject object;
    object.id.value = kind.id;
    object.type = kind.type;
    object.label = kind.label;
    object.shape = shapeOf(kind.shape);
    object.movability = kind.movability;
    object.T_map_object = poseOf(spot);
    object.affordances = kind.affordances;
    const model::ArticulatedModel model = makeShape(*object.shape, "shape of '" + kind.id + "'");
    object.parking_poses = {parkingBefore(model)};
    if (!model.joints.empty()) {
      object.articulation = articulationOf(model, object.id);
    }
    room_.objects.emplace_back(std::move(object));
    return *this;
  }

  /// Into the frame of the last piece, or of its part `part` (`left_door`).
  RoomMaker& place(const SmallKind& kind, Relation relation, const Spot& spot, const std::string& part = "") {
    LargeObject& carrier = room_.objects.back().edit();
    SmallObject object;
    object.id.value = kind.id;
    object.type = kind.type;
    object.label = kind.label;
    object.shape = shapeOf(kind.shape);
    object.properties = kind.properties;
    object.parent = part.empty() ? carrier.id.value : carrier.id.value + "-" + part;
    object.relation = relation;
    object.T_parent_object = poseOf(spot);
    object.default_places = {{object.parent, relation, object.T_parent_object}};
    object.graspable = true;
    Pose grasp;
    grasp.position_m = {0.0, 0.0, 0.05};
    object.grasping_points = {{{}, grasp}};
    carrier.small_objects.push_back(std::move(object));
    return *this;
  }

  [[nodiscard]] Room take() { return std::move(room_); }

 private:
  /// Before its front, looking at it.
  static ParkingPose parkingBefore(const model::ArticulatedModel& model) {
    constexpr double kReach_m = 0.7;
    double front_m = 0.0;
    for (const model::ModelPart& part : model.parts) {
      front_m = part.mesh_part ? std::max(front_m, static_cast<double>(part.mesh_part->bounds().max().x())) : front_m;
    }
    return {poseOf({std::round((front_m + kReach_m) * 100.0) / 100.0, 0.0, 180.0}), true};
  }

  Room room_;
};

std::vector<Eigen::Vector2d> rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

constexpr const char* kBaseUnit = " depth_m=0.58 height_m=0.88 worktop_thickness_m=0.03 worktop_overhang_m=0.02 front_rgb=#D9D2C3";
constexpr const char* kWallUnit =
    " depth_m=0.35 height_m=0.7 bottom_m=1.45 plinth_height_m=0 shelf_count=1 front_rgb=#D9D2C3 handle_level=0.1";

Kind roomDoor(const std::string& id, const std::string& label, const std::string& hinge) {
  return {id, "door", label, "room_door depth_m=0.12 hinge=" + hinge};
}

Kind picture(const std::string& id, double width_m, double height_m) {
  std::ostringstream shape;
  shape << "box width_m=" << width_m << " depth_m=0.02 height_m=" << height_m;
  return {id, "picture", "", shape.str()};
}

SmallKind cup(const std::string& id, const std::string& color, const std::string& rgb) {
  return {id, "cup", "", "cup outside_rgb=" + rgb + " body_rgb=" + rgb, {{"color", color}}};
}

SmallKind book(const std::string& id, const std::string& label, const std::string& color, const std::string& shape) {
  return {id, "book", label, "book " + shape, {{"color", color}}};
}

Room makeHall() {
  RoomMaker hall("hall", "hall", rectangle({-0.6, -0.7}, {6.0, 0.9}));
  hall.put(roomDoor("kitchen-door", "kitchen door", "left"), {1.4, 0.96, 90.0});
  hall.put(roomDoor("bathroom-door", "bathroom door", "right"), {4.7, 0.96, 90.0});
  hall.put(roomDoor("living-door", "living room door", "right"), {2.0, -0.76, -90.0});
  hall.put(roomDoor("bedroom-door", "bedroom door", "left"), {6.06, 0.1, 0.0});
  hall.put({"shoe-cabinet",
            "cabinet",
            "shoe cabinet",
            "cabinet width_m=0.8 depth_m=0.32 height_m=0.95 door_count=2 front_rgb=#C2A27C",
            Movability::kShiftable,
            {"supporting_surface"}},
           {3.1, 0.73, -90.0})
      .place({"key-box", "box", "key box", "box width_m=0.14 depth_m=0.1 height_m=0.07", {{"color", "brown"}}}, Relation::kOn,
             {0.0, 0.2, 15.0, 0.95})
      .place(book("phone-book", "phone book", "yellow", "height_m=0.05"), Relation::kOn, {0.0, -0.15, 80.0, 0.95});
  hall.put(picture("hall-picture-1", 0.6, 0.45), {0.35, 0.885, -90.0, 1.4});
  hall.put(picture("hall-picture-2", 0.5, 0.7), {3.6, -0.685, 90.0, 1.25});
  hall.put(picture("hall-picture-3", 0.7, 0.5), {5.0, -0.685, 90.0, 1.35});
  hall.put(picture("hall-picture-4", 0.5, 0.5), {-0.585, -0.3, 0.0, 1.2});
  hall.put(picture("hall-picture-5", 0.4, 0.6), {2.35, 0.885, -90.0, 1.3});
  hall.put(picture("hall-picture-6", 0.7, 0.5), {0.6, -0.685, 90.0, 1.2});
  hall.put(picture("hall-picture-7", 0.45, 0.6), {5.75, -0.685, 90.0, 1.1});
  return hall.take();
}

void furnishKitchenRow(RoomMaker& kitchen) {
  const std::string base = kBaseUnit;
  const std::string wall = kWallUnit;
  kitchen.put({"fridge", "fridge", "", "fridge width_m=0.6 depth_m=0.62 height_m=1.8 hinge=left"}, {-0.28, 4.27, -90.0})
      .place({"milk", "carton", "milk carton", "carton", {{"content", "milk"}, {"color", "white"}}}, Relation::kIn, {0.0, 0.1, 10.0, 1.02});
  kitchen
      .put({"cupboard",
            "cupboard",
            "base cupboard",
            "cabinet width_m=0.6 door_count=1 hinge=left" + base,
            Movability::kFixed,
            {"supporting_surface"}},
           {0.33, 4.29, -90.0})
      .place({"cereal", "box", "cereal box", "box width_m=0.19 depth_m=0.07 height_m=0.28", {{"color", "yellow"}}}, Relation::kOn,
             {0.05, 0.12, 25.0, 0.88})
      .place(cup("white-cup", "white", "#F0EEE8"), Relation::kOn, {0.1, -0.12, 200.0, 0.88});
  kitchen
      .put({"drawers",
            "drawer_unit",
            "kitchen drawers",
            "drawer_unit width_m=0.6 drawer_count=3" + base,
            Movability::kFixed,
            {"supporting_surface"}},
           {0.94, 4.29, -90.0})
      .place({"sugar", "container", "sugar jar", "jar", {{"color", "silver"}, {"content", "sugar"}}}, Relation::kOn, {0.0, 0.1, 0.0, 0.88})
      .place({"oil", "bottle", "oil bottle", "bottle", {{"color", "green"}, {"content", "oil"}}}, Relation::kOn, {-0.12, -0.1, 40.0, 0.88});
  kitchen.put({"oven", "oven", "", "oven width_m=0.6 depth_m=0.58 height_m=0.88"}, {1.55, 4.29, -90.0});
  kitchen.put({"dishwasher", "dishwasher", "", "dishwasher width_m=0.6 depth_m=0.58 height_m=0.88"}, {2.16, 4.29, -90.0});
  kitchen
      .put({"sink-cupboard",
            "cupboard",
            "corner cupboard",
            "cabinet width_m=0.72 door_count=2" + base,
            Movability::kFixed,
            {"supporting_surface"}},
           {2.83, 4.29, -90.0})
      .place({"dish-bowl", "bowl", "", "bowl outside_rgb=#E6E1D6", {{"color", "white"}}}, Relation::kOn, {0.0, 0.1, 0.0, 0.88})
      .place({"tomatoes", "tin", "tomato tin", "tin", {{"color", "red"}, {"content", "tomatoes"}}}, Relation::kOn, {0.1, -0.2, 70.0, 0.88});
  kitchen.put({"wall-cupboard-1", "cupboard", "left wall cupboard", "cabinet width_m=0.6 door_count=1 hinge=left" + wall},
              {0.33, 4.42, -90.0});
  kitchen.put({"wall-cupboard-2", "cupboard", "middle wall cupboard", "cabinet width_m=0.6 door_count=2" + wall}, {0.94, 4.42, -90.0});
  kitchen.put({"wall-cupboard-3", "cupboard", "right wall cupboard", "cabinet width_m=0.8 door_count=2" + wall}, {2.5, 4.42, -90.0});
}

Room makeKitchen() {
  RoomMaker kitchen("kitchen", "kitchen", rectangle({-0.6, 1.02}, {3.2, 4.6}));
  furnishKitchenRow(kitchen);
  kitchen
      .put({"kitchen-table", "table", "kitchen table", "table width_m=1.1 depth_m=0.75", Movability::kShiftable, {"supporting_surface"}},
           {2.45, 2.5, 180.0})
      .place(cup("blue-cup", "blue", "#2F5FB3"), Relation::kOn, {0.15, 0.3, 30.0, 0.74})
      .place(cup("red-cup", "red", "#B8322A"), Relation::kOn, {0.2, 0.05, 120.0, 0.74})
      .place({"cereal-bowl", "bowl", "cereal bowl", "bowl", {{"color", "orange"}}}, Relation::kOn, {0.05, -0.2, 0.0, 0.74})
      .place({"plate", "plate", "", "plate", {{"color", "white"}}}, Relation::kOn, {-0.15, 0.15, 0.0, 0.74})
      .place({"juice", "carton", "juice carton", "carton", {{"color", "orange"}, {"content", "juice"}}}, Relation::kOn,
             {-0.05, -0.42, 60.0, 0.74});
  kitchen.put({"kitchen-chair-1", "chair", "", "chair", Movability::kMovable, {"sittable"}}, {1.78, 2.75, 0.0});
  kitchen.put({"kitchen-chair-2", "chair", "", "chair", Movability::kMovable, {"sittable"}}, {1.78, 2.2, 5.0});
  kitchen
      .put({"crockery", "cupboard", "tall cupboard",
            "cabinet width_m=1.0 depth_m=0.4 height_m=1.9 door_count=2 shelf_count=4 front_rgb=#C9B48C handle_level=0.5"},
           {-0.4, 2.3, 0.0})
      .place(cup("green-cup", "green", "#3C8A4E"), Relation::kIn, {-0.05, 0.2, 0.0, 1.17})
      .place({"soup-plate", "plate", "soup plate", "plate", {{"color", "white"}}}, Relation::kIn, {-0.03, -0.2, 0.0, 0.82});
  kitchen.put(picture("kitchen-picture", 0.5, 0.4), {3.185, 2.6, 180.0, 1.4});
  return kitchen.take();
}

void furnishShelves(RoomMaker& living) {
  living.put({"bookshelf-1", "shelf", "left bookshelf", "shelf width_m=0.8 depth_m=0.3 height_m=1.8"}, {1.2, -4.84, 90.0})
      .place(book("atlas", "atlas", "blue", "height_m=0.05"), Relation::kIn, {0.02, 0.2, 170.0, 0.73})
      .place(book("cookbook", "cookbook", "red", "height_m=0.04"), Relation::kIn, {0.02, -0.15, 20.0, 0.73})
      .place({"game", "box", "board game", "box width_m=0.28 depth_m=0.2 height_m=0.06", {{"color", "green"}}}, Relation::kIn,
             {0.0, 0.1, 0.0, 1.09});
  living.put({"bookshelf-2", "shelf", "right bookshelf", "shelf width_m=0.8 depth_m=0.3 height_m=1.8"}, {2.02, -4.84, 90.0})
      .place(book("novel", "novel", "green", "height_m=0.03"), Relation::kIn, {0.02, 0.1, 10.0, 1.09})
      .place(book("dictionary", "dictionary", "brown", "height_m=0.06"), Relation::kIn, {0.0, -0.2, 0.0, 0.73})
      .place({"tea", "tin", "tea tin", "tin", {{"color", "green"}, {"content", "tea"}}}, Relation::kIn, {0.03, 0.2, 30.0, 0.37});
  living
      .put({"chest",
            "drawer_unit",
            "chest of drawers",
            "drawer_unit width_m=0.9 depth_m=0.45 height_m=0.8 drawer_count=4 front_rgb=#A67F55",
            Movability::kFixed,
            {"supporting_surface"}},
           {3.3, -4.77, 90.0})
      .place({"vase", "bottle", "glass bottle", "bottle", {{"color", "blue"}}}, Relation::kOn, {0.0, 0.25, 0.0, 0.8})
      .place({"photo-box", "box", "photo box", "box width_m=0.2 depth_m=0.15 height_m=0.1", {{"color", "red"}}}, Relation::kOn,
             {0.05, -0.2, 10.0, 0.8});
}

Room makeLivingRoom() {
  RoomMaker living("living_room", "living room", rectangle({0.0, -5.0}, {5.2, -0.82}));
  furnishShelves(living);
  living.put({"sideboard",
              "cabinet",
              "sideboard",
              "cabinet width_m=1.4 depth_m=0.42 height_m=0.5 door_count=2 plinth_height_m=0.05 front_rgb=#8F6B47",
              Movability::kFixed,
              {"supporting_surface"}},
             {0.23, -3.2, 0.0});
  living.put({"tv", "tv", "television", "tv", Movability::kShiftable}, {0.2, -3.2, 0.0, 0.5});
  living.put({"sofa", "sofa", "", "sofa", Movability::kShiftable, {"sittable"}}, {4.72, -3.2, 180.0});
  living.put({"rug", "rug", "", "rug width_m=1.8 depth_m=2.2", Movability::kShiftable}, {2.9, -3.2, 0.0});
  living
      .put({"coffee-table",
            "table",
            "coffee table",
            "table width_m=0.95 depth_m=0.55 height_m=0.42 apron_height_m=0.05",
            Movability::kMovable,
            {"supporting_surface"}},
           {3.65, -3.2, 180.0})
      .place(cup("blue-cup-2", "blue", "#3567A8"), Relation::kOn, {0.05, 0.2, 60.0, 0.42})
      .place(book("magazine", "magazine", "yellow", "height_m=0.02"), Relation::kOn, {0.0, -0.15, 100.0, 0.42})
      .place({"nuts", "bowl", "nut bowl", "bowl outside_rgb=#4E7F8C", {{"color", "blue"}}}, Relation::kOn, {-0.12, 0.02, 0.0, 0.42});
  living
      .put({"desk", "table", "desk", "table width_m=1.3 depth_m=0.65 height_m=0.74", Movability::kShiftable, {"supporting_surface"}},
           {4.2, -1.18, -90.0})
      .place(book("notebook", "notebook", "black", "height_m=0.02"), Relation::kOn, {0.1, 0.1, 85.0, 0.74})
      .place({"pencils", "box", "pencil box", "box width_m=0.2 depth_m=0.08 height_m=0.05", {{"color", "blue"}}}, Relation::kOn,
             {0.0, -0.3, 20.0, 0.74});
  living.put({"desk-chair", "chair", "desk chair", "chair seat_rgb=#6E4A3A", Movability::kMovable, {"sittable"}}, {4.2, -1.72, 90.0});
  living.put({"lamp", "lamp", "floor lamp", "lamp", Movability::kMovable}, {4.9, -4.65, 0.0});
  living.put(picture("living-picture-1", 0.8, 0.6), {5.185, -2.4, 180.0, 1.3});
  living.put(picture("living-picture-2", 0.6, 0.8), {5.185, -3.9, 180.0, 1.25});
  living.put(picture("living-picture-3", 0.6, 0.45), {0.015, -1.7, 0.0, 1.35});
  living.put(picture("living-picture-4", 0.9, 0.5), {3.3, -4.985, 90.0, 1.3});
  return living.take();
}

Room makeBedroom() {
  RoomMaker bedroom("bedroom", "bedroom", rectangle({6.12, -2.6}, {10.0, 1.4}));
  bedroom.put({"bed", "bed", "", "bed width_m=1.4", Movability::kFixed}, {8.94, -0.8, 180.0});
  bedroom
      .put({"wardrobe", "wardrobe", "",
            "cabinet width_m=1.2 depth_m=0.6 height_m=2.05 door_count=2 shelf_count=3 front_rgb=#B99466 handle_level=0.5"},
           {9.35, 1.09, -90.0})
      .place({"hat-box", "box", "hat box", "box width_m=0.3 depth_m=0.3 height_m=0.16", {{"color", "purple"}}}, Relation::kIn,
             {0.0, 0.2, 0.0, 1.1});
  bedroom
      .put({"nightstand",
            "drawer_unit",
            "nightstand",
            "drawer_unit width_m=0.45 depth_m=0.4 height_m=0.5 drawer_count=2 front_rgb=#B99466",
            Movability::kShiftable,
            {"supporting_surface"}},
           {9.78, -1.8, 180.0})
      .place(book("diary", "diary", "red", "height_m=0.03"), Relation::kOn, {0.02, 0.05, 75.0, 0.5})
      .place(cup("yellow-cup", "yellow", "#D9B23C"), Relation::kOn, {0.0, -0.12, 0.0, 0.5});
  bedroom
      .put({"linen-chest",
            "drawer_unit",
            "linen chest",
            "drawer_unit width_m=1.0 depth_m=0.45 height_m=0.85 drawer_count=4 front_rgb=#D7CDBB",
            Movability::kFixed,
            {"supporting_surface"}},
           {7.2, -2.37, 90.0})
      .place({"pills", "box", "medicine box", "box width_m=0.12 depth_m=0.06 height_m=0.08", {{"color", "white"}}}, Relation::kOn,
             {0.0, 0.2, 5.0, 0.85})
      .place({"cream", "container", "cream jar", "jar", {{"color", "white"}}}, Relation::kOn, {0.05, -0.25, 0.0, 0.85});
  bedroom.put({"bedroom-lamp", "lamp", "bedroom lamp", "lamp height_m=1.4", Movability::kMovable}, {6.45, -2.25, 0.0});
  bedroom.put(picture("bedroom-picture-1", 0.9, 0.6), {7.3, 1.385, -90.0, 1.3});
  bedroom.put(picture("bedroom-picture-2", 0.6, 0.6), {9.985, -0.8, 180.0, 1.4});
  bedroom.put(picture("bedroom-picture-3", 0.5, 0.7), {7.2, -2.585, 90.0, 1.3});
  return bedroom.take();
}

Room makeBathroom() {
  RoomMaker bathroom("bathroom", "bathroom", rectangle({3.32, 1.02}, {6.0, 3.6}));
  bathroom.put({"bathtub", "bathtub", "", "bathtub depth_m=0.72"}, {5.13, 3.23, -90.0});
  bathroom
      .put({"washstand",
            "cabinet",
            "washstand",
            "cabinet width_m=0.8 depth_m=0.45 height_m=0.82 door_count=2 front_rgb=#E4E6E7 worktop_thickness_m=0.04 worktop_rgb=#F2F2F0",
            Movability::kFixed,
            {"supporting_surface"}},
           {5.77, 1.75, 180.0})
      .place(cup("tooth-cup", "white", "#E9EDEF"), Relation::kOn, {0.0, 0.25, 0.0, 0.82})
      .place({"soap", "box", "soap box", "box width_m=0.09 depth_m=0.06 height_m=0.04", {{"color", "green"}}}, Relation::kOn,
             {0.05, -0.2, 30.0, 0.82});
  bathroom
      .put({"bathroom-shelf", "shelf", "bathroom shelf", "shelf width_m=0.6 depth_m=0.28 height_m=1.7 body_rgb=#DADFE0"},
           {3.66, 3.45, -90.0})
      .place({"washing-powder", "carton", "washing powder", "carton", {{"color", "blue"}}}, Relation::kIn, {0.0, 0.1, 10.0, 0.36})
      .place({"towel-box", "box", "towel box", "box width_m=0.3 depth_m=0.2 height_m=0.18", {{"color", "white"}}}, Relation::kIn,
             {0.0, 0.0, 0.0, 0.69});
  bathroom.put(picture("bathroom-picture", 0.4, 0.5), {3.335, 2.2, 0.0, 1.3});
  bathroom.put(picture("mirror", 0.7, 0.8), {5.985, 1.75, 180.0, 1.15});
  return bathroom.take();
}

}  // namespace

Home makeDemoHome() {
  Home home;
  home.id = "demo";
  home.name = "The demo apartment";
  home.version = 1;
  home.time_zone = "Europe/Berlin";
  Vocabulary vocabulary = builtInVocabulary();
  for (const Term& term :
       {Term{"picture", {"painting"}, {}}, Term{"rug", {"carpet"}, {}}, Term{"lamp", {}, {}}, Term{"nightstand", {"bedside table"}, {}},
        Term{"wardrobe", {}, {}}, Term{"carton", {}, {}}, Term{"tin", {"can"}, {}}, Term{"plate", {}, {}}, Term{"cabinet", {}, {}}}) {
    vocabulary.add(TermKind::kObjectType, term);
  }
  home.vocabulary = std::move(vocabulary);
  home.rooms = {makeHall(), makeKitchen(), makeLivingRoom(), makeBedroom(), makeBathroom()};
  return home;
}

}  // namespace oikos::demo
