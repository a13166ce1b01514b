#include "core/stitch/zipper.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/mesh/edge_map.h"
#include "core/stitch/insert_segments.h"
#include "core/stitch/insert_vertices.h"
#include "core/stitch/patch_sheet.h"
#include "core/stitch/remove_covered.h"
#include "core/stitch/sheet_mesh.h"

namespace rangezip {

namespace {

/// In pixel sides: how much farther than the nearest face one may be that a vertex is put into.
constexpr double kSlack = 0.1;

bool meets_patch(const Triangle& face, const ImagePlane& image, const PatchSheet& sheet) {
  const bool is_visible =
      std::all_of(face.begin(), face.end(), [&](std::uint32_t v) { return image.has_image(v); });
  const GridPoint lower = grid_point(sheet.first_pixel());
  const GridPoint upper = grid_point(sheet.last_pixel());
  const GridPoint& a = image.points[face[0]];
  const GridPoint& b = image.points[face[1]];
  const GridPoint& c = image.points[face[2]];
  return is_visible && std::min({a.x, b.x, c.x}) <= upper.x &&
         std::max({a.x, b.x, c.x}) >= lower.x && std::min({a.y, b.y, c.y}) <= upper.y &&
         std::max({a.y, b.y, c.y}) >= lower.y;
}

/// Marks the old faces whose box in the image meets the patch's, which the steps may change, and
/// all that have two of their vertices: a flip must know every edge between those.
std::vector<std::uint8_t> faces_near_patch(const Joint& joint, const PatchSheet& sheet) {
  std::vector<std::uint8_t> marked(joint.old_faces, 0);
  std::vector<std::uint8_t> is_corner(joint.mesh.positions.size(), 0);
  for (std::size_t f = 0; f < joint.old_faces; ++f) {
    const Triangle& face = joint.mesh.triangles[f];
    if (!meets_patch(face, joint.image, sheet)) continue;
    marked[f] = 1;
    for (const std::uint32_t v : face)
      is_corner[v] = 1;
  }
  for (std::size_t f = 0; f < joint.old_faces; ++f) {
    const Triangle& face = joint.mesh.triangles[f];
    if (is_corner[face[0]] + is_corner[face[1]] + is_corner[face[2]] >= 2) marked[f] = 1;
  }
  return marked;
}

/// The directed boundary edges of the patch, by its own vertices.
std::vector<std::array<std::uint32_t, 2>> boundary_of(const Patch& patch, const PatchSheet& sheet) {
  std::vector<std::array<std::uint32_t, 2>> boundary;
  for (const Triangle& t : patch.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k];
      const std::uint32_t to = t[(k + 1) % 3];
      if (sheet.is_boundary(patch.pixels[from], patch.pixels[to])) boundary.push_back({from, to});
    }
  }
  return boundary;
}

/// The place of a number in an ascending list; kNoPrimitive if it is not there.
PrimitiveId rank_of(PrimitiveId number, std::span<const std::uint32_t> numbers) {
  const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
  if (found == numbers.end() || *found != number) return kNoPrimitive;
  return static_cast<PrimitiveId>(found - numbers.begin());
}

std::array<Pixel, 10> pixel_and_neighbours(Pixel pixel) {
  std::array<Pixel, 10> pixels{pixel};
  for (int k = 0; k < 9; ++k)
    pixels[static_cast<std::size_t>(k) + 1] = {pixel.x + k % 3 - 1, pixel.y + k / 3 - 1};
  return pixels;
}

class Zipper {
 public:
  Zipper(Joint& joint, const PatchScan& scan, const StitchOptions& options, StitchReport& report,
         StitchRecord& record)
      : joint_(joint),
        scan_(scan),
        options_(options),
        report_(report),
        record_(record),
        patch_sheet_(scan, sheet_radius(options)),
        cut_(faces_near_patch(joint, patch_sheet_)),
        sheet_(cut_out(joint.mesh, cut_)),
        boundary_(boundary_of(scan.patch, patch_sheet_)) {
    set_image(sheet_, joint.image);
  }

  void insert_vertices();
  void insert_segments();
  void remove_covered();
  void join();

