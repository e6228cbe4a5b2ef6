// SPDX-License-Identifier: Apache-2.0
// Value noise on a lattice that repeats (Perlin, "An Image Synthesizer", SIGGRAPH 1985), stretched, warped and mixed.
#include "tools/simulate/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tools/simulate/dice.h"

namespace oikos::simulate {

namespace {

int wrapped(int i, int period) {
  return ((i % period) + period) % period;
}

double smooth(double t) {
  return t * t * (3.0 - 2.0 * t);
}

/// Smooth between the numbers of a lattice of `periods` cells over the unit square, at whose borders it goes on at the other side.
class ValueNoise {
 public:
  ValueNoise(const Dice& dice, const cv::Size& periods, std::uint64_t use)
      : periods_(periods), stride_(static_cast<std::size_t>(periods.width) + 1) {
    for (int row = 0; row <= periods.height; ++row) {
      for (int column = 0; column <= periods.width; ++column) {
        lattice_.push_back(static_cast<float>(
            dice.at(static_cast<std::uint64_t>(column % periods.width), static_cast<std::uint64_t>(row % periods.height), use)));
      }
    }
  }

  /// In [0, 1]; x and y in [0, 1).
  [[nodiscard]] double at(double x, double y) const {
    const double column = x * periods_.width;
    const double row = y * periods_.height;
    const auto left = static_cast<std::size_t>(column);
    const auto top = static_cast<std::size_t>(row);
    const double u = smooth(column - static_cast<double>(left));
    const double v = smooth(row - static_cast<double>(top));
    const float* const upper = &lattice_[top * stride_ + left];
    const float* const lower = upper + stride_;
    const auto mix = [u](const float* numbers) {
      return (1.0 - u) * static_cast<double>(numbers[0]) + u * static_cast<double>(numbers[1]);
    };
    return (1.0 - v) * mix(upper) + v * mix(lower);
  }

 private:
  cv::Size periods_;
  std::size_t stride_;
  std::vector<float> lattice_;  ///< row by row, the first column and row once more at the end
};

/// Octaves of it, in [0, 1].
class FractalNoise {
 public:
  FractalNoise(const Dice& dice, const cv::Size& cells, std::uint64_t use) {
    cv::Size periods = cells;
    for (std::uint64_t octave = 0; octave < 4; ++octave) {
      octaves_.emplace_back(dice, periods, use * 16 + octave);
      periods *= 2;
    }
  }

  [[nodiscard]] double at(double x, double y) const {
    double sum = 0.0;
    double weight = 0.5;
    for (const ValueNoise& octave : octaves_) {
      sum += weight * octave.at(x, y);
      weight *= 0.5;
    }
    return sum / 0.9375;
  }

 private:
  std::vector<ValueNoise> octaves_;
};

template <class Shade>
cv::Mat paintShades(int size_px, const Shade& shade) {
  cv::Mat image(size_px, size_px, CV_8UC3);
  for (int v = 0; v < size_px; ++v) {
    for (int u = 0; u < size_px; ++u) {
      const double value = std::clamp(shade((u + 0.5) / size_px, (v + 0.5) / size_px), 0.0, 1.0);
      const auto byte = static_cast<std::uint8_t>(std::lround(255.0 * value));
      image.at<cv::Vec3b>(v, u) = {byte, byte, byte};
    }
  }
  return image;
}

/// Grain along x: rings that are cut lengthwise.
class Grain {
 public:
  Grain(const Dice& dice, std::uint64_t use) : bend_(dice, {2, 3}, use), fibre_(dice, {6, 96}, use + 1) {}

  [[nodiscard]] double at(double x, double y) const {
    const double ring = 0.5 + 0.5 * std::sin(2.0 * std::numbers::pi * (6.0 * y + 3.0 * bend_.at(x, y)));
    return 0.72 + 0.14 * ring + 0.2 * (fibre_.at(x, y) - 0.5);
  }

