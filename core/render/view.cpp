// SPDX-License-Identifier: Apache-2.0
#include "core/render/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/render/ray_caster.h"
#include "core/render/shader.h"
#include "core/render/texture.h"

namespace oikos::render {

namespace {

constexpr int kRowsAtOnce = 8;

/// Four rays in a turned square: no two in one row or column.
const std::array<Eigen::Vector2d, 4> kSubPixels = {Eigen::Vector2d(-0.125, -0.375), Eigen::Vector2d(0.375, -0.125),
                                                   Eigen::Vector2d(-0.375, 0.125), Eigen::Vector2d(0.125, 0.375)};

/// One picture in the making: first the rays of all pixels, then colours, which need to know where the edges are.
class Picture {
 public:
  Picture(const Scene& scene, const CameraRays& rays, const Viewpoint& viewpoint, const ViewConfig& config)
      : rays_(rays), config_(config), caster_(scene, rays, viewpoint, config), shader_(scene, rays, config) {
    const cv::Size size(rays.width(), rays.height());
    view_.depth_m.create(size, CV_32FC1);
    createIf(config.with_normals, view_.normal_camera, size, CV_32FC3);
    createIf(config.with_parts || config.with_color, view_.part, size, CV_32SC1);
    createIf(config.with_color, view_.color, size, CV_8UC3);
    createIf(config.with_surface, view_.albedo, size, CV_32FC1);
    createIf(config.with_surface, view_.gloss, size, CV_32FC1);
    if (config.with_color) {
      surfaces_.resize(static_cast<std::size_t>(size.area()));
    }
  }

  View make() {
    forEachRow([this](int v) { castRow(v); });
    if (config_.with_color) {
      forEachRow([this](int v) { colorRow(v); });
    }
    if (!config_.with_parts) {
      view_.part.release();
    }
    return std::move(view_);
  }

 private:
  static void createIf(bool is_wanted, cv::Mat& image, const cv::Size& size, int type) {
    if (is_wanted) {
      image.create(size, type);
    }
  }

  void forEachRow(const std::function<void(int)>& body) const {
    base::parallelFor((rays_.height() + kRowsAtOnce - 1) / kRowsAtOnce, config_.threads, [&](int band) {
      for (int v = band * kRowsAtOnce; v < std::min(rays_.height(), (band + 1) * kRowsAtOnce); ++v) {
        body(v);
      }
    });
  }

  void castRow(int v) {
    PixelPacket pixels;
    SurfacePacket packet;
    const Eigen::Matrix3f R_camera_map = caster_.T_map_camera(v).linear().transpose().cast<float>();
    for (int first = 0; first < rays_.width(); first += kPacketSize) {
      const int count = std::min(kPacketSize, rays_.width() - first);
      for (int i = 0; i < kPacketSize; ++i) {
        pixels[i] = i < count ? PixelRay{first + i, v, Eigen::Vector2d::Zero()} : PixelRay{};
      }
      caster_.cast(pixels, packet);
      for (int i = 0; i < count; ++i) {
        store(packet[i], R_camera_map, {first + i, v});
      }
    }
  }

  void store(const SurfacePoint& surface, const Eigen::Matrix3f& R_camera_map, const cv::Point& pixel) {
    const bool is_hit = surface.hit.part >= 0;
    view_.depth_m.at<float>(pixel) = is_hit ? surface.depth_m : std::numeric_limits<float>::quiet_NaN();
    if (!view_.part.empty()) {
      view_.part.at<std::int32_t>(pixel) = surface.hit.part;
    }
    if (config_.with_normals) {
      const Eigen::Vector3f normal = R_camera_map * surface.normal_map;
      view_.normal_camera.at<cv::Vec3f>(pixel) = {normal.x(), normal.y(), normal.z()};
    }
    if (config_.with_surface) {
      view_.albedo.at<float>(pixel) = is_hit ? shader_.albedo(surface).mean() : 0.0F;
      view_.gloss.at<float>(pixel) = is_hit ? shader_.gloss(surface) : 0.0F;
    }
    if (config_.with_color) {
      surfaces_[indexOf(pixel.x, pixel.y)] = surface;
    }
  }

