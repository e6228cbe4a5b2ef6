// SPDX-License-Identifier: Apache-2.0
// What is known of one piece while a recording is read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "core/render/scene.h"
#include "registration/articulated/articulated_registration.h"
#include "registration/articulated/joint_fusion.h"
#include "registration/scan.h"
#include "tracking/state/piece_handles.h"
#include "tracking/state/piece_views.h"

namespace oikos::tracking {

/// A time in which a joint stood still.
struct JointStay {
  registration::JointSpan span;  ///< its indices are those of the joint's images
  std::int64_t first_ns = 0;     ///< of the first image that has found it by itself; if none has: of the first that may show it
  int first_frame = 0;           ///< that image, of the recording
  int images = 0;
  int found = 0;                ///< of these, images that have found it by themselves
  int best_frame = 0;           ///< that shows most of the part,
  registration::PixelBox crop;  ///< and where the piece is in it

  [[nodiscard]] bool isFound() const { return span.status == registration::JointStatus::kFound; }
};

/// One piece in one frame, registered.
struct PieceShot {
  int index = 0;  ///< of the frames that were looked at
  registration::BaseStatus base = registration::BaseStatus::kNotInView;
  bool is_in_place = false;  ///< it is registered, and most readings of it are
  registration::Standing standing;
  std::vector<registration::JointEstimate> joints;  ///< as many in each
};

/// The images of one piece. `frames`: all that were looked at; `joint`: index into a shot's.
struct PieceTrack {
  std::unique_ptr<registration::ArticulatedRegistration> registration;  ///< from the first image on,
  std::unique_ptr<render::Scene> about;                                 ///< this, too,
  std::unique_ptr<PieceHandles> handles;                                ///< and this
  std::set<int> wanted;                                                 ///< indices of the frames
  std::vector<PieceShot> shots;                                         ///< in the order of time
  int frames_in_view = 0;

  [[nodiscard]] const PieceShot* find(int index) const;
  void insert(PieceShot shot);
  /// Of the shots.
  [[nodiscard]] std::vector<int> indices() const;
  /// Unless it was read.
  void want(std::optional<int> index);

  /// What each shot says of a joint.
  [[nodiscard]] std::vector<registration::JointSighting> sightings(std::size_t joint, const std::vector<SeenFrame>& frames) const;
  /// By joint: the times in which each stood still. Of one image alone, what that says: there is nothing to hold it against.
  [[nodiscard]] std::vector<std::vector<registration::JointSpan>> spans(const std::vector<SeenFrame>& frames,
                                                                        const registration::JointFusionConfig& config) const;
  /// Frames to be read next, to find the moment between two spans, the second following the first: nearer to the last image that shows the
  /// joint where it was, and to the first that shows it gone. Of images between them that cannot tell, none is read twice.
  void wantMoment(const registration::JointSpan& before, const registration::JointSpan& after, std::size_t joint, int piece,
                  const std::vector<SeenFrame>& frames, const registration::JointFusionConfig& config);
  [[nodiscard]] int foundIn(const registration::JointSpan& span, std::size_t joint) const;
  /// The first image of the span that has found the joint; one has.
  [[nodiscard]] std::size_t witnessOf(const registration::JointSpan& span, std::size_t joint) const;
  /// Images that have found the joint elsewhere than their span has it: misreadings, or a stay that was too short for the images read.
  [[nodiscard]] std::vector<std::size_t> dissenters(const registration::JointSpan& span, std::size_t joint,
                                                    const registration::JointDecisionConfig& config) const;
  /// Images read within half a second of this one, itself included.
  [[nodiscard]] int readAbout(std::size_t shot, const std::vector<SeenFrame>& frames) const;
  /// Without its crop.
  [[nodiscard]] JointStay stayOf(const registration::JointSpan& span, std::size_t joint, const std::vector<SeenFrame>& frames) const;

 private:
  [[nodiscard]] std::vector<registration::JointSpan> loneSpan(std::size_t joint, const std::vector<SeenFrame>& frames) const;
};

}  // namespace oikos::tracking