 private:
  [[nodiscard]] std::vector<std::uint32_t> boundary_vertices() const;
  [[nodiscard]] std::vector<SheetMesh::FaceHandle> start_faces(
      std::span<const std::uint32_t> vertices) const;
  [[nodiscard]] PrimitiveId old_face_at(Pixel pixel) const;
  [[nodiscard]] double distance_to_old(std::uint32_t patch_vertex) const;
  void merge(std::uint32_t patch_vertex, std::uint32_t old_vertex);
  [[nodiscard]] std::vector<Triangle> faces_beside_patch();

  Joint& joint_;
  const PatchScan& scan_;
  const StitchOptions& options_;
  StitchReport& report_;
  StitchRecord& record_;
  PatchSheet patch_sheet_;
  std::vector<std::uint8_t> cut_;  ///< per old face: in the sheet
  SheetMesh sheet_;
  std::vector<std::array<std::uint32_t, 2>> boundary_;
  std::vector<SheetMesh::VertexHandle>
      handles_;  ///< per vertex of the patch; invalid: not in sheet
};

/// Each vertex of the boundary once, in the order of the patch.
std::vector<std::uint32_t> Zipper::boundary_vertices() const {
  std::vector<std::uint32_t> vertices;
  for (const auto& edge : boundary_)
    vertices.insert(vertices.end(), edge.begin(), edge.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// The corresponding faces, by their numbers in the sheet. On the end of the old surface a sample
/// may have none while a neighbour has.
std::vector<SheetMesh::FaceHandle> Zipper::start_faces(
    std::span<const std::uint32_t> vertices) const {
  std::vector<SheetMesh::FaceHandle> faces;
  for (const std::uint32_t v : vertices) {
    SheetMesh::FaceHandle face;
    for (const Pixel p : pixel_and_neighbours(scan_.patch.pixels[v])) {
      const PrimitiveId in_sheet = rank_of(old_face_at(p), sheet_.face_in_whole);
      if (in_sheet == kNoPrimitive) continue;
      face = SheetMesh::FaceHandle(static_cast<int>(in_sheet));
      break;
    }
    faces.push_back(face);
  }
  return faces;
}

/// The face of the old surface that corresponds to a sample: the nearest one. kNoPrimitive: none.
PrimitiveId Zipper::old_face_at(Pixel pixel) const {
  if (!scan_.image.extent().contains(pixel)) return kNoPrimitive;
  const PrimitiveId face = scan_.seen_face[pixel];
  return scan_.face_in_seen.empty() ? face : rank_of(face, scan_.face_in_seen);
}

/// Of a vertex of the patch from the nearest face that corresponds to it or a neighbour; infinite
/// without any.
double Zipper::distance_to_old(std::uint32_t patch_vertex) const {
  const Vec3& position = joint_.mesh.positions[joint_.first_new + patch_vertex];
  double least = std::numeric_limits<double>::infinity();
  for (const Pixel p : pixel_and_neighbours(scan_.patch.pixels[patch_vertex])) {
    const PrimitiveId face = old_face_at(p);
    if (face != kNoPrimitive)
      least = std::min(least, distance_to_face(joint_.mesh, face, position));
  }
  return least;
}

/// The vertex of the patch becomes one with an old one that has the same image.
void Zipper::merge(std::uint32_t patch_vertex, std::uint32_t old_vertex) {
  const std::uint32_t new_vertex = joint_.first_new + patch_vertex;
  joint_.vertex_of_patch[patch_vertex] = old_vertex;
  joint_.mesh.positions[old_vertex] = joint_.mesh.positions[new_vertex];
  joint_.image.depths[old_vertex] = joint_.image.depths[new_vertex];
  if (!joint_.mesh.sources.empty()) {
    joint_.mesh.sources[old_vertex] = joint_.mesh.sources[new_vertex];
  }
}

void Zipper::insert_vertices() {
  const std::vector<std::uint32_t> vertices = boundary_vertices();
  std::vector<BoundaryVertex> to_insert;
  for (const std::uint32_t v : vertices) {
    const std::uint32_t index = joint_.first_new + v;
    const double depth = joint_.image.depths[index];
    to_insert.push_back(
        {.index = index,
         .pixel = scan_.patch.pixels[v],
         .position = joint_.mesh.positions[index],
         .depth = depth,
         .reach = distance_to_old(v) + kSlack * scan_.image.view().pixel_size(depth)});
  }
  const InsertedVertices inserted = insert_boundary_vertices(
      sheet_, joint_.mesh, to_insert, start_faces(vertices), patch_sheet_, options_.band);
  handles_.resize(scan_.patch.pixels.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    handles_[vertices[i]] = inserted.handles[i];
    if (!inserted.handles[i].is_valid()) continue;
    record_.vertices.push_back({.patch_vertex = vertices[i], .old_face = inserted.faces[i]});
    const auto local = static_cast<std::size_t>(inserted.handles[i].idx());
    const std::uint32_t index = sheet_.vertex_in_whole[local];
    if (index < joint_.first_new) merge(vertices[i], index);
  }
  report_.inserted_vertices = inserted.inserted;
  report_.skipped_vertices = vertices.size() - inserted.inserted;
}

void Zipper::insert_segments() {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<SheetMesh::VertexHandle, 2>> segments;
  for (const auto& [from, to] : boundary_) {
    if (!handles_[from].is_valid() || !handles_[to].is_valid()) continue;
    edges.push_back({from, to});
    segments.push_back({handles_[from], handles_[to]});
  }
  const InsertedSegments inserted = insert_boundary_segments(sheet_, segments);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (inserted.is_edge[i] != 0) record_.segments.push_back(edges[i]);
  }
  report_.inserted_segments = inserted.inserted;
  report_.skipped_segments = boundary_.size() - inserted.inserted;
  report_.flipped_edges = inserted.flips;
}

void Zipper::remove_covered() {
  report_.removed_faces = remove_covered_faces(sheet_, patch_sheet_, options_.band);
}

/// The faces left in the sheet, without those that claim a side of an edge that the patch itself
/// takes: remains under a segment that could not be inserted, or on a sheet beyond the band.
std::vector<Triangle> Zipper::faces_beside_patch() {
  EdgeMap of_patch(3 * boundary_.size());
  for (const Triangle& t : scan_.patch.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k];
      const std::uint32_t to = t[(k + 1) % 3];
      if (!handles_[from].is_valid() || !handles_[to].is_valid()) continue;
      of_patch.insert(joint_.vertex_of_patch[from], joint_.vertex_of_patch[to], 0);
    }
  }
  std::vector<Triangle> faces = faces_in_whole(sheet_);
  std::erase_if(faces, [&](const Triangle& face) {
    bool is_taken = false;
    for (std::size_t k = 0; k < 3; ++k) {
      is_taken = is_taken || of_patch.find(face[k], face[(k + 1) % 3]) != EdgeMap::kNone;
    }
    for (const std::uint32_t v : face)
      joint_.touched[v] |= is_taken ? 1 : 0;
    return is_taken;
  });
  return faces;
}