  [[nodiscard]] std::size_t indexOf(int u, int v) const { return static_cast<std::size_t>(v * rays_.width() + u); }

  void colorRow(int v) {
    PixelPacket on_edges;
    std::size_t waiting = 0;
    for (int first = 0; first < rays_.width(); first += kPacketSize) {
      const int count = std::min(kPacketSize, rays_.width() - first);
      colorInside(first, count, v);
      for (int u = first; u < first + count; ++u) {
        if (!isEdge(u, v)) {
          continue;
        }
        for (const Eigen::Vector2d& offset_px : kSubPixels) {
          on_edges[waiting++] = {u, v, offset_px};
        }
        if (waiting == kPacketSize) {
          colorEdges(on_edges);
          waiting = 0;
        }
      }
    }
    if (waiting > 0) {
      std::fill(on_edges.begin() + static_cast<std::ptrdiff_t>(waiting), on_edges.end(), PixelRay{});
      colorEdges(on_edges);
    }
  }

  void colorInside(int first, int count, int v) {
    SurfacePacket packet{};
    ColorPacket colors;
    std::copy_n(surfaces_.begin() + static_cast<std::ptrdiff_t>(indexOf(first, v)), count, packet.begin());
    shader_.shade(packet, colors);
    for (int i = 0; i < count; ++i) {
      setColor(first + i, v, colors[static_cast<std::size_t>(i)]);
    }
  }

  /// Two pixels, four rays each.
  void colorEdges(const PixelPacket& pixels) {
    SurfacePacket packet;
    ColorPacket colors;
    caster_.cast(pixels, packet);
    shader_.shade(packet, colors);
    for (std::size_t first = 0; first < kPacketSize && pixels[first].u_px >= 0; first += kSubPixels.size()) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t i = first; i < first + kSubPixels.size(); ++i) {
        sum += colors[i].cwiseMin(1.0F);
      }
      setColor(pixels[first].u_px, pixels[first].v_px, sum / static_cast<float>(kSubPixels.size()));
    }
  }

  void setColor(int u, int v, const Eigen::Vector3f& color_rgb) {
    view_.color.at<cv::Vec3b>(v, u) = {srgbOf(color_rgb.z()), srgbOf(color_rgb.y()), srgbOf(color_rgb.x())};
  }

  [[nodiscard]] bool isEdge(int u, int v) const {
    const SurfacePoint& here = surfaces_[indexOf(u, v)];
    return (u > 0 && differs(here, surfaces_[indexOf(u - 1, v)])) ||
           (u + 1 < rays_.width() && differs(here, surfaces_[indexOf(u + 1, v)])) ||
           (v > 0 && differs(here, surfaces_[indexOf(u, v - 1)])) ||
           (v + 1 < rays_.height() && differs(here, surfaces_[indexOf(u, v + 1)]));
  }

  static bool differs(const SurfacePoint& a, const SurfacePoint& b) {
    constexpr float kDepthStep = 0.05F;
    constexpr float kCosineOfCrease = 0.9F;
    return a.hit.part != b.hit.part || std::abs(a.depth_m - b.depth_m) > kDepthStep * std::min(a.depth_m, b.depth_m) ||
           (a.hit.part >= 0 && a.normal_map.dot(b.normal_map) < kCosineOfCrease);
  }

  const CameraRays& rays_;
  const ViewConfig& config_;
  RayCaster caster_;
  Shader shader_;
  View view_;
  std::vector<SurfacePoint> surfaces_;  ///< of all pixels, row by row, if there are colours to be made
};

}  // namespace

View renderView(const Scene& scene, const CameraRays& rays, const Viewpoint& viewpoint, const ViewConfig& config) {
  return Picture(scene, rays, viewpoint, config).make();
}

}  // namespace oikos::render
