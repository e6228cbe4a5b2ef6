// SPDX-License-Identifier: Apache-2.0
#include "core/render/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/geometry/tone_curve.h"
#include "core/render/lamp_visibility.h"
#include "core/render/ray_caster.h"
#include "core/render/shader.h"

namespace oikos::render {

namespace {

// A packet is a small rectangle of pixels, so that its rays go through the same boxes; a band of them is one thread's work.
constexpr int kPacketColumns = 4;
constexpr int kPacketRows = kPacketSize / kPacketColumns;
constexpr int kBandRows = 8;

/// Four rays in a turned square: no two in one row or column.
const std::array<Eigen::Vector2d, 4> kSubPixels = {Eigen::Vector2d(-0.125, -0.375), Eigen::Vector2d(0.375, -0.125),
                                                   Eigen::Vector2d(-0.375, 0.125), Eigen::Vector2d(0.125, 0.375)};

/// One picture in the making: first the rays of all pixels, band by band, then finer ones where edges were found.
class Picture {
 public:
  Picture(const Scene& scene, const CameraRays& rays, const Viewpoint& viewpoint, const ViewConfig& config)
      : rays_(rays),
        config_(config),
        embree_(scene.embree()),
        caster_(scene, rays, viewpoint, config),
        shader_(scene, rays, config),
        visibility_(scene.embree(), config.lighting) {
    const cv::Size size(rays.width(), rays.height());
    view_.depth_m.create(size, CV_32FC1);
    createIf(config.with_normals, view_.normal_camera, size, CV_32FC3);
    createIf(config.with_parts || config.with_color, view_.part, size, CV_32SC1);
    createIf(config.with_color, view_.color, size, CV_8UC3);
    createIf(config.with_surface, view_.albedo, size, CV_32FC1);
    createIf(config.with_surface, view_.gloss, size, CV_32FC1);
    createIf(config.with_color, normal_map_, size, CV_32FC3);
    createIf(config.with_color, lit_, size, CV_32SC1);
  }

