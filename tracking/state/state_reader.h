// SPDX-License-Identifier: Apache-2.0
// Doors and drawers over a recording: its frames are located and looked at once, then those that tell most are registered.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "registration/articulated/joint_fusion.h"
#include "semantic/model/home.h"
#include "tracking/localisation/localiser.h"
#include "tracking/state/articulated_pieces.h"
#include "tracking/state/piece_handles.h"
#include "tracking/state/piece_surroundings.h"
#include "tracking/state/piece_track.h"
#include "tracking/state/piece_views.h"
#include "tracking/state/state_config.h"

namespace oikos::tracking {

/// What a recording says of a joint.
struct JointReading {
  semantic::JointId id;
  semantic::JointType type = semantic::JointType::kRevolute;
  std::vector<JointStay> stays;                        ///< in the order of time; empty: no image sees it
  std::vector<registration::JointSighting> sightings;  ///< what each image of the piece says, in the order of time,
  std::vector<int> frames;                             ///< and which frame of the recording that is
};

/// What a recording says of a piece.
struct PieceReading {
  semantic::ObjectId id;
  int frames_in_view = 0;
  int images = 0;     ///< that were registered,
  int in_place = 0;   ///< of these, that show it about where it is believed to be, most of its readings being of it,
  int not_there = 0;  ///< and that do not show it there; the others cannot tell
  std::vector<JointReading> joints;
  std::vector<HandleReading> handles;
};

/// Not thread-safe; uses `threads` threads inside, on which the result does not depend.
class StateReader {
 public:
  /// `home`: as it is believed at the recording's time. `only`: one piece. Throws as articulatedPieces(), ContractViolation for a
  /// configuration that is not valid.
  StateReader(const semantic::Home& home, const std::filesystem::path& home_folder, const camera::PinholeCamera& camera,
              const StateConfig& config, int threads, const std::string& only = {});
  ~StateReader();
  StateReader(const StateReader&) = delete;
  StateReader& operator=(const StateReader&) = delete;

  /// Every frame in the order of time, and where it was; one that was not found is passed over. `depth_m` is needed. What is kept of a
  /// frame is its pose.
  void look(const camera::RgbdFrame& frame, const LocatedPose& pose);

  /// After all of look(): the frames of the recording to be read next, ascending; again and again until there is none.
  [[nodiscard]] std::vector<int> wanted();
  /// A better pose of one of those.
  void place(int frame, const LocatedPose& pose);
  /// Some of those. They share the threads.
  void read(const std::vector<camera::RgbdFrame>& frames);

  /// Where a piece stands in a frame that was looked at and found: registered in it, now if it was not read before. Nothing: it is not
  /// where it is believed to be.
  [[nodiscard]] std::optional<registration::Standing> standingIn(const camera::RgbdFrame& frame, int piece);

  /// Pieces that no frame sees are left out.
  [[nodiscard]] std::vector<PieceReading> conclude() const;
  [[nodiscard]] const std::vector<ArticulatedPiece>& pieces() const { return pieces_; }
  /// Every frame that was looked at and found, in the order of time.
  [[nodiscard]] const std::vector<SeenFrame>& frames() const { return frames_; }
  /// Where a frame was; it was looked at and found.
  [[nodiscard]] const SeenFrame& seen(int frame) const;

 private:
  void chooseFirst();
  void halve();
  void registerIn(std::size_t piece, const SeenFrame& frame, const registration::Scan& scan, const cv::Mat& depth_m);
  [[nodiscard]] registration::ImageContext contextOf(const SeenFrame& frame, const ArticulatedPiece& piece) const;

  camera::PinholeCamera camera_;
  StateConfig config_;
  int threads_;
  std::vector<ArticulatedPiece> pieces_;
  HomeSurroundings surroundings_;
  std::vector<SeenFrame> frames_;
  std::vector<std::unique_ptr<PieceTrack>> tracks_;  ///< by piece
  bool has_chosen_ = false;
  int halvings_ = 0;
};

}  // namespace oikos::tracking
