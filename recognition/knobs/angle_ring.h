// SPDX-License-Identifier: Apache-2.0
// How a knob looks from one tilt in all its angles, whatever the light and the colours: its own renders as linear bases, or one photograph.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recognition/knobs/face_patch.h"
#include "recognition/knobs/knob.h"

namespace oikos::recognition {

struct RingWindow;
struct TemplateImages;

struct RingShape {
  int radius_px = 14;           ///< of the knob's face in a template
  int angles = 72;              ///< evenly all around
  float carrier_weight = 0.1F;  ///< how much pixels beside the knob count
};

/// What a photograph shows of a knob that is turned by an angle.
struct FacePhoto {
  const cv::Mat& color;  ///< CV_8UC3
  const camera::PinholeCamera& camera;
  FaceView view;  ///< of its face
  double angle_rad = 0.0;
};

/// The templates of a knob under one tilt, all on the pixels of one window (S252: what tells the angle is where its materials are).
///
/// Under distant light a matt surface has the brightness albedo * (a + b · normal) (Basri & Jacobs, "Lambertian reflectance and linear
/// subspaces", PAMI 2003, doi:10.1109/TPAMI.2003.1177153). So the picture of a knob at one angle lies in the span of a few images that its
/// shape and the borders of its materials tell: for each material its mask, and the mask times each component of the normal. Neither lamps
/// nor colours need be known. A template is an orthonormal basis of that span; a picture belongs to the angle whose basis leaves the least
/// of it over. Immutable, so thread-safe.
///
/// Of a photograph materials are told by their colours, normals not at all: the knob is taken for a cylinder whose face is flat, and the
/// span is that of the masks of the face's main colours, turned on the face's plane, of the sides and of the carrier.
class AngleRing {
 public:
  AngleRing(const KnobDescription& knob, const KnobFace& face, double tilt_rad, const RingShape& shape);
  AngleRing(const FacePhoto& photo, const KnobFace& face, double tilt_rad, const RingShape& shape);

  /// Of the window, and the pixel of it where the face's middle is.
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int originColumn() const { return origin_column_; }
  [[nodiscard]] int originRow() const { return origin_row_; }
  [[nodiscard]] const RingShape& shape() const { return shape_; }

  /// Indices (row * columns + column) of the pixels that a knob covers at any angle, or its rim.
  [[nodiscard]] const std::vector<int>& support() const { return support_; }
  /// How much each pixel counts, a row a template; their geometric mean is 1, so that residuals can be compared between templates.
  [[nodiscard]] const Eigen::MatrixXf& weights() const { return weights_; }
  /// The bases one below the other, a row a vector times the root of the weights, a column a pixel of the support; template i has rows
  /// firstRow()[i] to firstRow()[i + 1]. The first of them is the constant. It shows the knob turned by -2 pi i / angles, seen from azimuth
  /// 0, which is what it looks like at angle 0 from azimuth 2 pi i / angles.
  [[nodiscard]] const Eigen::MatrixXf& bases() const { return bases_; }
  [[nodiscard]] const std::vector<int>& firstRow() const { return first_row_; }

 private:
  void build(const RingWindow& window, const std::vector<TemplateImages>& templates);

  RingShape shape_;
  int columns_ = 0;
  int rows_ = 0;
  int origin_column_ = 0;
  int origin_row_ = 0;
  std::vector<int> support_;
  std::vector<int> first_row_;
  Eigen::MatrixXf weights_;
  Eigen::MatrixXf bases_;
};

}  // namespace oikos::recognition
