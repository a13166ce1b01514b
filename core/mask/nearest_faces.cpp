#include "core/mask/nearest_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/mesh/nearest_face.h"
#include "core/mesh/outgoing_edges.h"

namespace rangezip {

namespace {

constexpr NearestFace kNothing{kNoPrimitive, std::numeric_limits<double>::infinity()};
constexpr double kCloseEnough = 0.1;  ///< pixel sides: a nearer face could not gain more than that
constexpr double kFaceReach = 1.0;    ///< pixel sides from a place on a face to a vertex of it
constexpr std::size_t kSamplesPerBlock = 1024;
constexpr int kWindow = 3;  ///< pixels around a sample whose vertices are tried

/// Faces to begin a walk at, the nearest first.
class NearestStarts {
 public:
  void add(const NearestFace& start) {
    for (const NearestFace& known : starts_) {
      if (known.face == start.face) return;
    }
    if (!(start.squared_distance < starts_.back().squared_distance)) return;
    std::size_t k = starts_.size() - 1;
    for (; k > 0 && start.squared_distance < starts_[k - 1].squared_distance; --k)
      starts_[k] = starts_[k - 1];
    starts_[k] = start;
  }

  [[nodiscard]] auto begin() const { return starts_.begin(); }
  [[nodiscard]] auto end() const { return starts_.end(); }

 private:
  std::array<NearestFace, 3> starts_{kNothing, kNothing, kNothing};
};

/// The nearest of the faces reached by walks from the three nearest of what is seen in the pixel
/// and the eight around it: one walk alone ends in a local minimum where the mesh is rough.
NearestFace walk_from_seen_faces(const Grid<PrimitiveId>& seen, Pixel p, const TriangleMesh& mesh,
                                 const OutgoingEdges& edges, const Vec3& position) {
  NearestStarts starts;
  PrimitiveId last = kNoPrimitive;
  for (int k = 0; k < 9; ++k) {
    const Pixel q{p.x + k % 3 - 1, p.y + k / 3 - 1};
    if (!seen.extent().contains(q) || seen[q] == kNoPrimitive || seen[q] == last) continue;
    last = seen[q];
    starts.add(measure_face(mesh, last, position));
  }
  NearestFace nearest = kNothing;
  for (const NearestFace& start : starts) {
    if (start.face == kNoPrimitive || start.face == nearest.face) continue;
    const NearestFace found = walk_to_nearest_face(mesh, edges, start.face, position);
    if (found.squared_distance < nearest.squared_distance) nearest = found;
  }
  return nearest;
}

/// Calls visit(pixel) for those within kWindow, at the sides and across.
template <class Visit>
void for_each_pixel_around(Extent extent, Pixel p, const Visit& visit) {
  for (int y = std::max(0, p.y - kWindow); y <= std::min(extent.height - 1, p.y + kWindow); ++y) {
    for (int x = std::max(0, p.x - kWindow); x <= std::min(extent.width - 1, p.x + kWindow); ++x)
      visit(Pixel{x, y});
  }
}

/// The vertices of a mesh whose images lie near some pixels, by the pixel that they lie in.
class VerticesByPixel {
 public:
  VerticesByPixel(const TriangleMesh& mesh, const View& view, std::span<const Pixel> pixels)
      : first_(view.extent(), kNone) {
    Mask wanted(view.extent(), 0);
    for (const Pixel p : pixels)
      for_each_pixel_around(view.extent(), p, [&](Pixel q) { wanted[q] = 1; });
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      if (view.is_perspective() && !(view.depth_of(mesh.positions[v]) > 0.0)) continue;
      const Vec3 window = view.window_from_world(mesh.positions[v]);
      if (!(window.x >= 0.0 && window.x < view.extent().width)) continue;
      if (!(window.y >= 0.0 && window.y < view.extent().height)) continue;
      const Pixel q{static_cast<int>(window.x), static_cast<int>(window.y)};
      if (wanted[q] == 0) continue;
      entries_.push_back({.vertex = v, .next = first_[q]});
      first_[q] = static_cast<std::uint32_t>(entries_.size() - 1);
    }
  }

