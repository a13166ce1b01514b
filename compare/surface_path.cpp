#include "compare/surface_path.h"

#include <algorithm>
#include <array>

#include "core/stitch/predicates.h"

namespace rangezip::compare {

namespace {

using Edge = std::array<std::uint32_t, 2>;

constexpr std::size_t kMostFaces = 10'000;  ///< of one path; more is a walk in circles

Edge edge_of(const Triangle& face, std::size_t k) {
  return {face[k], face[(k + 1) % 3]};
}

/// What a line from pixel to pixel needs to find its way.
class Line {
 public:
  Line(const ViewedMesh& seen, Pixel from, Pixel to)
      : seen_(seen), from_(grid_point(from)), to_(grid_point(to)) {}

  [[nodiscard]] std::optional<SurfacePath> follow(std::uint32_t start, std::uint32_t end) const;

 private:
  [[nodiscard]] const Triangle& face(std::uint32_t f) const { return seen_.mesh->triangles[f]; }
  [[nodiscard]] const GridPoint& point(std::uint32_t v) const { return seen_.image.points[v]; }
  [[nodiscard]] bool looks_at_viewer(std::uint32_t f) const;
  [[nodiscard]] bool holds(std::uint32_t f, const GridPoint& place) const;
  [[nodiscard]] std::vector<std::uint32_t> faces_at(std::uint32_t f, const GridPoint& place) const;
  [[nodiscard]] std::optional<Edge> exit_of(std::uint32_t f) const;
  [[nodiscard]] bool walk(std::uint32_t f, const std::vector<std::uint32_t>& ends,
                          SurfacePath& path) const;
  [[nodiscard]] double weight(double in_image, std::uint32_t vertex) const;
  [[nodiscard]] Vec3 position_in(std::uint32_t f, const GridPoint& place) const;
  [[nodiscard]] Vec3 crossing(const Edge& edge) const;
  [[nodiscard]] std::int64_t side(std::uint32_t v) const {
    return orientation(from_, to_, point(v));
  }

  const ViewedMesh& seen_;
  GridPoint from_, to_;
};

bool Line::looks_at_viewer(std::uint32_t f) const {
  const auto& [a, b, c] = face(f);
  return seen_.image.has_image(a) && seen_.image.has_image(b) && seen_.image.has_image(c) &&
         orientation(point(a), point(b), point(c)) > 0;
}

bool Line::holds(std::uint32_t f, const GridPoint& place) const {
  const auto& [a, b, c] = face(f);
  return looks_at_viewer(f) && orientation(point(a), point(b), place) >= 0 &&
         orientation(point(b), point(c), place) >= 0 && orientation(point(c), point(a), place) >= 0;
}

/// The face and those that hold the place as well, on the same sheet: several if it lies on an edge
/// or a vertex.
std::vector<std::uint32_t> Line::faces_at(std::uint32_t f, const GridPoint& place) const {
  std::vector<std::uint32_t> faces;
  if (holds(f, place)) faces.push_back(f);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = edge_of(face(faces[i]), k);
      const std::uint32_t next = seen_.edges.find(b, a);
      if (next == OutgoingEdges::kNone || orientation(point(a), point(b), place) != 0) continue;
      const bool is_known = std::find(faces.begin(), faces.end(), next) != faces.end();
      if (!is_known && holds(next, place)) faces.push_back(next);
    }
  }
  return faces;
}

/// The edge through which the line leaves a face: from its right to its left. Of a vertex on the
/// line it is on the right.
std::optional<Edge> Line::exit_of(std::uint32_t f) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Edge edge = edge_of(face(f), k);
    if (side(edge[0]) < 0 && side(edge[1]) >= 0) return edge;
  }
  return std::nullopt;
}

/// A share in the image as one in space, not yet divided by the sum of all.
double Line::weight(double in_image, std::uint32_t vertex) const {
  return seen_.view->is_perspective() ? in_image / seen_.image.depths[vertex] : in_image;
}

Vec3 Line::position_in(std::uint32_t f, const GridPoint& place) const {
  const Triangle& t = face(f);
  Vec3 position{0.0};
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [a, b] = edge_of(t, (k + 1) % 3);
    const double share = weight(static_cast<double>(orientation(point(a), point(b), place)), t[k]);
    position += share * seen_.mesh->positions[t[k]];
    sum += share;
  }
  return position / sum;
}

Vec3 Line::crossing(const Edge& edge) const {
  const auto& [right, left] = edge;
  const double of_right = weight(static_cast<double>(side(left)), right);
  const double of_left = weight(static_cast<double>(-side(right)), left);
  return (of_right * seen_.mesh->positions[right] + of_left * seen_.mesh->positions[left]) /
         (of_right + of_left);
}

/// From face to face until one of the `ends`.
bool Line::walk(std::uint32_t f, const std::vector<std::uint32_t>& ends, SurfacePath& path) const {
  for (std::size_t steps = 0; steps < kMostFaces && f != OutgoingEdges::kNone; ++steps) {
    path.faces.push_back(f);
    if (std::find(ends.begin(), ends.end(), f) != ends.end()) return true;
    if (!looks_at_viewer(f) || holds(f, to_)) return false;  // the end of another sheet
    const std::optional<Edge> exit = exit_of(f);
    if (!exit) return false;
    path.points.push_back(crossing(*exit));
    f = seen_.edges.find((*exit)[1], (*exit)[0]);
  }
  return false;
}

std::optional<SurfacePath> Line::follow(std::uint32_t start, std::uint32_t end) const {
  const std::vector<std::uint32_t> ends = faces_at(end, to_);
  if (ends.empty()) return std::nullopt;
  for (const std::uint32_t first : faces_at(start, from_)) {
    SurfacePath path{.points = {position_in(first, from_)}};
    if (!walk(first, ends, path)) continue;
    path.points.push_back(position_in(path.faces.back(), to_));
    return path;
  }
  return std::nullopt;
}

}  // namespace

double length_of(const std::vector<Vec3>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += glm::length(points[i] - points[i - 1]);
  return length;
}

ViewedMesh::ViewedMesh(const TriangleMesh& of_mesh, const View& of_view)
    : mesh(&of_mesh),
      view(&of_view),
      image(project_to_image(of_mesh.positions, of_view)),
      edges(of_mesh) {}

std::optional<SurfacePath> follow_line(const ViewedMesh& seen, const SeenPlace& from,
                                       const SeenPlace& to) {
  return Line(seen, from.pixel, to.pixel).follow(from.face, to.face);
}

}  // namespace rangezip::compare
