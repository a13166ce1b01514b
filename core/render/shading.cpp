#include "core/render/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"

namespace rangezip {

namespace {

constexpr double kEmpty = std::numeric_limits<double>::infinity();

constexpr Vec3 kWhite{1.0, 1.0, 1.0};
constexpr Vec3 kFrontColor{0.46, 0.57, 0.70};  // linear light: a pale steel blue
constexpr Vec3 kBackColor{0.85, 0.38, 0.10};   // orange: the inside
constexpr Vec3 kPointColor{0.16, 0.27, 0.42};

/// Lights in eye space: x right, y up, z toward the viewer.
struct Lights {
  Vec3 key = glm::normalize(Vec3{-0.45, 0.55, 0.85});
  Vec3 fill = glm::normalize(Vec3{0.75, 0.05, 0.55});
  Vec3 highlight = glm::normalize(key + Vec3{0.0, 0.0, 1.0});
};

/// Normals of the faces, and where the surface is smooth, of the vertices.
class Normals {
 public:
  Normals(const TriangleMesh& mesh, bool flat) : mesh_(mesh), flat_(flat) {
    if (flat) return;
    vertex_normals_.assign(mesh.positions.size(), Vec3{0.0});
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
      for (const std::uint32_t corner : mesh.triangles[face]) {
        vertex_normals_[corner] += area_vector_of(face);
      }
    }
  }

  [[nodiscard]] Vec3 of_face(std::size_t face) const { return unit_or_z(area_vector_of(face)); }

  /// Interpolated over the face; a corner on a sharp edge counts with the face's own normal.
  [[nodiscard]] Vec3 at(std::size_t face, const Vec3& point) const {
    constexpr double kSmoothCosine = 0.82;  // 35 degrees
    const Vec3 area = area_vector_of(face);
    const Vec3 flat_normal = unit_or_z(area);
    const double area_squared = glm::dot(area, area);
    if (flat_ || !(area_squared > 0.0)) return flat_normal;
    const auto& corners = mesh_.triangles[face];
    Vec3 sum{0.0};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& next = mesh_.positions[corners[(i + 1) % 3]];
      const Vec3& last = mesh_.positions[corners[(i + 2) % 3]];
      const double weight = glm::dot(area_vector(point, next, last), area) / area_squared;
      const Vec3 smooth = unit_or_z(vertex_normals_[corners[i]]);
      const bool is_smooth = glm::dot(smooth, flat_normal) > kSmoothCosine;
      sum += std::clamp(weight, 0.0, 1.0) * (is_smooth ? smooth : flat_normal);
    }
    return unit_or_z(sum);
  }

 private:
  [[nodiscard]] Vec3 area_vector_of(std::size_t face) const {
    const auto& [a, b, c] = mesh_.triangles[face];
    return area_vector(mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]);
  }

  const TriangleMesh& mesh_;
  bool flat_;
  std::vector<Vec3> vertex_normals_;  // sums of area vectors
};

/// Offsets on a sunflower spiral in the unit disc, turned by the golden angle; four sets, one for
/// each pixel of a 2 x 2 block, so that neighbours sample different places.
constexpr std::size_t kTaps = 12;
using Taps = std::array<std::array<Vec2, kTaps>, 4>;

Taps spiral_taps() {
  const Vec2 golden{-0.7373688780783197, 0.6754902942615238};  // cosine and sine of 137.508 degrees
  Taps taps;
  Vec2 direction{1.0, 0.0};
  for (std::size_t i = 0; i < kTaps; ++i) {
    for (std::size_t set = 0; set < 4; ++set) {
      const double share = (static_cast<double>(4 * i + set) + 0.5) / (4.0 * kTaps);
      taps[set][i] = share * direction;  // denser near the centre, where detail is
      direction = {golden.x * direction.x - golden.y * direction.y,
                   golden.x * direction.y + golden.y * direction.x};
    }
  }
  return taps;
}

/// Shades one picture; every pixel on its own.
class Shader {
 public:
  Shader(const View& view, const Framebuffer& drawn, const Grid<double>& depths,
         const TriangleMesh& mesh, const ShadingOptions& options)
      : view_(view),
        drawn_(drawn),
        depths_(depths),
        face_count_(mesh.triangles.size()),
        radius_(options.hollow_radius),
        reach_(options.point_reach),
        normals_(mesh, options.flat) {}

  [[nodiscard]] Vec3 color(Pixel pixel) const {
    const PrimitiveId id = drawn_.id[pixel];
    if (id == kNoPrimitive) return kWhite;
    return id < face_count_ ? face_color(pixel, id) : point_color(pixel);
  }

 private:
  [[nodiscard]] Vec3 eye_direction(const Vec3& world) const {
    return Mat3(view_.camera().eye_from_world) * world;
  }

