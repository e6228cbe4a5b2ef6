// SPDX-License-Identifier: Apache-2.0
// Knobs over a recording (S241-S257): which frames show them, and what they are set to there.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "recognition/knobs/knob_reader.h"
#include "registration/articulated/articulated_registration.h"
#include "semantic/model/home.h"
#include "tracking/localisation/localiser.h"
#include "tracking/state/articulated_pieces.h"
#include "tracking/state/knob_stays.h"
#include "tracking/state/knob_track_config.h"
#include "tracking/state/piece_views.h"

namespace oikos::tracking {

/// What a recording says of a knob.
struct TrackedKnob {
  semantic::ObjectId piece;
  semantic::KnobId id;
  std::vector<std::string> states;
  std::vector<KnobStay> stays;  ///< in the order of time; empty: no image shows it
  int images = 0;               ///< that were read,
  std::string reason;           ///< and why the last of them does not show it; empty: it does
};

/// A frame that is to be read, and the pieces that it shows knobs of.
struct WantedKnobs {
  int frame = 0;            ///< of the recording
  std::vector<int> pieces;  ///< ascending
};

/// Not thread-safe; uses `threads` threads inside, on which the result does not depend.
class KnobWatch {
 public:
  /// Knobs that no joint turns and those without a mesh are passed over: nobody knows what they look like. `pieces` outlive it.
  /// Throws ContractViolation for a configuration that is not valid.
  KnobWatch(const std::vector<ArticulatedPiece>& pieces, const camera::PinholeCamera& camera, const KnobTrackConfig& config,
            const FrameChoiceConfig& frames, int threads);
  ~KnobWatch();
  KnobWatch(const KnobWatch&) = delete;
  KnobWatch& operator=(const KnobWatch&) = delete;

  /// Every frame in the order of time, and where it was. `depth_m` is needed.
  void look(const camera::RgbdFrame& frame, const LocatedPose& pose);

  /// After all of look(): what is to be read next, in the order of time; again and again until there is nothing.
  [[nodiscard]] std::vector<WantedKnobs> wanted();

  /// Reads the knobs of one piece in a frame that was wanted. `color` is needed. `standing`: the piece, registered in this frame.
  void read(const camera::RgbdFrame& frame, const Eigen::Isometry3d& T_map_camera, int piece, const registration::Standing& standing);

  /// Knobs that no frame shows are left out.
  [[nodiscard]] std::vector<TrackedKnob> conclude() const;

 private:
  struct Watched;
  struct Look;
  [[nodiscard]] std::optional<double> worthOf(const Watched& knob, const camera::RgbdFrame& frame,
                                              const Eigen::Isometry3d& T_map_camera) const;
  void addKnobs(int piece);
  [[nodiscard]] std::set<int> firstOf(int knob) const;
  [[nodiscard]] std::set<int> furtherOf(int knob) const;

  const std::vector<ArticulatedPiece>& pieces_;
  camera::PinholeCamera camera_;
  KnobTrackConfig config_;
  FrameChoiceConfig frame_choice_;
  int threads_;
  std::vector<Watched> knobs_;
  std::vector<std::unique_ptr<Look>> looks_;  ///< knobs that look the same share one
  std::vector<SeenFrame> frames_;             ///< their sights are of knobs
  int rounds_ = 0;
};

}  // namespace oikos::tracking
