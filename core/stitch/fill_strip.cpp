#include "core/stitch/fill_strip.h"

#include <algorithm>
#include <cmath>

#include "core/stitch/constrained_delaunay.h"

namespace rangezip {

namespace {

/// A triangle with corners of the patch only closes a notch of it; it has to be this much shorter
/// than one that reaches the old surface.
constexpr double kNotchShare = 0.8;

/// Edges in space may be longer than in the image where the sheet is tilted, up to this much.
constexpr double kMaxTilt = 2.5;

/// Share of the squared longest edge that the area of a usable triangle exceeds: rounding.
constexpr double kFlatArea = 1e-12;

/// Numbers the ends of the segments 0, 1, ... in the order of the vertices.
struct LocalPoints {
  std::vector<std::uint32_t> vertices;
  std::vector<GridPoint> points;

  LocalPoints(std::span<const SeamSegment> segments, const ImagePlane& image) {
    vertices.reserve(2 * segments.size());
    for (const SeamSegment& s : segments)
      vertices.insert(vertices.end(), s.begin(), s.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    points.reserve(vertices.size());
    for (const std::uint32_t v : vertices)
      points.push_back(image.points[v]);
  }

  [[nodiscard]] std::uint32_t number_of(std::uint32_t vertex) const {
    return static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) -
                                      vertices.begin());
  }
};

/// The directions between two edges that leave a vertex, counter-clockwise from the first.
struct Cone {
  GridPoint tip, right, left;

  [[nodiscard]] bool contains(const GridPoint& p) const {
    return orientation(tip, right, p) > 0 && orientation(tip, p, left) > 0;
  }
  [[nodiscard]] GridPoint middle() const {
    return {(right.x + left.x) / 2, (right.y + left.y) / 2};
  }
};

bool overlap(const Cone& a, const Cone& b) {
  return a.contains(b.right) || a.contains(b.left) || b.contains(a.right) || b.contains(a.left) ||
         a.contains(b.middle()) || b.contains(a.middle());
}

/// The cones of the old faces that look at the viewer, around each end of a segment.
class OldCones {
 public:
  OldCones(const Seam& seam, const LocalPoints& local) : begins_(local.vertices.size() + 1, 0) {
    std::vector<std::pair<std::uint32_t, Cone>> found;
    std::vector<std::uint8_t> is_end(seam.positions.size(), 0);
    for (const std::uint32_t v : local.vertices)
      is_end[v] = 1;
    for (const Triangle& face : seam.old_faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (is_end[face[k]] == 0) continue;
        const Cone cone{seam.image.points[face[k]], seam.image.points[face[(k + 1) % 3]],
                        seam.image.points[face[(k + 2) % 3]]};
        if (orientation(cone.tip, cone.right, cone.left) <= 0) continue;
        const std::uint32_t number = local.number_of(face[k]);
        found.emplace_back(number, cone);
        ++begins_[number + 1];
      }
    }
    for (std::size_t i = 1; i < begins_.size(); ++i)
      begins_[i] += begins_[i - 1];
    cones_.resize(found.size());
    std::vector<std::uint32_t> next = begins_;
    for (const auto& [number, cone] : found)
      cones_[next[number]++] = cone;
  }

  [[nodiscard]] bool overlap_any(std::uint32_t number, const Cone& cone) const {
    return std::any_of(cones_.begin() + begins_[number], cones_.begin() + begins_[number + 1],
                       [&](const Cone& old) { return overlap(old, cone); });
  }

 private:
  std::vector<std::uint32_t> begins_;
  std::vector<Cone> cones_;
};

/// Decides about the triangles of the strip one by one.
class Judge {
 public:
  Judge(const Seam& seam, const LocalPoints& local, const FillStripOptions& options)
      : seam_(seam), local_(local), options_(options), old_cones_(seam, local) {}

  /// Whether the triangle lies outside of the patch and close to it. Local corner numbers.
  [[nodiscard]] bool is_in_strip(const Triangle& t) const {
    const GridPoint middle = centroid(t);
    if (seam_.sheet.covers(in_pixels(middle))) return false;
    return sheet_near(middle).ring < seam_.sheet.radius() ||
           seam_.removed.longest_side_at(middle) > 0.0;
  }

  [[nodiscard]] bool is_acceptable(const Triangle& t) const {
    return is_short_enough(t) && is_flat_enough(t) && is_free_of_old_faces(t) &&
           !is_seen_through(t);
  }

 private:
  [[nodiscard]] const Vec3& position(std::uint32_t local) const {
    return seam_.positions[local_.vertices[local]];
  }
  [[nodiscard]] bool is_old(std::uint32_t local) const {
    return local_.vertices[local] < seam_.first_new;
  }

