// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/handle_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>

#include "core/base/error.h"
#include "registration/handles/grip_search.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDiscAsSquare = 0.886;  // half the side of the square that has a disc's area, of the disc's radius
constexpr double kUntold = 0.7;          // of the prior's deviation: what is told no better comes from the prior

GripBelief beliefOf(const model::ModelHandle& handle, const GripConfig& config) {
  GripBelief belief;
  belief.is_knob = handle.kind == model::HandleKind::kKnob;
  const double half_m = 0.5 * handle.length_m.value_or(belief.is_knob ? config.knob_width_m : config.bar_length_m);
  belief.half_length_m = belief.is_knob ? kDiscAsSquare * half_m : half_m;
  belief.half_width_m = belief.is_knob ? belief.half_length_m : config.bar_radius_m;
  return belief;
}

/// Nothing was found at the handle's place: why.
HandleStatus reasonFor(const GripReadings& grip, const FrontPlane& front, const GripConfig& config) {
  constexpr double kMostOutside = 0.5;
  if (!grip.faces_camera || grip.in_view < kMostOutside) {
    return HandleStatus::kNotInView;
  }
  if (grip.nearer > config.max_hidden * grip.shown || (!front.is_found && front.nearer > front.readings)) {
    return HandleStatus::kHidden;
  }
  if (!front.is_found) {
    return HandleStatus::kNoFront;
  }
  return grip.read < std::max<double>(config.min_readings, 0.2 * grip.shown) ? HandleStatus::kTooFewPoints : HandleStatus::kNotSeen;
}

/// One place for each handle, no two of them the same, so that all of them together are as likely as can be.
class Assignment {
 public:
  Assignment(const std::vector<std::vector<GripPlace>>& places, const std::vector<Eigen::Isometry3d>& T_front_handle, double apart_m)
      : places_(places), T_front_handle_(T_front_handle), apart_m_(apart_m), chosen_(places.size()), best_(places.size()) {
    choose(0, 0.0);
  }
  [[nodiscard]] const GripPlace* of(std::size_t handle) const { return best_[handle]; }

 private:
  [[nodiscard]] Eigen::Vector2d placeOf(std::size_t handle, const GripPlace& place) const {
    return (T_front_handle_[handle] * Eigen::Vector3d(0.0, place.bar.across_m, place.bar.along_m)).tail<2>();
  }

  void choose(std::size_t handle, double score) {
    if (handle == places_.size()) {
      if (score > best_score_) {
        best_score_ = score;
        best_ = chosen_;
      }
      return;
    }
    for (const GripPlace& place : places_[handle]) {
      bool is_free = true;
      for (std::size_t other = 0; other < handle; ++other) {
        is_free &= chosen_[other] == nullptr || (placeOf(other, *chosen_[other]) - placeOf(handle, place)).norm() >= apart_m_;
      }
      if (is_free) {
        chosen_[handle] = &place;
        choose(handle + 1, score + place.score);
      }
    }
    chosen_[handle] = nullptr;
    choose(handle + 1, score);
  }

  const std::vector<std::vector<GripPlace>>& places_;
  const std::vector<Eigen::Isometry3d>& T_front_handle_;
  double apart_m_;
  std::vector<const GripPlace*> chosen_;
  std::vector<const GripPlace*> best_;
  double best_score_ = -1.0;
};

/// The grip's height before its front, by what stands out: of a bar the visible side, of a knob its end.
BarVector heightWeights(bool is_knob) {
  BarVector weights = BarVector::Zero();
  weights[3] = is_knob ? 0.5 : 1.0;
  weights[4] = 1.0;  // the front's own, below the handle
  weights[6] = is_knob ? 0.0 : -kSeenOfBar;
  return weights;
}

/// A handle on its front, before what the image says of the handle itself.
struct GripOnFront {
  const GripBelief& belief;
  const FrontPlane& front;
  Eigen::Isometry3d T_camera_handle = Eigen::Isometry3d::Identity();  ///< as believed, on the front as it was found
  double front_variance = 0.0;                                        ///< of the front along its normal, below the handle (m^2)
  Eigen::Matrix2d tilt_covariance = Eigen::Matrix2d::Zero();          ///< about the handle's y and z

  GripOnFront(const GripBelief& of_belief, const FrontPlane& on_front, const FrontPlaneConfig& config)
      : belief(of_belief), front(on_front), T_camera_handle(on_front.T_camera_front * of_belief.T_front_handle) {
    const double tilt = config.tilt_sigma_deg * kDegree;
    const Eigen::Vector3d J(1.0, belief.T_front_handle.translation().y(), belief.T_front_handle.translation().z());
    front_variance = front.is_found ? J.dot(front.covariance * J) : config.place_sigma_m * config.place_sigma_m;
    Eigen::Matrix2d about_front = tilt * tilt * Eigen::Matrix2d::Identity();
    if (front.is_found) {  // a slope along z turns about y, one along y turns back about z
      about_front << front.covariance(2, 2), -front.covariance(1, 2), -front.covariance(1, 2), front.covariance(1, 1);
    }
    const Eigen::Matrix2d R = belief.T_front_handle.linear().bottomRightCorner<2, 2>();
    tilt_covariance = R.transpose() * about_front * R;
  }
};