 private:
  FractalNoise bend_;
  FractalNoise fibre_;
};

cv::Mat paintPlanks(const Dice& dice, int size_px) {
  constexpr int kRows = 16;  // of eight metres
  std::vector<Grain> grain;
  for (std::uint64_t row = 0; row < kRows; ++row) {
    grain.emplace_back(dice, 100 + 2 * row);
  }
  const ValueNoise knots(dice, {80, 128}, 11);
  return paintShades(size_px, [&](double x, double y) {
    const int row = static_cast<int>(y * kRows);
    const double start = dice.at(static_cast<std::uint64_t>(row), 7);
    const double along = x * 4.0 + start;
    const auto plank = static_cast<std::uint64_t>(wrapped(static_cast<int>(std::floor(along)), 4));
    const double in_row = y * kRows - row;
    const double in_plank = along - std::floor(along);
    const bool is_gap = in_row < 0.02 || in_plank < 0.004;
    const double tone = 0.8 + 0.5 * (dice.at(static_cast<std::uint64_t>(row), plank, 8) - 0.5);
    const double knot = knots.at(x, y) > 0.94 ? 0.35 : 0.0;
    return is_gap ? 0.3 : tone * grain[static_cast<std::size_t>(row)].at(x, y) / 0.85 - knot;
  });
}

cv::Mat paintTiles(const Dice& dice, int size_px) {
  constexpr int kTiles = 24;
  const FractalNoise joints(dice, {40, 40}, 3);
  const FractalNoise clouds(dice, {10, 10}, 4);
  const FractalNoise veins(dice, {7, 7}, 5);
  return paintShades(size_px, [&](double x, double y) {
    const double in_x = x * kTiles - std::floor(x * kTiles);
    const double in_y = y * kTiles - std::floor(y * kTiles);
    if (std::min(in_x, in_y) < 0.03) {
      return 0.55 + 0.1 * joints.at(x, y);
    }
    const auto column = static_cast<std::uint64_t>(x * kTiles);
    const auto row = static_cast<std::uint64_t>(y * kTiles);
    const double off_x = std::abs(in_x - 0.5);
    const double off_y = std::abs(in_y - 0.5);
    const double turn = dice.at(column, row, 12);
    const bool has_ornament = dice.at(column, row, 13) < 0.45;
    const double ring = turn < 0.5 ? off_x + off_y : std::max(off_x, off_y) + 0.6 * off_x * off_y;
    const double ornament = has_ornament && std::abs(ring - 0.15 - 0.25 * turn) < 0.035 ? 0.35 : 0.0;
    const double cloud = clouds.at(x, y);
    const double vein = std::abs(veins.at(x, y) - 0.5) < 0.012 ? 0.2 : 0.0;
    return 0.82 + 0.14 * (dice.at(column, row, 6) - 0.5) + 0.18 * (cloud - 0.5) - vein - ornament;
  });
}

/// Leaves of one size, scattered about a lattice, each turned in its own way; over the borders they go on at the other side.
void drawLeaves(const Dice& dice, int cells, std::uint64_t use, cv::Mat& image) {
  const double cell_px = static_cast<double>(image.cols) / cells;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const auto number = [&](std::uint64_t i) { return dice.at(static_cast<std::uint64_t>(row * cells + column), use, i); };
      const double length_px = (0.18 + 0.25 * number(23)) * cell_px;
      const double turn_deg = 360.0 * number(22);
      const double shade = 255.0 * (0.55 + 0.3 * number(24));
      for (int shift = 0; shift < 9; ++shift) {
        const cv::Point middle(static_cast<int>((column + 0.2 + 0.6 * number(20)) * cell_px) + (shift % 3 - 1) * image.cols,
                               static_cast<int>((row + 0.2 + 0.6 * number(21)) * cell_px) + (shift / 3 - 1) * image.rows);
        const cv::Size axes(static_cast<int>(length_px), static_cast<int>(0.4 * length_px));
        cv::ellipse(image, middle, axes, turn_deg, 0.0, 360.0, cv::Scalar::all(shade), -1, cv::LINE_AA);
        cv::ellipse(image, middle, {axes.width, 1}, turn_deg, 0.0, 360.0, cv::Scalar::all(shade + 30.0), -1, cv::LINE_AA);
      }
    }
  }
}

cv::Mat paintWallpaper(const Dice& dice, int size_px) {
  const ValueNoise shades(dice, {64, 64}, 2);
  cv::Mat image = paintShades(size_px, [&](double x, double y) { return 0.92 + 0.1 * (shades.at(x, y) - 0.5); });
  drawLeaves(dice, 60, 2, image);
  drawLeaves(dice, 26, 1, image);
  return image;
}

/// Strokes of a roller, stains, and the dents and hairs of many years.
cv::Mat paintPlaster(const Dice& dice, int size_px) {
  const FractalNoise coarse(dice, {48, 48}, 1);
  const FractalNoise fine(dice, {320, 320}, 3);
  const FractalNoise stains(dice, {6, 6}, 2);
  const ValueNoise dents(dice, {192, 192}, 9);
  return paintShades(size_px, [&](double x, double y) {
    const double rough = 0.12 * (coarse.at(x, y) - 0.5) + 0.12 * (fine.at(x, y) - 0.5);
    const double stain = 0.14 * (stains.at(x, y) - 0.5);
    const double dent = dents.at(x, y) > 0.93 ? 0.16 : 0.0;
    return 0.92 + rough + stain - dent;
  });
}

cv::Mat paintWood(const Dice& dice, int size_px) {
  const Grain grain(dice, 1);
  return paintShades(size_px, [&](double x, double y) { return grain.at(y, x); });
}

cv::Mat paintFabric(const Dice& dice, int size_px) {
  const FractalNoise folds(dice, {9, 9}, 1);
  const FractalNoise threads(dice, {64, 64}, 2);
  return paintShades(size_px, [&](double x, double y) {
    const double weave = 0.5 + 0.25 * std::sin(2.0 * std::numbers::pi * 48.0 * x) + 0.25 * std::sin(2.0 * std::numbers::pi * 48.0 * y);
    return 0.72 + 0.14 * (weave - 0.5) + 0.34 * (folds.at(x, y) - 0.5) + 0.2 * (threads.at(x, y) - 0.5);
  });
}

