// SPDX-License-Identifier: Apache-2.0
// What a knob is set to, read from a colour picture of the appliance that carries it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "recognition/knobs/angle_fit.h"
#include "recognition/knobs/knob_detector.h"
#include "recognition/knobs/state_belief.h"

namespace oikos::recognition {

struct KnobReaderConfig {
  DetectorConfig detector;
  double max_tilt_deg = 60.0;           ///< steeper views are not read (S363)
  double min_diameter_px = 16.0;        ///< nor smaller knobs
  double registration_sigma_m = 0.005;  ///< how far a knob is from where it is believed, each way
  int max_proposals = 3;                ///< of the detector, the best, compared with the knob's own render as the believed place is
  double min_score = -1.0;              ///< of detector and fit together: less is no knob
  double max_unexplained = 0.75;        ///< of the picture's variation by the best template: more is no such knob
  double evidence_share = 0.1;          ///< independent pixels / pixels of the knob
  double max_evidence = 45.0;           ///< light, colours and shape are modelled no better than that, however large the picture
  double detent_sigma_deg = 3.0;        ///< how far a knob rests from the angle of its state
  double between_share = 0.02;          ///< prior probability that it is in none
  double min_state_probability = 0.9;   ///< of a state that is told

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("detector", detector);
    visitor("max_tilt_deg", max_tilt_deg);
    visitor("min_diameter_px", min_diameter_px);
    visitor("registration_sigma_m", registration_sigma_m);
    visitor("max_proposals", max_proposals);
    visitor("min_score", min_score);
    visitor("max_unexplained", max_unexplained);
    visitor("evidence_share", evidence_share);
    visitor("max_evidence", max_evidence);
    visitor("detent_sigma_deg", detent_sigma_deg);
    visitor("between_share", between_share);
    visitor("min_state_probability", min_state_probability);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class KnobStatus {
  kNotInView,   ///< behind the camera or out of the picture, seen from the side or from behind, or too small
  kNotFound,    ///< no knob is where it should be: hidden, blurred, or taken off
  kCannotTell,  ///< there is one, but it fits none of its states, or several
  kRead,
};
constexpr auto enumTable(KnobStatus) {
  return std::to_array<base::EnumName<KnobStatus>>({{KnobStatus::kNotInView, "not in view"},
                                                    {KnobStatus::kNotFound, "not found"},
                                                    {KnobStatus::kCannotTell, "can't tell"},
                                                    {KnobStatus::kRead, "read"}});
}

struct [[nodiscard]] KnobReading {
  KnobStatus status = KnobStatus::kNotInView;
  std::string reason;                ///< for a person; empty if read
  std::optional<std::size_t> state;  ///< the likeliest, an index into the knob's states; also if the status is kCannotTell
  double probability = 0.0;          ///< of that state
  std::vector<double> state_probabilities;
  double angle_rad = 0.0;  ///< as measured, not snapped to a state; [0, 2 pi)
  double sigma_rad = 0.0;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  ///< of the knob's face in the picture
  double diameter_px = 0.0;                             ///< its longer axis
  double detector_score = 0.0;
  double unexplained = 1.0;  ///< by the best template
};

/// A picture and where the part that carries the knob is believed to be.
struct KnobPicture {
  cv::Mat color;  ///< CV_8UC3, BGR, free of lens distortion
  camera::PinholeCamera camera;
  Eigen::Isometry3d T_camera_part = Eigen::Isometry3d::Identity();
};

/// One photograph of a knob as it is installed, set to an angle that is known: the templates are then made of it, and the knob's mesh need
/// tell nothing but its radius and height. Best from the front (15 degrees of tilt at most), 80 px and more across; where its middle is
/// believed by `picture` is where it is turned about. Read so, states are far less certain than by a mesh that shows the mark, and less
/// than their probabilities say (docs/benchmarks.md).
struct KnobPhoto {
  KnobPicture picture;
  double angle_rad = 0.0;
};

/// Reads one knob. Templates are rendered when a tilt is met for the first time and kept (some 0.2 s and 4 MB for each 5 degrees of
/// tilt). Not thread-safe.
class KnobReader {
 public:
  /// Throws Error{kInput} for a knob without a mesh or without extent, and for a photograph that cannot be read from, with the reason.
  KnobReader(KnobDescription knob, const KnobReaderConfig& config, DetectorModel detector = shippedDetector(),
             std::optional<KnobPhoto> photo = {});

  KnobReading read(const KnobPicture& picture);

  /// All that look like this knob about where it should be: proposed by the detector, confirmed by its own render; the best first.
  struct Found {
    AngleFit fit;
    KnobDetection detection;
    double unexplained = 1.0;   ///< by the best template
    double score = 0.0;         ///< the detector's and the fit's together
    double distinctness = 0.0;  ///< logarithm of how much more the median template leaves unexplained: what has no mark has none
  };
  [[nodiscard]] std::vector<Found> find(const KnobPicture& picture, const FaceView& view);

  [[nodiscard]] const KnobDescription& knob() const { return knob_; }
  [[nodiscard]] const KnobFace& face() const { return face_; }

 private:
  [[nodiscard]] FaceView viewOf(const KnobPicture& picture) const;
  [[nodiscard]] AngleRing ringOf(double tilt_rad, const RingShape& shape) const;
  const RingPair& ringsOf(double tilt_rad);
  [[nodiscard]] std::vector<KnobDetection> propose(const FaceImage& image) const;
  void readAngle(const AngleFit& fit, const FaceView& view, KnobReading& reading) const;

  KnobDescription knob_;
  KnobFace face_;
  KnobReaderConfig config_;
  DetectorModel detector_;
  std::optional<KnobPhoto> photo_;
  std::map<int, RingPair> rings_;  ///< by tilt, in steps of kTiltStep
};

}  // namespace oikos::recognition
