// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/carcass.h"

#include <algorithm>

namespace oikos::model {

Eigen::AlignedBox3d addCarcass(FurnitureBuilder& builder, const Carcass& carcass) {
  const Eigen::Vector3d low = carcass.outer_model.min();
  const Eigen::Vector3d high = carcass.outer_model.max();
  const double board_m = carcass.board_m;
  const Eigen::AlignedBox3d hollow = boxOf({low.x() + carcass.back_m, high.x()}, {low.y() + board_m, high.y() - board_m},
                                           {low.z() + board_m, carcass.has_top ? high.z() - board_m : high.z()});
  const Span depth = {low.x(), high.x()};
  const Span inner_width = {hollow.min().y(), hollow.max().y()};
  builder.addBox(0, boxOf(depth, {low.y(), low.y() + board_m}, {low.z(), high.z()}), carcass.finish);
  builder.addBox(0, boxOf(depth, {high.y() - board_m, high.y()}, {low.z(), high.z()}), carcass.finish);
  builder.addBox(0, boxOf(depth, inner_width, {low.z(), low.z() + board_m}), carcass.finish);
  if (carcass.has_top) {
    builder.addBox(0, boxOf(depth, inner_width, {high.z() - board_m, high.z()}), carcass.finish);
  }
  builder.addBox(0, boxOf({low.x(), hollow.min().x()}, inner_width, {hollow.min().z(), hollow.max().z()}), carcass.finish);
  const double room_m = (hollow.sizes().z() - carcass.shelf_count * carcass.shelf_m) / (carcass.shelf_count + 1);
  for (int i = 1; i <= carcass.shelf_count; ++i) {
    const double bottom = hollow.min().z() + i * room_m + (i - 1) * carcass.shelf_m;
    builder.addBox(0, boxOf({hollow.min().x(), high.x() - carcass.shelf_set_back_m}, inner_width, {bottom, bottom + carcass.shelf_m}),
                   carcass.shelf_finish);
  }
  return hollow;
}

void addPlinth(FurnitureBuilder& builder, const Eigen::AlignedBox3d& outer_model, double board_m, const Finish& finish) {
  const Eigen::Vector3d low = outer_model.min();
  const Eigen::Vector3d high = outer_model.max();
  if (high.z() <= low.z()) {
    return;
  }
  const double front = high.x() - std::min(0.05, 0.2 * outer_model.sizes().x());
  const Span height = {low.z(), high.z()};
  builder.addBox(0, boxOf({front - board_m, front}, {low.y(), high.y()}, height), finish);
  builder.addBox(0, boxOf({low.x(), front - board_m}, {low.y(), low.y() + board_m}, height), finish);
  builder.addBox(0, boxOf({low.x(), front - board_m}, {high.y() - board_m, high.y()}, height), finish);
}

}  // namespace oikos::model
