#include "core/stitch/clear_and_fill.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/mesh/edge_map.h"
#include "core/stitch/clean_up.h"
#include "core/stitch/covered_faces.h"
#include "core/stitch/fill_strip.h"
#include "core/stitch/image_plane.h"
#include "core/stitch/patch_sheet.h"
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

/// Appends the vertices of the patch to those of the mesh, and their images.
void append_vertices(TriangleMesh& mesh, ImagePlane& image, const Patch& patch,
                     const RangeImage& range_image) {
  for (std::size_t i = 0; i < patch.pixels.size(); ++i) {
    mesh.positions.push_back(patch.mesh.positions[i]);
    image.points.push_back(grid_point(patch.pixels[i]));
    image.depths.push_back(range_image[patch.pixels[i]]);
  }
}

/// The state of one stitch, step by step. Vertices from first_new_ on are those of the patch.
class Stitcher {
 public:
  Stitcher(TriangleMesh mesh, const Scan& scan, const StitchOptions& options)
      : mesh_(std::move(mesh)),
        scan_(scan),
        options_(options),
        sheet_(scan,
               std::max(kMinRadius, static_cast<int>(std::ceil(options.max_gap)) + kRadiusMargin)),
        image_(project_to_image(mesh_.positions, scan.image.view())),
        first_new_(static_cast<std::uint32_t>(mesh_.positions.size())) {}

  void clear();
  void append_patch();
  void fill();
  [[nodiscard]] StitchResult finish();

 private:
  [[nodiscard]] bool is_near_sheet(std::uint32_t vertex) const;
  [[nodiscard]] bool looks_at_viewer(const Triangle& face) const;
  void add_old_boundary(std::vector<SeamSegment>& segments, EdgeMap& edges);
  void add_patch_boundary(std::vector<SeamSegment>& segments);
  void enter_patch_edges(EdgeMap& edges) const;

  TriangleMesh mesh_;
  const Scan& scan_;
  const StitchOptions& options_;
  PatchSheet sheet_;
  ImagePlane image_;
  std::uint32_t first_new_;
  std::size_t old_faces_ = 0;          ///< faces that stay, the first ones of mesh_
  std::vector<std::uint8_t> touched_;  ///< per vertex: faces around it came or went
  StitchReport report_;
};

/// Removes what the patch covers.
void Stitcher::clear() {
  const std::vector<std::uint8_t> covered = find_covered_faces(
      mesh_, image_, sheet_, {.band = options_.band, .clearance = options_.clearance});
  touched_.assign(mesh_.positions.size() + scan_.patch.pixels.size(), 0);
  for (std::size_t f = 0; f < covered.size(); ++f) {
    const Triangle& face = mesh_.triangles[f];
    if (covered[f] == 0) {
      mesh_.triangles[old_faces_++] = face;
      continue;
    }
    for (const std::uint32_t v : face)
      touched_[v] = 1;
  }
  report_.removed_faces = covered.size() - old_faces_;
  mesh_.triangles.resize(old_faces_);
}

void Stitcher::append_patch() {
  append_vertices(mesh_, image_, scan_.patch, scan_.image);
  for (const Triangle& t : scan_.patch.mesh.triangles) {
    mesh_.triangles.push_back({first_new_ + t[0], first_new_ + t[1], first_new_ + t[2]});
  }
  report_.patch_faces = scan_.patch.mesh.triangles.size();
}

/// Whether an old vertex lies on the continuation of the patch's sheet.
bool Stitcher::is_near_sheet(std::uint32_t vertex) const {
  if (!image_.has_image(vertex)) return false;
  const GridPoint& point = image_.points[vertex];
  const Pixel pixel = nearest_pixel(point);
  const SheetSample& sample = sheet_[pixel];
  if (sample.ring >= sheet_.radius()) return false;  // unknown ones as well
  const double side = sheet_.image().view().pixel_size(sample.depth);
  const double tolerance =
      side * (kContinuedBand * options_.band * sample.stretch + kContinuedTolerance);
  const double expected = sheet_.depth_at(in_pixels(point), pixel);
  return std::abs(image_.depths[vertex] - expected) <= tolerance;
}

bool Stitcher::looks_at_viewer(const Triangle& face) const {
  return orientation(image_.points[face[0]], image_.points[face[1]], image_.points[face[2]]) > 0;
}

