// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/camera/sensor/hash_noise.h"

namespace oikos::camera {

/// Standard normal noise over an image that is smooth over a few pixels: numbers on a square lattice, interpolated between and divided by
/// the deviation that interpolation leaves, so that every pixel has variance 1. The lattice lies elsewhere in each frame. Immutable, so
/// thread-safe.
class NoiseField {
 public:
  struct Shape {
    int width = 0;
    int height = 0;
    int spacing_px = 1;  ///< of the lattice; 1: each pixel for itself
  };
  NoiseField(const NoiseStream& stream, const Shape& shape, int threads);

  /// Writes the `width` numbers of row v.
  void fillRow(int v, float* row) const;

 private:
  Shape shape_;
  int shift_u_ = 0;  ///< of the lattice against the image, in [0, spacing)
  int shift_v_ = 0;
  int columns_ = 0;
  std::vector<float> lattice_;       ///< row-major
  std::vector<float> weight_left_;   ///< of the left (upper) lattice point, by the pixel's place in the cell
  std::vector<float> weight_right_;  ///< of the right (lower) one
};

}  // namespace oikos::camera