/// Its place and covariances as nothing but the front says them.
void putOnFront(const GripOnFront& on, const HandleConfig& config, HandleEstimate& estimate) {
  const GripConfig& grip = config.grip;
  const double place = grip.place_sigma_m * grip.place_sigma_m;
  const double roll = grip.roll_sigma_deg * kDegree;
  estimate.covariance.setZero();
  estimate.covariance.diagonal() << on.front_variance + grip.height_sigma_m * grip.height_sigma_m, place, place, roll * roll, 0.0, 0.0;
  estimate.covariance.bottomRightCorner<2, 2>() = on.tilt_covariance;
  estimate.shared.diagonal() = estimate.covariance.diagonal();
}

/// What is left of a prior's deviation in an estimate of this variance, and is the same in every image.
double sharedOf(double variance, double prior_sigma, double floor) {
  const double share = std::min(1.0, variance / (prior_sigma * prior_sigma));
  return share * share * prior_sigma * prior_sigma + floor * floor;
}

/// How much farther a handle stands out than believed, from what is seen of it and from the belief.
struct HeightFusion {
  double rise_m = 0.0;
  double variance = 0.0;
  double shared = 0.0;  ///< of this, what is the same in every image: belief and mixture

  HeightFusion(double seen_m, double seen_variance, double mixture_sigma_m, double prior_sigma_m) {
    const double prior = prior_sigma_m * prior_sigma_m;
    const double seen = seen_variance + mixture_sigma_m * mixture_sigma_m;
    const double share = prior / (prior + seen);
    rise_m = share * seen_m;
    variance = share * seen;
    shared = variance - share * share * seen_variance;
  }
};

/// T_handle_found: from the believed handle to where it stands out. The height that was found moves it along the camera's ray.
Eigen::Isometry3d putAtPlace(const GripOnFront& on, const GripPlace& place, const HandleConfig& config, HandleEstimate& estimate) {
  const GripConfig& grip = config.grip;
  const BarVector weights = heightWeights(on.belief.is_knob);
  const Eigen::Isometry3d T_handle_seen = on.belief.T_handle_seen();
  const Eigen::Vector3d met(0.0, place.bar.across_m, place.bar.along_m);
  const Eigen::Vector3d eye_seen = (on.T_camera_handle * T_handle_seen).inverse().translation();
  const Eigen::Vector3d per_rise = (met - eye_seen) / (met - eye_seen).x();
  const HeightFusion height(weights.dot(place.bar.vector()) - on.belief.height_m(), weights.dot(place.covariance * weights),
                            grip.mixture_sigma_m * eye_seen.squaredNorm(), grip.height_sigma_m);
  Eigen::Matrix<double, 4, 8> J = Eigen::Matrix<double, 4, 8>::Zero();
  J(1, 1) += 1.0;
  J(2, 0) += 1.0;
  J(3, 2) = 1.0;
  estimate.covariance.topLeftCorner<4, 4>() = J * place.covariance * J.transpose();
  estimate.covariance.topLeftCorner<3, 3>() += (on.front_variance + height.variance) * per_rise * per_rise.transpose();
  estimate.covariance.diagonal().head<3>().array() += grip.floor_m * grip.floor_m;
  const double floor = config.front.floor_deg * kDegree;
  const double height_shared = height.shared + config.front.floor_m * config.front.floor_m;
  estimate.shared.diagonal() << height_shared,
      sharedOf(place.covariance(1, 1), grip.place_sigma_m, grip.floor_m) + height_shared * per_rise.y() * per_rise.y(),
      sharedOf(place.covariance(0, 0), grip.place_sigma_m, grip.floor_m) + height_shared * per_rise.z() * per_rise.z(),
      sharedOf(place.covariance(2, 2), grip.roll_sigma_deg * kDegree, 0.0), floor * floor, floor * floor;
  const bool is_told = std::sqrt(std::max(place.covariance(0, 0), place.covariance(1, 1))) < kUntold * grip.place_sigma_m;
  estimate.status = is_told ? HandleStatus::kFound : HandleStatus::kPartly;
  const double per_half = on.belief.is_knob ? 2.0 / kDiscAsSquare : 2.0;
  estimate.length_m = per_half * place.bar.half_length_m;
  estimate.length_sigma_m = per_half * std::sqrt(place.covariance(5, 5));
  estimate.gain = place.gain;
  estimate.points = place.readings;
  Eigen::Isometry3d T_handle_found = Eigen::Isometry3d::Identity();
  T_handle_found.translate(met + height.rise_m * per_rise).rotate(Eigen::AngleAxisd(place.bar.roll_rad, Eigen::Vector3d::UnitX()));
  return T_handle_found;
}

}  // namespace

std::vector<std::string> HandleConfig::validate() const {
  std::vector<std::string> messages;
  for (const std::string& message : front.validate()) {
    messages.push_back("front." + message);
  }
  for (const std::string& message : grip.validate()) {
    messages.push_back("grip." + message);
  }
  return messages;
}