  View make() {
    const int bands = (rays_.height() + kBandRows - 1) / kBandRows;
    base::parallelFor(bands, config_.threads, [this](int band) { drawBand(band * kBandRows); });
    if (config_.with_color) {
      base::parallelFor(bands, config_.threads, [this](int band) {
        for (int v = band * kBandRows; v < std::min(rays_.height(), (band + 1) * kBandRows); ++v) {
          refineEdges(v);
        }
      });
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

  void drawBand(int top) {
    LampVisibility::Block block;
    block.columns = (rays_.width() + kPacketColumns - 1) / kPacketColumns;
    const int rows = (std::min(kBandRows, rays_.height() - top) + kPacketRows - 1) / kPacketRows;
    block.packets.resize(config_.with_color ? static_cast<std::size_t>(rows * block.columns) : 1);
    for (int i = 0; i < rows * block.columns; ++i) {
      SurfacePacket& packet = block.packets[config_.with_color ? static_cast<std::size_t>(i) : 0];
      const PixelPacket pixels = pixelsAt(i % block.columns * kPacketColumns, top + i / block.columns * kPacketRows);
      caster_.cast(pixels, packet);
      store(pixels, packet);
    }
    if (config_.with_color) {
      visibility_.find(block);
      for (int i = 0; i < rows * block.columns; ++i) {
        color(block, static_cast<std::size_t>(i), pixelsAt(i % block.columns * kPacketColumns, top + i / block.columns * kPacketRows));
      }
    }
  }

  [[nodiscard]] PixelPacket pixelsAt(int left, int top) const {
    PixelPacket pixels;
    for (int i = 0; i < kPacketSize; ++i) {
      const int u = left + i % kPacketColumns;
      const int v = top + i / kPacketColumns;
      if (u < rays_.width() && v < rays_.height()) {
        pixels[static_cast<std::size_t>(i)] = {u, v, Eigen::Vector2d::Zero()};
      }
    }
    return pixels;
  }

  void store(const PixelPacket& pixels, const SurfacePacket& surfaces) {
    ColorPacket albedo_rgb;
    Lanes<float> gloss;
    if (config_.with_surface) {
      shader_.findLooks(surfaces, albedo_rgb, gloss);
    }
    for (std::size_t i = 0; i < kPacketSize; ++i) {
      const int u = pixels[i].u_px;
      const int v = pixels[i].v_px;
      if (u < 0) {
        continue;
      }
      view_.depth_m.ptr<float>(v)[u] = surfaces.hit.part[i] >= 0 ? surfaces.depth_m[i] : std::numeric_limits<float>::quiet_NaN();
      if (!view_.part.empty()) {
        view_.part.ptr<std::int32_t>(v)[u] = surfaces.hit.part[i];
      }
      const Eigen::Vector3f normal_map(surfaces.normal_x[i], surfaces.normal_y[i], surfaces.normal_z[i]);
      if (config_.with_normals) {
        const Eigen::Vector3f normal = caster_.T_map_camera(v).linear().transpose().cast<float>() * normal_map;
        view_.normal_camera.ptr<cv::Vec3f>(v)[u] = {normal.x(), normal.y(), normal.z()};
      }
      if (config_.with_color) {
        normal_map_.ptr<cv::Vec3f>(v)[u] = {normal_map.x(), normal_map.y(), normal_map.z()};
      }
      if (config_.with_surface) {
        view_.albedo.ptr<float>(v)[u] = (albedo_rgb.r[i] + albedo_rgb.g[i] + albedo_rgb.b[i]) * (1.0F / 3.0F);
        view_.gloss.ptr<float>(v)[u] = gloss[i];
      }
    }
  }

  void color(const LampVisibility::Block& block, std::size_t number, const PixelPacket& pixels) {
    const SurfacePacket& surfaces = block.packets[number];
    Shader::Shading shading;
    shader_.begin(surfaces, shading);
    Lanes<std::uint32_t> lit{};
    for (std::size_t lamp = 0; lamp < config_.lighting.lamps.size(); ++lamp) {
      const std::uint8_t lanes = block.lit[lamp][number];
      shader_.addLamp(config_.lighting.lamps[lamp], surfaces, lanes, shading);
      for (std::size_t i = 0; i < kPacketSize && lamp < kKeptLamps; ++i) {
        lit[i] |= (static_cast<std::uint32_t>(lanes) >> i & 1U) << lamp;
      }
    }
    ColorPacket colors;
    shader_.finish(surfaces, shading, colors);
    for (std::size_t i = 0; i < kPacketSize; ++i) {
      if (pixels[i].u_px >= 0) {
        setColor(pixels[i].u_px, pixels[i].v_px, {colors.r[i], colors.g[i], colors.b[i]});
        lit_.ptr<std::int32_t>(pixels[i].v_px)[pixels[i].u_px] = static_cast<std::int32_t>(lit[i]);
      }
    }
  }

  void refineEdges(int v) {
    PixelPacket on_edges;
    std::size_t waiting = 0;
    for (int u = 0; u < rays_.width(); ++u) {
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
    if (waiting > 0) {
      std::fill(on_edges.begin() + static_cast<std::ptrdiff_t>(waiting), on_edges.end(), PixelRay{});
      colorEdges(on_edges);
    }
  }

  /// Two pixels, four rays each.
  void colorEdges(const PixelPacket& pixels) {
    SurfacePacket surfaces;
    caster_.cast(pixels, surfaces);
    Lanes<std::uint32_t> lit;
    Lanes<std::uint32_t> known;
    for (std::size_t i = 0; i < kPacketSize; ++i) {
      recallLamps(pixels[i], surfaces, i, lit[i], known[i]);
    }
    Shader::Shading shading;
    shader_.begin(surfaces, shading);
    for (std::size_t lamp = 0; lamp < config_.lighting.lamps.size(); ++lamp) {
      shader_.addLamp(config_.lighting.lamps[lamp], surfaces, lanesOf(lamp, surfaces, lit, known), shading);
    }
    ColorPacket colors;
    shader_.finish(surfaces, shading, colors);
    for (std::size_t first = 0; first < kPacketSize && pixels[first].u_px >= 0; first += kSubPixels.size()) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t i = first; i < first + kSubPixels.size(); ++i) {
        sum += Eigen::Vector3f(colors.r[i], colors.g[i], colors.b[i]).cwiseMin(1.0F);
      }
      setColor(pixels[first].u_px, pixels[first].v_px, sum / static_cast<float>(kSubPixels.size()));
    }
  }

  /// Which lamps shine on the pixels around that show the same surface: on all of them (`lit`), and on all or none (`known`).
  void recallLamps(const PixelRay& pixel, const SurfacePacket& surfaces, std::size_t i, std::uint32_t& lit, std::uint32_t& known) const {
    std::uint32_t on_all = ~0U;
    std::uint32_t on_any = 0;
    bool is_found = false;
    const Eigen::Vector3f normal_map(surfaces.normal_x[i], surfaces.normal_y[i], surfaces.normal_z[i]);
    for (int v = std::max(0, pixel.v_px - 1); v <= std::min(rays_.height() - 1, pixel.v_px + 1); ++v) {
      for (int u = std::max(0, pixel.u_px - 1); u <= std::min(rays_.width() - 1, pixel.u_px + 1); ++u) {
        if (view_.part.ptr<std::int32_t>(v)[u] == surfaces.hit.part[i] &&
            isOneSurface(view_.depth_m.ptr<float>(v)[u], surfaces.depth_m[i]) && normalAt(u, v).dot(normal_map) > kCosineOfCrease) {
          const auto here = static_cast<std::uint32_t>(lit_.ptr<std::int32_t>(v)[u]);
          on_all &= here;
          on_any |= here;
          is_found = true;
        }
      }
    }
    lit = is_found ? on_all : 0;
    known = is_found ? on_all | ~on_any : 0;
  }

  /// The lanes that a lamp shines on: by what is known of it, and by rays where nothing is.
  [[nodiscard]] std::uint8_t lanesOf(std::size_t lamp, const SurfacePacket& surfaces, const Lanes<std::uint32_t>& lit,
                                     const Lanes<std::uint32_t>& known) const {
    if (!config_.lighting.has_shadows) {
      return 0xff;
    }
    unsigned shining = 0;
    unsigned open = 0;
    for (unsigned i = 0; i < kPacketSize; ++i) {
      const bool is_known = lamp < kKeptLamps && (known[i] >> lamp & 1U) != 0;
      shining |= (is_known ? lit[i] >> lamp & 1U : 0U) << i;
      open |= (is_known ? 0U : 1U) << i;
    }
    const PointLight& light = config_.lighting.lamps[lamp];
    const unsigned asked = open == 0 ? 0U : open & facingLanes(light, surfaces);
    return static_cast<std::uint8_t>(shining | traceLamp(embree_, light, surfaces, static_cast<std::uint8_t>(asked)));
  }

  void setColor(int u, int v, const Eigen::Vector3f& color_rgb) {
    view_.color.ptr<cv::Vec3b>(v)[u] = {curve_.toByte(color_rgb.z()), curve_.toByte(color_rgb.y()), curve_.toByte(color_rgb.x())};
  }

  [[nodiscard]] Eigen::Map<const Eigen::Vector3f> normalAt(int u, int v) const {
    return Eigen::Map<const Eigen::Vector3f>(normal_map_.ptr<float>(v) + static_cast<std::ptrdiff_t>(3) * u);
  }

  [[nodiscard]] bool isEdge(int u, int v) const {
    return (u > 0 && differs(u, v, u - 1, v)) || (u + 1 < rays_.width() && differs(u, v, u + 1, v)) || (v > 0 && differs(u, v, u, v - 1)) ||
           (v + 1 < rays_.height() && differs(u, v, u, v + 1));
  }

  [[nodiscard]] bool differs(int u, int v, int other_u, int other_v) const {
    const std::int32_t part = view_.part.ptr<std::int32_t>(v)[u];
    return part != view_.part.ptr<std::int32_t>(other_v)[other_u] ||
           (part >= 0 && (!isOneSurface(view_.depth_m.ptr<float>(v)[u], view_.depth_m.ptr<float>(other_v)[other_u]) ||
                          normalAt(u, v).dot(normalAt(other_u, other_v)) < kCosineOfCrease));
  }

  static bool isOneSurface(float a_m, float b_m) {
    constexpr float kDepthStep = 0.05F;
    return std::abs(a_m - b_m) <= kDepthStep * std::min(a_m, b_m);
  }

  static constexpr float kCosineOfCrease = 0.9F;
  static constexpr std::size_t kKeptLamps = 32;  ///< edges trace the others themselves

  const CameraRays& rays_;
  const ViewConfig& config_;
  const EmbreeScene& embree_;
  const geometry::ToneCurve& curve_ = geometry::ToneCurve::instance();
  RayCaster caster_;
  Shader shader_;
  LampVisibility visibility_;
  View view_;
  cv::Mat normal_map_;  ///< CV_32FC3, if there are colours to be made
  cv::Mat lit_;         ///< CV_32SC1: which of the first lamps shine on a pixel, a bit each
};

}  // namespace

View renderView(const Scene& scene, const CameraRays& rays, const Viewpoint& viewpoint, const ViewConfig& config) {
  return Picture(scene, rays, viewpoint, config).make();
}

}  // namespace oikos::render
