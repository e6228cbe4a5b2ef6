// SPDX-License-Identifier: Apache-2.0
#include "tools/shaped_piece.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "semantic/model/home_models.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"

namespace oikos::tools {

namespace {

constexpr double kParkingDistance_m = 0.8;

semantic::Pose parsePose(const std::string& text) {
  std::array<double, 6> numbers{};
  std::istringstream words(text);
  std::string word;
  std::size_t count = 0;
  for (; words >> word; ++count) {
    const auto number = base::findNumber(word);
    if (count == numbers.size() || !number) {
      count = 0;
      break;
    }
    numbers[count] = *number;
  }
  if (count != numbers.size()) {
    throw base::Error(base::ErrorCode::kUsage, "'" + text + "': must be \"X Y Z ROLL PITCH YAW\" (m, deg)", "--at");
  }
  return {{numbers[0], numbers[1], numbers[2]}, Eigen::Vector3d(numbers[3], numbers[4], numbers[5]) * base::kRadPerDeg};
}

/// Its greatest x, closed.
double frontOf(const model::ArticulatedModel& made) {
  const auto T_model_parts = model::Kinematics(made).solve(std::vector<double>(made.joints.size(), 0.0));
  double front_m = 0.0;
  for (std::size_t i = 0; i < made.parts.size(); ++i) {
    if (made.parts[i].mesh_part) {
      for (const Eigen::Vector3f& vertex_part : made.parts[i].mesh_part->vertices) {
        front_m = std::max(front_m, (T_model_parts[i] * vertex_part.cast<double>()).x());
      }
    }
  }
  return front_m;
}

semantic::LargeObject pieceOf(const semantic::Shape& shape, const PieceText& text) {
  const model::ArticulatedModel made = semantic::makeShape(shape, "--shape");
  semantic::LargeObject piece;
  piece.id = {text.id};
  piece.type = text.type;
  piece.T_map_object = parsePose(text.pose);
  piece.shape = shape;
  if (!made.joints.empty()) {
    piece.articulation = semantic::articulationOf(made, piece.id);
  }
  // Rounded up to a centimetre: a person will read it.
  const double distance_m = std::ceil(100.0 * (frontOf(made) + kParkingDistance_m) - 1e-6) / 100.0;
  piece.parking_poses = {{{{distance_m, 0.0, 0.0}, {0.0, 0.0, std::numbers::pi}}, true}};
  return piece;
}

semantic::SmallObject smallObjectOf(const semantic::Shape& shape, const PieceText& text) {
  const Eigen::AlignedBox3f bounds = semantic::makeShape(shape, "--shape").parts.front().mesh_part->bounds();
  semantic::SmallObject object;
  object.id = {text.id};
  object.type = text.type;
  object.parent = text.parent;
  object.T_parent_object = parsePose(text.pose);
  object.shape = shape;
  object.default_places = {{object.parent, object.relation, object.T_parent_object}};
  object.graspable = true;
  const double middle_m = std::round(500.0 * static_cast<double>(bounds.min().z() + bounds.max().z())) / 1000.0;  // to a millimetre
  object.grasping_points.push_back({{}, {{0.0, 0.0, middle_m}, Eigen::Vector3d::Zero()}});
  return object;
}

/// A home with one room, whose id it is given.
semantic::Home homeWithRoom(const PieceText& piece, const std::string& room_id) {
  semantic::Home home;
  home.id = piece.id == "home" || room_id == "home" ? "home-of-it" : "home";
  home.name = "home";
  semantic::Room room;
  room.id = {room_id};
  room.name = "room";
  home.rooms = {room};
  return home;
}

/// Throws unless it is in order.
void checkHome(const semantic::Home& home) {
  for (const semantic::Finding& finding : semantic::readHomeText(semantic::toXml(home), "home.xml").findings) {
    if (finding.severity == semantic::Severity::kError) {
      throw base::Error(base::ErrorCode::kUsage,
                        finding.element + ": " + finding.found + (finding.expected.empty() ? "" : "; expected " + finding.expected));
    }
  }
}

}  // namespace

semantic::Shape parseShape(const std::string& text) {
  std::istringstream words(text);
  semantic::Shape shape;
  words >> shape.kind;
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos) {
      shape.dimensions.push_back({word.substr(0, equals), word.substr(equals + 1)});
    } else if (!shape.dimensions.empty()) {
      shape.dimensions.back().value += " " + word;
    } else {
      throw base::Error(base::ErrorCode::kUsage, "'" + word + "': must be NAME=VALUE, as width_m=0.8", "--shape");
    }
  }
  if (const auto faults = model::validateShape(shape.kind, semantic::dimensionsOf(shape)); !faults.empty()) {
    throw base::Error(base::ErrorCode::kUsage, faults.front(), "--shape");
  }
  return shape;
}

std::string pieceXml(const semantic::Shape& shape, const PieceText& piece) {
  if (model::isSmallShape(shape.kind)) {
    const semantic::SmallObject made = smallObjectOf(shape, piece);
    semantic::Home home = homeWithRoom(piece, piece.parent);
    home.rooms.front().small_objects = {made};
    checkHome(home);
    return semantic::toXml(made);
  }
  const semantic::LargeObject made = pieceOf(shape, piece);
  semantic::Home home = homeWithRoom(piece, piece.id == "room" ? "room-of-it" : "room");
  home.rooms.front().objects = {made};
  checkHome(home);
  return semantic::toXml(made);
}

}  // namespace oikos::tools
