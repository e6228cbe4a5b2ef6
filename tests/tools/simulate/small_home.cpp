// SPDX-License-Identifier: Apache-2.0
#include "tests/tools/simulate/small_home.h"

#include <stdexcept>

#include "semantic/xml/home_reader.h"

namespace oikos::simulate {

std::string smallHomeXml() {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<apartment id="flat" name="flat" version="1">
  <room id="kitchen" name="kitchen" type="kitchen" outline_m="-2 -1.5 2 -1.5 2 1.5 -2 1.5">
    <largeObject id="table" type="table" pose="1 0 0 0 0 180" movability="shiftable" graspable="false">
      <shape kind="table" width_m="1" depth_m="0.8" height_m="0.75"/>
      <parkingPose pose="1 0 0 0 0 180" default="true"/>
      <smallObject id="cup" type="cup" parent="table" relation="on" pose="0.2 0 0.75 0 0 0" graspable="false">
        <defaultPlace parent="table" relation="on" pose="0.2 0 0.75 0 0 0"/>
        <shape kind="cup"/>
      </smallObject>
    </largeObject>
    <largeArticulatedObject id="oven" type="oven" pose="-1.6 1 0 0 0 0" movability="fixed" graspable="false">
      <shape kind="oven" width_m="0.6" depth_m="0.58" height_m="0.88"/>
      <part id="oven-body"/>
      <part id="oven-door" parent="oven-body"/>
      <joint id="oven-door-joint" type="revolute" parent="oven-body" child="oven-door" origin="0.29 0 0.222 0 0 0" axis="0 1 0"
             lower_deg="0" upper_deg="90" value_deg="0"/>
      <handle id="oven-door_handle" part="oven-door" kind="bar" pose="0.03 0 0.489 -90 0 0" length_m="0.42"/>
      <knob id="oven-knob_0" part="oven-body" pose="0.29 -0.24 0.813 0 0 0" axis="-1 0 0" current="0">
        <state name="0" angle_deg="0"/>
        <state name="1" angle_deg="30"/>
        <state name="2" angle_deg="60"/>
      </knob>
      <parkingPose pose="1 0 0 0 0 180" default="true"/>
    </largeArticulatedObject>
  </room>
  <room id="study" name="study" type="study" outline_m="2.1 -1.5 2.1 1.5 6.1 1.5 6.1 -1.5">
    <largeArticulatedObject id="drawers" type="drawer_unit" pose="5.6 0 0 0 0 180" movability="fixed" graspable="false">
      <shape kind="drawer_unit" width_m="0.6" drawer_count="3" depth_m="0.58" height_m="0.88"/>
      <part id="drawers-body"/>
      <part id="drawers-drawer_0" parent="drawers-body"/>
      <part id="drawers-drawer_1" parent="drawers-body"/>
      <part id="drawers-drawer_2" parent="drawers-body"/>
      <joint id="drawers-drawer_0-joint" type="prismatic" parent="drawers-body" child="drawers-drawer_0" origin="0.29 0 0.725 0 0 0"
             axis="1 0 0" lower_m="0" upper_m="0.43" value_m="0"/>
      <joint id="drawers-drawer_1-joint" type="prismatic" parent="drawers-body" child="drawers-drawer_1" origin="0.29 0 0.475 0 0 0"
             axis="1 0 0" lower_m="0" upper_m="0.43" value_m="0.1"/>
      <joint id="drawers-drawer_2-joint" type="prismatic" parent="drawers-body" child="drawers-drawer_2" origin="0.29 0 0.225 0 0 0"
             axis="1 0 0" lower_m="0" upper_m="0.43" value_m="0"/>
      <parkingPose pose="1 0 0 0 0 180" default="true"/>
    </largeArticulatedObject>
    <largeObject id="block" type="box" pose="3 0 0 0 0 0" movability="movable" graspable="false">
      <shape kind="box" width_m="0.4" depth_m="0.4" height_m="0.6"/>
      <parkingPose pose="1 0 0 0 0 180" default="true"/>
    </largeObject>
    <smallObject id="ball" type="box" parent="study" relation="on" pose="3.5 1 0 0 0 0" graspable="false">
      <defaultPlace parent="study" relation="on" pose="3.5 1 0 0 0 0"/>
      <shape kind="box" width_m="0.1" depth_m="0.1" height_m="0.1"/>
    </smallObject>
  </room>
</apartment>
)";
}

semantic::Home smallHome() {
  return semantic::getHome(semantic::readHomeText(smallHomeXml(), "small home"), "small home");
}

const semantic::LargeObject& pieceOf(const semantic::Home& home, const std::string& id) {
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (object.id.value == id) {
        return object;
      }
    }
  }
  throw std::runtime_error("no piece " + id);
}

const semantic::Joint& jointOf(const semantic::Home& home, const std::string& id) {
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (!object.articulation) {
        continue;
      }
      for (const semantic::Joint& joint : object.articulation->joints) {
        if (joint.id.value == id) {
          return joint;
        }
      }
    }
  }
  throw std::runtime_error("no joint " + id);
}

const semantic::SmallObject* findSmall(const semantic::Home& home, const std::string& id) {
  const auto findIn = [&](const std::vector<semantic::SmallObject>& list) -> const semantic::SmallObject* {
    for (const semantic::SmallObject& small : list) {
      if (small.id.value == id) {
        return &small;
      }
    }
    return nullptr;
  };
  for (const semantic::Room& room : home.rooms) {
    if (const auto* const small = findIn(room.small_objects)) {
      return small;
    }
    for (const semantic::LargeObject& object : room.objects) {
      if (const auto* const small = findIn(object.small_objects)) {
        return small;
      }
    }
  }
  return nullptr;
}

}  // namespace oikos::simulate
