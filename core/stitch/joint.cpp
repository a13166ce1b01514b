#include "core/stitch/joint.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/base/error.h"
#include "core/mesh/edge_map.h"
#include "core/stitch/fill_strip.h"
#include "core/stitch/seam_segments.h"

namespace rangezip {

namespace {

/// The old boundary is looked for this much farther than the longest strip edge, pixels.
constexpr int kRadiusMargin = 2;
constexpr int kMinRadius = 5;

/// An old vertex belongs to the continued sheet within this share of the band, plus this many
/// pixel sides: the continuation is less certain than the patch.
constexpr double kContinuedBand = 1.5;
constexpr double kContinuedTolerance = 0.3;

/// Collects the open edges on both sides of the seam.
class SeamEdges {
 public:
  SeamEdges(Joint& joint, const PatchScan& scan, const PatchSheet& sheet, double band)
      : joint_(joint), scan_(scan), sheet_(sheet), band_(band) {}

  void find();

  std::vector<SeamSegment> segments;  ///< of the patch, then of the old surface
  std::size_t patch_segments = 0;
  EdgeMap edges;  ///< all directed edges that a strip face could meet

 private:
  [[nodiscard]] bool is_near_sheet(std::uint32_t vertex) const;
  [[nodiscard]] bool looks_at_viewer(const Triangle& face) const;
  void mark_patch_boundary();
  void enter_old_edges();
  void enter_patch_edges();
  void find_open_patch_edges();
  void find_open_old_edges();
  void find_outline_of_removed_faces();

  template <class Body>
  void for_each_near_old_edge(const Body& body) const {
    for (std::uint32_t f = 0; f < joint_.old_faces; ++f) {
      const Triangle& face = joint_.mesh.triangles[f];
      if (is_near_[face[0]] + is_near_[face[1]] + is_near_[face[2]] < 2) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = face[k];
        const std::uint32_t to = face[(k + 1) % 3];
        if (is_near_[from] != 0 && is_near_[to] != 0) body(from, to, f);
      }
    }
  }

  Joint& joint_;
  const PatchScan& scan_;
  const PatchSheet& sheet_;
  double band_;
  std::vector<std::uint8_t> is_near_;        ///< per vertex: on the sheet, close to the patch
  std::vector<SeamSegment> patch_boundary_;  ///< by vertices of the joint
};

bool SeamEdges::is_near_sheet(std::uint32_t vertex) const {
  if (!joint_.image.has_image(vertex)) return false;
  const GridPoint& point = joint_.image.points[vertex];
  const Pixel pixel = nearest_pixel(point);
  const SheetSample& sample = sheet_[pixel];
  if (sample.ring >= sheet_.radius()) return false;  // unknown ones as well
  const double side = sheet_.image().view().pixel_size(sample.depth);
  const double tolerance = side * (kContinuedBand * band_ * sample.stretch + kContinuedTolerance);
  const double expected = sheet_.depth_at(in_pixels(point), pixel);
  return std::abs(joint_.image.depths[vertex] - expected) <= tolerance;
}

bool SeamEdges::looks_at_viewer(const Triangle& face) const {
  const auto& points = joint_.image.points;
  return orientation(points[face[0]], points[face[1]], points[face[2]]) > 0;
}

void SeamEdges::mark_patch_boundary() {
  const std::vector<Pixel>& pixels = scan_.patch.pixels;
  for (const Triangle& t : scan_.patch.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k];
      const std::uint32_t to = t[(k + 1) % 3];
      if (!sheet_.is_boundary(pixels[from], pixels[to])) continue;
      const SeamSegment edge{joint_.vertex_of_patch[from], joint_.vertex_of_patch[to]};
      patch_boundary_.push_back(edge);
      for (const std::uint32_t v : edge)
        is_near_[v] = joint_.touched[v] = joint_.seam[v] = 1;
    }
  }
}

void SeamEdges::enter_old_edges() {
  for_each_near_old_edge([&](std::uint32_t from, std::uint32_t to, std::uint32_t f) {
    if (!edges.insert(from, to, f)) {
      throw TopologyError("stitch: mesh must be oriented and manifold, but edge " +
                          std::to_string(from) + " -> " + std::to_string(to) + " has two faces");
    }
  });
}

/// Enters the edges of the patch between vertices of its boundary: the strip touches no others.
void SeamEdges::enter_patch_edges() {
  for (std::size_t f = joint_.old_faces; f < joint_.mesh.triangles.size(); ++f) {
    const Triangle& face = joint_.mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = face[k];
      const std::uint32_t to = face[(k + 1) % 3];
      if (is_near_[from] != 0 && is_near_[to] != 0) {
        edges.insert(from, to, static_cast<std::uint32_t>(f));
      }
    }
  }
}

void SeamEdges::find_open_patch_edges() {
  for (const SeamSegment& edge : patch_boundary_) {
    if (edges.find(edge[1], edge[0]) == EdgeMap::kNone) segments.push_back(edge);
  }
  patch_segments = segments.size();
}

void SeamEdges::find_open_old_edges() {
  for_each_near_old_edge([&](std::uint32_t from, std::uint32_t to, std::uint32_t f) {
    const bool is_open = edges.find(to, from) == EdgeMap::kNone;
    if (is_open && looks_at_viewer(joint_.mesh.triangles[f])) segments.push_back({from, to});
  });
}