  template <class Visit>
  void for_each_around(Pixel p, const Visit& visit) const {
    for_each_pixel_around(first_.extent(), p, [&](Pixel q) {
      for (std::uint32_t i = first_[q]; i != kNone; i = entries_[i].next)
        visit(entries_[i].vertex);
    });
  }

 private:
  static constexpr std::uint32_t kNone = 0xffff'ffffU;

  struct Entry {
    std::uint32_t vertex = 0;
    std::uint32_t next = kNone;  ///< entry of the same pixel
  };

  Grid<std::uint32_t> first_;  ///< entry of each pixel
  std::vector<Entry> entries_;
};

/// The nearest of `found` and of what a walk from the faces around the vertices nearby reaches.
NearestFace search_around(const VerticesByPixel& vertices, const RangeImage& image, Pixel p,
                          const TriangleMesh& mesh, const OutgoingEdges& edges,
                          const NearestFace& found) {
  const Vec3 position = image.position(p);
  const double radius = std::sqrt(found.squared_distance) + kFaceReach * image.pixel_size(p);
  NearestFace nearest = found;
  vertices.for_each_around(p, [&](std::uint32_t vertex) {
    const Vec3 offset = mesh.positions[vertex] - position;
    if (glm::dot(offset, offset) > radius * radius) return;
    edges.for_each_face_at(vertex, [&](std::uint32_t face) {
      const NearestFace candidate = measure_face(mesh, face, position);
      if (candidate.squared_distance < nearest.squared_distance) nearest = candidate;
    });
  });
  if (nearest == found) return found;
  return walk_to_nearest_face(mesh, edges, nearest.face, position);
}

/// What the walks lead to, within `reach` pixel sides.
Grid<NearestFace> walk_to_samples(const Grid<PrimitiveId>& seen, const RangeImage& image,
                                  const TriangleMesh& mesh, const OutgoingEdges& edges,
                                  double reach) {
  Grid<NearestFace> found(image.extent(), kNothing);
  for_each_row(image.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (!image.has_sample(p) || seen[p] == kNoPrimitive) continue;
      const NearestFace nearest = walk_from_seen_faces(seen, p, mesh, edges, image.position(p));
      const double limit = reach * image.pixel_size(p);
      if (nearest.squared_distance <= limit * limit) found[p] = nearest;
    }
  });
  return found;
}

/// Where a nearer face may be missed.
std::vector<Pixel> doubtful_samples(const Grid<NearestFace>& found, const RangeImage& image) {
  std::vector<Pixel> doubtful;
  for (int y = 0; y < image.extent().height; ++y) {
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (found[p].face == kNoPrimitive) continue;
      const double enough = kCloseEnough * image.pixel_size(p);
      if (found[p].squared_distance > enough * enough) doubtful.push_back(p);
    }
  }
  return doubtful;
}

}  // namespace

Grid<PrimitiveId> search_nearest_faces(const Grid<PrimitiveId>& seen, const RangeImage& image,
                                       const TriangleMesh& mesh, double reach) {
  const OutgoingEdges edges(mesh);
  Grid<NearestFace> found = walk_to_samples(seen, image, mesh, edges, reach);
  const std::vector<Pixel> doubtful = doubtful_samples(found, image);
  if (!doubtful.empty()) {
    const VerticesByPixel vertices(mesh, image.view(), doubtful);
    parallel_for(doubtful.size(), kSamplesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Pixel p = doubtful[i];
        found[p] = search_around(vertices, image, p, mesh, edges, found[p]);
      }
    });
  }
  Grid<PrimitiveId> faces(image.extent(), kNoPrimitive);
  std::transform(found.pixels().begin(), found.pixels().end(), faces.pixels().begin(),
                 [](const NearestFace& nearest) { return nearest.face; });
  return faces;
}

}  // namespace rangezip