/// Adds the boundary edges of the old surface whose ends lie on the sheet and whose face looks at
/// the viewer; enters all edges between such vertices.
void Stitcher::add_old_boundary(std::vector<SeamSegment>& segments, EdgeMap& edges) {
  std::vector<std::uint8_t> is_near(first_new_, 0);
  for (std::uint32_t v = 0; v < first_new_; ++v)
    is_near[v] = is_near_sheet(v) ? 1 : 0;
  const auto for_each_near_edge = [&](const auto& body) {
    for (std::uint32_t f = 0; f < old_faces_; ++f) {
      const Triangle& face = mesh_.triangles[f];
      if (is_near[face[0]] + is_near[face[1]] + is_near[face[2]] < 2) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = face[k];
        const std::uint32_t to = face[(k + 1) % 3];
        if (is_near[from] != 0 && is_near[to] != 0) body(from, to, f);
      }
    }
  };
  for_each_near_edge([&](std::uint32_t from, std::uint32_t to, std::uint32_t f) {
    if (!edges.insert(from, to, f)) {
      throw TopologyError("stitch: mesh must be oriented and manifold, but edge " +
                          std::to_string(from) + " -> " + std::to_string(to) + " has two faces");
    }
  });
  for_each_near_edge([&](std::uint32_t from, std::uint32_t to, std::uint32_t f) {
    const bool is_boundary = edges.find(to, from) == EdgeMap::kNone;
    if (is_boundary && looks_at_viewer(mesh_.triangles[f])) segments.push_back({from, to});
  });
}

void Stitcher::add_patch_boundary(std::vector<SeamSegment>& segments) {
  const std::vector<Pixel>& pixels = scan_.patch.pixels;
  for (const Triangle& t : scan_.patch.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k];
      const std::uint32_t to = t[(k + 1) % 3];
      if (sheet_.has_edge(pixels[to], pixels[from])) continue;
      segments.push_back({first_new_ + from, first_new_ + to});
      touched_[first_new_ + from] = touched_[first_new_ + to] = 1;
    }
  }
}

/// Enters the edges of the patch between vertices of its boundary: the strip touches no others.
void Stitcher::enter_patch_edges(EdgeMap& edges) const {
  for (std::size_t f = old_faces_; f < mesh_.triangles.size(); ++f) {
    const Triangle& face = mesh_.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = face[k];
      const std::uint32_t to = face[(k + 1) % 3];
      if (touched_[from] != 0 && touched_[to] != 0) {
        edges.insert(from, to, static_cast<std::uint32_t>(f));
      }
    }
  }
}

void Stitcher::fill() {
  std::vector<SeamSegment> segments;
  EdgeMap edges;
  add_patch_boundary(segments);
  const std::size_t first_optional = segments.size();
  enter_patch_edges(edges);
  add_old_boundary(segments, edges);
  drop_conflicting_segments(segments, first_optional, image_.points);

  const Seam seam{.positions = mesh_.positions,
                  .image = image_,
                  .sheet = sheet_,
                  .first_new = first_new_,
                  .segments = segments,
                  .old_faces = std::span(mesh_.triangles).first(old_faces_)};
  const FilledStrip strip =
      fill_strip(seam, edges, static_cast<std::uint32_t>(mesh_.triangles.size()),
                 {.max_gap = options_.max_gap, .min_strip_cosine = options_.min_strip_cosine});
  report_.strip_faces = strip.faces.size();
  report_.rejected_strip_faces = strip.rejected_faces;
  for (const Triangle& face : strip.faces) {
    for (const std::uint32_t v : face)
      touched_[v] = 1;
    mesh_.triangles.push_back(face);
  }
}

StitchResult Stitcher::finish() {
  if (!mesh_.sources.empty()) {
    for (const Pixel p : scan_.patch.pixels) {
      mesh_.sources.push_back({scan_.scene_buffer.id[p], options_.view});
    }
  }
  const CleanUpReport cleaned = clean_up(mesh_, std::move(touched_), options_.min_component);
  report_.opened_fans = cleaned.opened_fans;
  report_.split_vertices = cleaned.split_vertices;
  report_.dropped_components = cleaned.dropped_components;
  report_.dropped_faces = cleaned.dropped_faces;
  return {std::move(mesh_), report_};
}

}  // namespace

StitchResult clear_and_fill(TriangleMesh mesh, const Scan& scan, const StitchOptions& options) {
  Stitcher stitcher(std::move(mesh), scan, options);
  stitcher.clear();
  stitcher.append_patch();
  stitcher.fill();
  return stitcher.finish();
}

}  // namespace rangezip