/// Where a removed wide face was the end of the old surface, its own edge bounds what may be
/// filled.
void SeamEdges::find_outline_of_removed_faces() {
  EdgeMap removed(3 * joint_.removed_wide_faces.size());
  const auto for_each_edge = [&](const auto& body) {
    for (const Triangle& face : joint_.removed_wide_faces) {
      for (std::size_t k = 0; k < 3; ++k)
        body(face[k], face[(k + 1) % 3]);
    }
  };
  for_each_edge([&](std::uint32_t from, std::uint32_t to) { removed.insert(from, to, 0); });
  for_each_edge([&](std::uint32_t from, std::uint32_t to) {
    const bool is_inside = removed.find(to, from) != EdgeMap::kNone;
    const bool has_neighbour = edges.find(to, from) != EdgeMap::kNone;
    if (!is_inside && !has_neighbour) segments.push_back({from, to});
  });
}

void SeamEdges::find() {
  is_near_.assign(joint_.mesh.positions.size(), 0);
  for (std::uint32_t v = 0; v < joint_.first_new; ++v)
    is_near_[v] = is_near_sheet(v) ? 1 : 0;
  for (const Triangle& face : joint_.removed_wide_faces) {
    for (const std::uint32_t v : face)
      is_near_[v] = 1;
  }
  mark_patch_boundary();
  enter_old_edges();
  enter_patch_edges();
  find_open_patch_edges();
  find_open_old_edges();
  find_outline_of_removed_faces();
}

/// Sources of the patch's vertices, which know of samples that no primitive made.
std::vector<VertexSource> sources_of(const Patch& patch, std::uint32_t view) {
  std::vector<VertexSource> sources = patch.mesh.sources;
  sources.resize(patch.mesh.positions.size());  // where the patch records none
  for (VertexSource& source : sources)
    source.view = view;
  return sources;
}

}  // namespace

Joint begin_joint(TriangleMesh mesh, const PatchScan& scan, std::uint32_t view) {
  Joint joint;
  joint.image = project_to_image(mesh.positions, scan.image.view());
  joint.first_new = static_cast<std::uint32_t>(mesh.positions.size());
  joint.old_faces = mesh.triangles.size();
  const bool has_sources = mesh.positions.empty() || !mesh.sources.empty();
  if (has_sources) {
    const std::vector<VertexSource> sources = sources_of(scan.patch, view);
    mesh.sources.insert(mesh.sources.end(), sources.begin(), sources.end());
  }
  const std::vector<Pixel>& pixels = scan.patch.pixels;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    mesh.positions.push_back(scan.patch.mesh.positions[i]);
    joint.image.points.push_back(grid_point(pixels[i]));
    joint.image.depths.push_back(scan.image[pixels[i]]);
  }
  joint.mesh = std::move(mesh);
  joint.vertex_of_patch.resize(pixels.size());
  std::iota(joint.vertex_of_patch.begin(), joint.vertex_of_patch.end(), joint.first_new);
  joint.touched.assign(joint.mesh.positions.size(), 0);
  joint.seam = joint.touched;
  return joint;
}

void remove_old_faces(Joint& joint, const std::vector<std::uint8_t>& marked, StitchReport& report) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < joint.old_faces; ++f) {
    const Triangle face = joint.mesh.triangles[f];
    if (marked[f] == 0) {
      joint.mesh.triangles[kept++] = face;
      continue;
    }
    for (const std::uint32_t v : face)
      joint.touched[v] = 1;
    if (longest_side_in_image(face, joint.image) > kWideFace) {
      joint.removed_wide_faces.push_back(face);
    }
  }
  report.removed_faces += joint.old_faces - kept;
  joint.old_faces = kept;
  joint.mesh.triangles.resize(kept);
}

void add_patch_faces(Joint& joint, const Patch& patch, StitchReport& report) {
  const auto& vertex = joint.vertex_of_patch;
  for (const Triangle& t : patch.mesh.triangles) {
    joint.mesh.triangles.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
  }
  report.patch_faces = patch.mesh.triangles.size();
}

void fill_seam(Joint& joint, const PatchScan& scan, const PatchSheet& sheet,
               const StitchOptions& options, StitchReport& report) {
  SeamEdges seam(joint, scan, sheet, options.band);
  seam.find();
  drop_conflicting_segments(seam.segments, seam.patch_segments, joint.image.points);
  const WideFaces removed(joint.removed_wide_faces, joint.image);
  const FilledStrip strip =
      fill_strip({.positions = joint.mesh.positions,
                  .image = joint.image,
                  .sheet = sheet,
                  .removed = removed,
                  .first_new = joint.first_new,
                  .segments = seam.segments,
                  .old_faces = std::span(joint.mesh.triangles).first(joint.old_faces)},
                 seam.edges, static_cast<std::uint32_t>(joint.mesh.triangles.size()),
                 {.max_gap = options.max_gap,
                  .min_strip_cosine = options.min_strip_cosine,
                  .band = options.band});
  report.strip_faces = strip.faces.size();
  report.rejected_strip_faces = strip.rejected_faces;
  for (const Triangle& face : strip.faces) {
    for (const std::uint32_t v : face)
      joint.touched[v] = 1;
    joint.mesh.triangles.push_back(face);
  }
}

int sheet_radius(const StitchOptions& options) {
  return std::max(kMinRadius, static_cast<int>(std::ceil(options.max_gap)) + kRadiusMargin);
}

}  // namespace rangezip