  [[nodiscard]] GridPoint centroid(const Triangle& t) const {
    const GridPoint& a = local_.points[t[0]];
    const GridPoint& b = local_.points[t[1]];
    const GridPoint& c = local_.points[t[2]];
    return {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
  }

  [[nodiscard]] const SheetSample& sheet_near(const GridPoint& place) const {
    return seam_.sheet[nearest_pixel(place)];
  }

  /// Longest edge that the triangle may have in the image.
  [[nodiscard]] double longest_allowed(const Triangle& t) const {
    const bool is_notch = std::none_of(t.begin(), t.end(), [&](auto v) { return is_old(v); });
    const double wide = seam_.removed.longest_side_at(centroid(t));
    // The way from the patch across a removed face is as long as the face, and a bit more where
    // the clearance has taken the next one as well: as much as between equal resolutions.
    const double scale = std::max(1.0, wide / kWideFace);
    return options_.max_gap * scale * (is_notch && wide == 0.0 ? kNotchShare : 1.0);
  }

  [[nodiscard]] bool is_short_enough(const Triangle& t) const {
    double in_image = 0.0;  // squares of the longest edges
    double in_space = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 flat = in_pixels(local_.points[t[k]]) - in_pixels(local_.points[t[(k + 1) % 3]]);
      const Vec3 edge = position(t[k]) - position(t[(k + 1) % 3]);
      in_image = std::max(in_image, glm::dot(flat, flat));
      in_space = std::max(in_space, glm::dot(edge, edge));
    }
    const double pixels = longest_allowed(t);
    const double depth = seam_.image.depths[local_.vertices[t[0]]];
    const double side = seam_.sheet.image().view().pixel_size(depth);
    const double tilt = std::min(kMaxTilt, sheet_near(centroid(t)).stretch);
    const double length = pixels * side * tilt;
    return in_image <= pixels * pixels && in_space <= length * length;
  }

  [[nodiscard]] bool is_flat_enough(const Triangle& t) const {
    const Vec3& a = position(t[0]);
    const Vec3 normal = area_vector(a, position(t[1]), position(t[2]));
    const double area = glm::length(normal);
    const Vec3 ab = position(t[1]) - a;
    const Vec3 ac = position(t[2]) - a;
    if (area <= kFlatArea * std::max(glm::dot(ab, ab), glm::dot(ac, ac))) return false;
    const Vec3 toward_viewer = seam_.sheet.image().view().toward_viewer(a);
    return glm::dot(normal, toward_viewer) >= options_.min_strip_cosine * area;
  }

  /// Whether the scan saw past one of the long edges: one that is longer than the widest gap
  /// follows a tilted sheet, or it leads through the air from one to the next, as over a slot.
  [[nodiscard]] bool is_seen_through(const Triangle& t) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const GridPoint& from = local_.points[t[k]];
      const GridPoint& to = local_.points[t[(k + 1) % 3]];
      const double depth = seam_.image.depths[local_.vertices[t[k]]];
      const double side = seam_.sheet.image().view().pixel_size(depth);
      const double length = glm::length(position(t[k]) - position(t[(k + 1) % 3]));
      if (length <= longest_allowed(t) * side) continue;
      const Pixel middle = nearest_pixel({(from.x + to.x) / 2, (from.y + to.y) / 2});
      if (is_behind(middle, t)) return true;
    }
    return false;
  }

  /// Whether the sample of the pixel lies behind the plane of the triangle.
  [[nodiscard]] bool is_behind(Pixel pixel, const Triangle& t) const {
    const RangeImage& image = seam_.sheet.image();
    if (!image.extent().contains(pixel) || !image.has_sample(pixel)) return false;
    const Vec3 a = position(t[0]);
    const Vec3 normal = area_vector(a, position(t[1]), position(t[2]));
    const Vec3 sample = image.position(pixel);
    const Vec3 toward_viewer = image.view().toward_viewer(sample);
    // Along the line of sight, which is_flat_enough() keeps from running beside the plane.
    const double behind = glm::dot(normal, a - sample) / glm::dot(normal, toward_viewer);
    const double stretch = sheet_near(grid_point(pixel)).stretch;
    return behind > seam_.sheet.tolerance(stretch, image[pixel], options_.band);
  }

  [[nodiscard]] bool is_free_of_old_faces(const Triangle& t) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Cone cone{local_.points[t[k]], local_.points[t[(k + 1) % 3]],
                      local_.points[t[(k + 2) % 3]]};
      if (old_cones_.overlap_any(t[k], cone)) return false;
    }
    return true;
  }

  const Seam& seam_;
  const LocalPoints& local_;
  const FillStripOptions& options_;
  OldCones old_cones_;
};

/// Enters the face if all its directed edges are free.
bool claim_edges(EdgeMap& edges, const Triangle& face, std::uint32_t number) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (edges.find(face[k], face[(k + 1) % 3]) != EdgeMap::kNone) return false;
  }
  for (std::size_t k = 0; k < 3; ++k)
    edges.insert(face[k], face[(k + 1) % 3], number);
  return true;
}

}  // namespace

FilledStrip fill_strip(const Seam& seam, EdgeMap& edges, std::uint32_t first_face,
                       const FillStripOptions& options) {
  const LocalPoints local(seam.segments, seam.image);
  std::vector<SeamSegment> segments;
  segments.reserve(seam.segments.size());
  for (const SeamSegment& s : seam.segments) {
    segments.push_back({local.number_of(s[0]), local.number_of(s[1])});
  }
  const ConstrainedDelaunay triangulation = triangulate_constrained(local.points, segments);

  FilledStrip strip;
  const Judge judge(seam, local, options);
  for (const Triangle& t : triangulation.triangles) {
    if (!judge.is_in_strip(t)) continue;
    const Triangle face{local.vertices[t[0]], local.vertices[t[1]], local.vertices[t[2]]};
    const auto number = first_face + static_cast<std::uint32_t>(strip.faces.size());
    if (judge.is_acceptable(t) && claim_edges(edges, face, number)) {
      strip.faces.push_back(face);
    } else {
      ++strip.rejected_faces;
    }
  }
  return strip;
}

}  // namespace rangezip