cv::Mat paintStone(const Dice& dice, int size_px) {
  const FractalNoise clouds(dice, {12, 12}, 1);
  const ValueNoise specks(dice, {128, 128}, 9);
  return paintShades(size_px, [&](double x, double y) {
    const double speck = specks.at(x, y);
    return 0.75 + 0.4 * (clouds.at(x, y) - 0.5) + (speck > 0.86 ? 0.2 : speck < 0.12 ? -0.3 : 0.0);
  });
}

cv::Mat paintBrushedMetal(const Dice& dice, int size_px) {
  const FractalNoise scratches(dice, {3, 128}, 1);
  return paintShades(size_px, [&](double x, double y) { return 0.86 + 0.14 * (scratches.at(x, y) - 0.5); });
}

cv::Scalar colorOf(Dice& dice) {
  return {dice.between(20, 245), dice.between(20, 245), dice.between(20, 245)};
}

/// Coloured patches, curves and dots on a ground, in a frame.
cv::Mat paintPainting(Dice& dice, int size_px) {
  cv::Mat image(size_px, size_px, CV_8UC3, colorOf(dice));
  const auto point = [&] { return cv::Point(dice.upTo(size_px), dice.upTo(size_px)); };
  for (int i = 0; i < 14; ++i) {
    const std::vector<cv::Point> corners = {point(), point(), point()};
    cv::fillConvexPoly(image, corners, colorOf(dice), cv::LINE_AA);
    cv::circle(image, point(), dice.upTo(size_px / 9) + 2, colorOf(dice), dice.upTo(1) == 0 ? -1 : 3, cv::LINE_AA);
    cv::line(image, point(), point(), colorOf(dice), 1 + dice.upTo(size_px / 60), cv::LINE_AA);
    cv::ellipse(image, point(), {4 + dice.upTo(size_px / 6), 3 + dice.upTo(size_px / 12)}, 360.0 * dice.next(), 0.0,
                90.0 + 270.0 * dice.next(), colorOf(dice), 2, cv::LINE_AA);
  }
  cv::rectangle(image, {0, 0, size_px, size_px}, colorOf(dice) * 0.3, size_px / 14);
  return image;
}

/// A carton or a cover: bands of colour, a large word, a picture and lines of small print.
cv::Mat paintPrint(Dice& dice, int size_px) {
  cv::Mat image(size_px, size_px, CV_8UC3, colorOf(dice));
  const auto part = [&](double share) { return static_cast<int>(share * size_px); };
  cv::rectangle(image, {0, part(dice.between(0.05, 0.5)), size_px, part(dice.between(0.15, 0.35))}, colorOf(dice), -1);
  const int picture = part(dice.between(0.2, 0.36));
  Dice motif(static_cast<std::uint64_t>(dice.upTo(1'000'000)));
  cv::Mat small;
  cv::resize(paintPainting(motif, 64), small, {picture, picture}, 0.0, 0.0, cv::INTER_AREA);
  small.copyTo(image(cv::Rect(part(dice.between(0.05, 0.5)), part(dice.between(0.45, 0.6)), picture, picture)));
  std::string word;
  for (int i = 4 + dice.upTo(3); i > 0; --i) {
    word += static_cast<char>('A' + dice.upTo(25));
  }
  const cv::Scalar ink = colorOf(dice);
  cv::putText(image, word, {part(0.06), part(dice.between(0.22, 0.4))},
              dice.upTo(1) == 0 ? cv::FONT_HERSHEY_DUPLEX : cv::FONT_HERSHEY_TRIPLEX, size_px / 190.0, ink, std::max(1, size_px / 90),
              cv::LINE_AA);
  for (int line = 0; line < 9; ++line) {
    for (int x = part(0.06); x < part(0.92);) {
      const int width = 2 + dice.upTo(size_px / 16);
      const int y = part(0.72 + 0.028 * line);
      cv::line(image, {x, y}, {std::min(x + width, part(0.94)), y}, ink, 1, cv::LINE_AA);
      x += width + 3;
    }
  }
  return image;
}

}  // namespace

cv::Mat makeTexture(TextureKind kind, std::uint64_t seed, int size_px) {
  Dice dice(seed * enumTable(TextureKind{}).size() + static_cast<std::uint64_t>(kind));
  switch (kind) {
    case TextureKind::kWood:
      return paintWood(dice, size_px);
    case TextureKind::kPlanks:
      return paintPlanks(dice, size_px);
    case TextureKind::kTiles:
      return paintTiles(dice, size_px);
    case TextureKind::kPlaster:
      return paintPlaster(dice, size_px);
    case TextureKind::kWallpaper:
      return paintWallpaper(dice, size_px);
    case TextureKind::kFabric:
      return paintFabric(dice, size_px);
    case TextureKind::kStone:
      return paintStone(dice, size_px);
    case TextureKind::kBrushedMetal:
      return paintBrushedMetal(dice, size_px);
    case TextureKind::kPainting:
      return paintPainting(dice, size_px);
    case TextureKind::kPrint:
      return paintPrint(dice, size_px);
  }
  return {};
}

}  // namespace oikos::simulate