  [[nodiscard]] Vec3 face_color(Pixel pixel, PrimitiveId face) const {
    const Vec3 position = view_.position(pixel, depths_[pixel]);
    const Vec3 toward_viewer = view_.toward_viewer(position);
    const bool is_back = glm::dot(normals_.of_face(face), toward_viewer) < 0.0;
    const double side = is_back ? -1.0 : 1.0;
    const Vec3 normal = side * eye_direction(normals_.at(face, position));
    const Vec3 flat = side * eye_direction(normals_.of_face(face));

    const double diffuse = 0.66 * std::max(0.0, glm::dot(normal, lights_.key)) +
                           0.20 * std::max(0.0, glm::dot(normal, lights_.fill)) +
                           0.20 * (0.7 + 0.3 * normal.y);
    double gloss = std::max(0.0, glm::dot(normal, lights_.highlight));
    for (int i = 0; i < 5; ++i)
      gloss *= gloss;  // to the power of 32
    const double openness = 1.0 - hollowness(pixel, flat);
    const Vec3 base = is_back ? kBackColor : kFrontColor;
    return openness * (1.25 * diffuse * base + Vec3{0.10 * gloss});
  }

  /// How much of the sky above a place is hidden by what the picture shows around it, in [0, 1).
  [[nodiscard]] double hollowness(Pixel pixel, const Vec3& normal) const {
    constexpr double kStrength = 0.9;
    constexpr double kSteepest = 8.0;  // of the tangent plane, per pixel
    const double scale = 1.0 / view_.pixel_size(depths_[pixel]);
    const double nz = std::max(normal.z, 1.0 / kSteepest);
    const int set = (pixel.x & 1) + 2 * (pixel.y & 1);
    double sum = 0.0;
    for (const Vec2& tap : taps_[static_cast<std::size_t>(set)]) {
      const Pixel other{pixel.x + static_cast<int>(std::lround(radius_ * tap.x)),
                        pixel.y + static_cast<int>(std::lround(radius_ * tap.y))};
      if (other == pixel || !depths_.extent().contains(other) || depths_[other] == kEmpty) continue;
      const double dx = other.x - pixel.x;
      const double dy = other.y - pixel.y;
      const double rise = (depths_[pixel] - depths_[other]) * scale;
      const double above_plane = rise + (normal.x * dx + normal.y * dy) / nz;
      const double elevation = above_plane * nz / std::sqrt(dx * dx + dy * dy);
      const double nearness = 1.0 - std::min(1.0, std::max(0.0, rise) / (3.0 * radius_));
      sum += nearness * std::clamp(elevation - 0.05, 0.0, 1.0);
    }
    const double mean = sum / static_cast<double>(kTaps);
    return kStrength * mean / (mean + 0.5);
  }

  /// Points have no normal; what lies behind its neighbours is darker ("eye-dome lighting"), and
  /// what is far away is paler.
  [[nodiscard]] Vec3 point_color(Pixel pixel) const {
    constexpr double kContrast = 0.36;
    const double depth = depths_[pixel];
    const double scale = 1.0 / view_.pixel_size(depth);
    double behind = 0.0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Pixel other{pixel.x + reach_ * dx, pixel.y + reach_ * dy};
        if (!depths_.extent().contains(other) || depths_[other] == kEmpty) continue;
        behind += std::clamp((depth - depths_[other]) * scale / reach_, 0.0, 4.0);
      }
    }
    const double light = 1.0 / (1.0 + kContrast * behind);
    const Camera& camera = view_.camera();
    const double distance = (depth - camera.near_depth) / (camera.far_depth - camera.near_depth);
    return light * glm::mix(kPointColor, Vec3{0.62, 0.68, 0.74}, 0.75 * distance);
  }

  const View& view_;
  const Framebuffer& drawn_;
  const Grid<double>& depths_;
  std::size_t face_count_;
  double radius_;
  int reach_;
  Normals normals_;
  Lights lights_;
  Taps taps_ = spiral_taps();
};

}  // namespace

Grid<double> eye_depths(const View& view, const Framebuffer& drawn) {
  Grid<double> depths(view.extent(), kEmpty);
  const double unit = 1.0 / (1U << static_cast<unsigned>(kDepthBits));
  for_each_row(view.extent().height, [&](int y) {
    for (int x = 0; x < view.extent().width; ++x) {
      const std::uint32_t depth = drawn.depth[{x, y}];
      if (depth != kNoDepth) depths[{x, y}] = view.depth_from_window_z(depth * unit);
    }
  });
  return depths;
}

LightImage shade(const View& view, const Framebuffer& drawn, const Grid<double>& depths,
                 const TriangleMesh& mesh, const ShadingOptions& options) {
  const Shader shader(view, drawn, depths, mesh, options);
  LightImage light(view.extent());
  for_each_row(view.extent().height, [&](int y) {
    for (int x = 0; x < view.extent().width; ++x)
      light[{x, y}] = Vec3f(shader.color({x, y}));
  });
  return light;
}

}  // namespace rangezip