/// Puts the sheet back into the whole and the patch beside it.
void Zipper::join() {
  for (const auto vertex : sheet_.mesh.vertices()) {  // fans can only part where there is an end
    const auto local = static_cast<std::size_t>(vertex.idx());
    if (sheet_.mesh.is_boundary(vertex)) joint_.touched[sheet_.vertex_in_whole[local]] = 1;
  }
  remove_triangles(joint_.mesh.triangles, cut_);
  const std::vector<Triangle> faces = faces_beside_patch();
  report_.removed_faces += sheet_.mesh.n_faces() - faces.size();
  joint_.mesh.triangles.insert(joint_.mesh.triangles.end(), faces.begin(), faces.end());
  joint_.old_faces = joint_.mesh.triangles.size();
  add_patch_faces(joint_, scan_.patch, report_);
}

}  // namespace

Joint zipper(TriangleMesh mesh, const PatchScan& scan, const StitchOptions& options,
             StitchReport& report, StitchRecord& record) {
  Joint joint = begin_joint(std::move(mesh), scan, options.view);
  Zipper zip(joint, scan, options, report, record);
  zip.insert_vertices();
  zip.insert_segments();
  zip.remove_covered();
  zip.join();
  fill_seam(joint, scan, PatchSheet(scan, sheet_radius(options)), options, report);
  return joint;
}

}  // namespace rangezip