HandleFinder::HandleFinder(const model::ArticulatedModel& model, const HandleConfig& config) : config_(config), handles_(model.handles) {
  OIKOS_CHECK(config.validate().empty());
  (void)model::Kinematics(model);
  faces_ = frontFaces(model, config.grip.max_reach_m);
  for (const model::ModelHandle& handle : handles_) {
    beliefs_.push_back(beliefOf(handle, config.grip));
  }
  for (const FrontFace& face : faces_) {
    for (const FrontHandle& on : face.handles) {
      beliefs_[static_cast<std::size_t>(on.handle)].T_front_handle = on.T_front_handle;
    }
  }
}

HandleEstimate HandleFinder::believed(int handle, const Eigen::Isometry3d& T_map_part) const {
  const model::ModelHandle& of = handles_[static_cast<std::size_t>(handle)];
  HandleEstimate estimate;
  estimate.handle = handle;
  estimate.name = of.name;
  estimate.status = of.kind == model::HandleKind::kRecessed ? HandleStatus::kRecessed : HandleStatus::kNoFront;
  estimate.T_part_handle = of.T_part_handle;
  estimate.T_map_handle = T_map_part * of.T_part_handle;
  const GripConfig& grip = config_.grip;
  estimate.length_m = of.length_m.value_or(of.kind == model::HandleKind::kKnob ? grip.knob_width_m : grip.bar_length_m);
  estimate.length_sigma_m = grip.length_sigma_m;
  putOnFront({beliefs_[static_cast<std::size_t>(handle)], FrontPlane(), config_.front}, config_, estimate);
  return estimate;
}

std::vector<HandleEstimate> HandleFinder::find(const DepthView& view, int part, const Eigen::Isometry3d& T_map_part) const {
  OIKOS_CHECK(view.depth_m.type() == CV_32FC1 && view.depth_m.cols == view.camera.width && view.depth_m.rows == view.camera.height);
  std::vector<HandleEstimate> found;
  for (int handle = 0; handle < static_cast<int>(handles_.size()); ++handle) {
    if (handles_[static_cast<std::size_t>(handle)].part == part) {
      found.push_back(believed(handle, T_map_part));
    }
  }
  for (const FrontFace& face : faces_) {
    if (face.part == part) {
      findOn(face, view, T_map_part, found);
    }
  }
  return found;
}

void HandleFinder::findOn(const FrontFace& face, const DepthView& view, const Eigen::Isometry3d& T_map_part,
                          std::vector<HandleEstimate>& found) const {
  std::vector<Eigen::AlignedBox2d> boxes_front;
  std::vector<Eigen::Isometry3d> T_front_handle;
  for (const FrontHandle& on : face.handles) {
    boxes_front.push_back(beliefs_[static_cast<std::size_t>(on.handle)].box_front());
    T_front_handle.push_back(on.T_front_handle);
  }
  const Eigen::Isometry3d T_camera_front = view.T_map_camera.inverse() * T_map_part * face.T_part_front;
  const FrontPlane front = fitFrontPlane(face, boxes_front, view, T_camera_front, config_.front);
  std::vector<GripReadings> readings;
  std::vector<std::vector<GripPlace>> places;
  for (const FrontHandle& on : face.handles) {
    const GripBelief& belief = beliefs_[static_cast<std::size_t>(on.handle)];
    readings.push_back(readGrip(belief, front, view, config_.grip));
    const bool is_recessed = handles_[static_cast<std::size_t>(on.handle)].kind == model::HandleKind::kRecessed;
    const bool can_be_seen = !is_recessed && reasonFor(readings.back(), front, config_.grip) == HandleStatus::kNotSeen;
    places.push_back(can_be_seen ? searchGrip(belief, readings.back(), config_.grip) : std::vector<GripPlace>());
  }
  const Assignment assignment(places, T_front_handle, config_.grip.apart_m);
  for (std::size_t i = 0; i < face.handles.size(); ++i) {
    const int handle = face.handles[i].handle;
    HandleEstimate& estimate = *std::find_if(found.begin(), found.end(), [&](const HandleEstimate& e) { return e.handle == handle; });
    const GripOnFront on(beliefs_[static_cast<std::size_t>(handle)], front, config_.front);
    putOnFront(on, config_, estimate);
    estimate.front_points = front.readings;
    Eigen::Isometry3d T_handle_found = Eigen::Isometry3d::Identity();
    if (const GripPlace* const place = assignment.of(i)) {
      T_handle_found = putAtPlace(on, *place, config_, estimate);
    } else if (estimate.status != HandleStatus::kRecessed) {
      estimate.status = reasonFor(readings[i], front, config_.grip);
    }
    estimate.T_map_handle = view.T_map_camera * on.T_camera_handle * T_handle_found;
    estimate.evidence.T_part_believed = T_map_part.inverse() * view.T_map_camera * on.T_camera_handle;
    if (estimate.isSeen() || estimate.status == HandleStatus::kNotSeen) {
      estimate.evidence.places = evidenceOf(on.belief, readings[i], config_.grip);
    }
    estimate.T_part_handle = T_map_part.inverse() * estimate.T_map_handle;
  }
}

}  // namespace oikos::registration
