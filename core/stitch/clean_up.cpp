#include "core/stitch/clean_up.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "core/base/disjoint_sets.h"

namespace rangezip {

namespace {

/// Fans of at most this many faces are crumbs of the strip or of cut old faces.
constexpr std::uint32_t kSmallFan = 2;

/// A vertex that parts from a fan moves this share of the way to the middle of the fan's others.
constexpr double kPartingShare = 1.0 / 16.0;

/// Removing a fan can part another one; after these rounds what is left is split.
constexpr int kRounds = 5;

/// The faces around each touched vertex, in the order of their indices.
class Stars {
 public:
  Stars(const TriangleMesh& mesh, const std::vector<std::uint8_t>& touched)
      : begins_(mesh.positions.size() + 1, 0) {
    for (const Triangle& face : mesh.triangles) {
      for (const std::uint32_t v : face)
        begins_[v + 1] += touched[v];
    }
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    faces_.resize(begins_.back());
    std::vector<std::uint32_t> ends = begins_;
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
      for (const std::uint32_t v : mesh.triangles[f]) {
        if (touched[v] != 0) faces_[ends[v]++] = f;
      }
    }
  }

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t vertex) const {
    return std::span(faces_).subspan(begins_[vertex], begins_[vertex + 1] - begins_[vertex]);
  }

 private:
  std::vector<std::uint32_t> begins_;
  std::vector<std::uint32_t> faces_;
};

std::size_t corner_of(const Triangle& face, std::uint32_t vertex) {
  return face[0] == vertex ? 0 : face[1] == vertex ? 1 : 2;
}

/// The fans around one vertex: faces of a star that are joined over edges at the vertex.
class Fans {
 public:
  void find(const TriangleMesh& mesh, std::uint32_t vertex, std::span<const std::uint32_t> star) {
    const auto count = static_cast<std::uint32_t>(star.size());
    sets_.reset(count);
    leaving_.clear();
    arriving_.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      const Triangle& face = mesh.triangles[star[i]];
      leaving_.push_back({face[(corner_of(face, vertex) + 1) % 3], i});
      arriving_.push_back(face[(corner_of(face, vertex) + 2) % 3]);
    }
    std::sort(leaving_.begin(), leaving_.end());
    std::sort(arriving_.begin(), arriving_.end());
    for (std::uint32_t i = 0; i < count; ++i) {
      const Triangle& face = mesh.triangles[star[i]];
      const std::uint32_t arriving = face[(corner_of(face, vertex) + 2) % 3];
      const auto other = std::lower_bound(leaving_.begin(), leaving_.end(),
                                          std::pair<std::uint32_t, std::uint32_t>{arriving, 0});
      if (other != leaving_.end() && other->first == arriving) sets_.join(i, other->second);
    }
    sizes_.assign(count, 0);
    fans_ = 0;
    largest_ = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (sizes_[sets_.find(i)]++ == 0) ++fans_;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      if (sizes_[i] > sizes_[largest_]) largest_ = i;
    }
  }

  [[nodiscard]] std::uint32_t count() const { return fans_; }
  /// Whether no two faces of the star leave the vertex along the same edge, or arrive along one.
  [[nodiscard]] bool has_each_edge_once() const {
    const auto is_same = [](const auto& a, const auto& b) { return a.first == b.first; };
    return std::adjacent_find(leaving_.begin(), leaving_.end(), is_same) == leaving_.end() &&
           std::adjacent_find(arriving_.begin(), arriving_.end()) == arriving_.end();
  }
  [[nodiscard]] std::uint32_t fan_of(std::uint32_t i) { return sets_.find(i); }
  [[nodiscard]] bool is_largest(std::uint32_t i) { return fan_of(i) == largest_; }
  [[nodiscard]] std::uint32_t size_of(std::uint32_t i) { return sizes_[fan_of(i)]; }

 private:
  DisjointSets sets_;
  std::vector<std::uint32_t> sizes_;  ///< by the lowest place in the star
  std::vector<std::pair<std::uint32_t, std::uint32_t>> leaving_;  ///< next corner, place in star
  std::vector<std::uint32_t> arriving_;                           ///< previous corners
  std::uint32_t fans_ = 0;
  std::uint32_t largest_ = 0;
};

bool has_marked_corner(const Triangle& face, const std::vector<std::uint8_t>& marked) {
  return !marked.empty() && std::any_of(face.begin(), face.end(), [&](std::uint32_t v) {
    return v < marked.size() && marked[v] != 0;
  });
}

/// One round of removing small fans; how many faces went. Their corners become touched.
std::size_t remove_small_fans(TriangleMesh& mesh, const Stars& stars,
                              std::vector<std::uint8_t>& touched,
                              const std::vector<std::uint8_t>& rim) {
  std::vector<std::uint8_t> removed(mesh.triangles.size(), 0);
  std::size_t count = 0;
  Fans fans;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const auto star = stars.of(v);
    if (star.size() < 2) continue;
    fans.find(mesh, v, star);
    if (fans.count() < 2) continue;
    for (std::uint32_t i = 0; i < star.size(); ++i) {
      if (fans.is_largest(i) || fans.size_of(i) > kSmallFan || removed[star[i]] != 0) continue;
      if (has_marked_corner(mesh.triangles[star[i]], rim)) continue;
      removed[star[i]] = 1;
      ++count;
    }
  }
  if (count == 0) return 0;
  for (std::size_t f = 0; f < removed.size(); ++f) {
    if (removed[f] == 0) continue;
    for (const std::uint32_t v : mesh.triangles[f])
      touched[v] = 1;
  }
  remove_triangles(mesh.triangles, removed);
  return count;
}

std::uint32_t copy_vertex(TriangleMesh& mesh, std::uint32_t vertex) {
  mesh.positions.push_back(Vec3(mesh.positions[vertex]));
  if (!mesh.sources.empty()) mesh.sources.push_back(VertexSource(mesh.sources[vertex]));
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// Moves the vertex of a fan that has parted from others towards the middle of the fan.
void move_into_fan(TriangleMesh& mesh, std::uint32_t vertex, std::span<const std::uint32_t> star) {
  Vec3 sum{0.0};
  double corners = 0.0;
  for (const std::uint32_t f : star) {
    const Triangle& face = mesh.triangles[f];
    if (std::find(face.begin(), face.end(), vertex) == face.end()) continue;
    const std::size_t k = corner_of(face, vertex);
    sum += mesh.positions[face[(k + 1) % 3]] + mesh.positions[face[(k + 2) % 3]];
    corners += 2.0;
  }
  Vec3& position = mesh.positions[vertex];
  position += kPartingShare * (sum / corners - position);
}

/// Gives every fan but the largest a vertex of its own; how many were made.
std::size_t split_fans(TriangleMesh& mesh, const Stars& stars, std::vector<std::uint8_t>& marks) {
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  Fans fans;
  std::vector<std::uint32_t> copies;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const auto star = stars.of(v);
    if (star.size() < 2) continue;
    fans.find(mesh, v, star);
    if (fans.count() < 2) continue;
    copies.assign(star.size(), v);
    for (std::uint32_t i = 0; i < star.size(); ++i) {
      if (fans.is_largest(i)) continue;
      std::uint32_t& copy = copies[fans.fan_of(i)];
      if (copy == v) {
        copy = copy_vertex(mesh, v);
        marks.push_back(std::uint8_t(marks[v]));
      }
      Triangle& face = mesh.triangles[star[i]];
      face[corner_of(face, v)] = copy;
    }
    std::sort(copies.begin(), copies.end());
    copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
    for (const std::uint32_t copy : copies) {
      if (copy != v) move_into_fan(mesh, copy, star);
    }
  }
  return mesh.positions.size() - vertices;
}

void drop_small_components(TriangleMesh& mesh, const std::vector<std::uint8_t>& touched,
                           std::size_t min_component, const std::vector<std::uint8_t>& rim,
                           std::size_t kept, CleanUpReport& report) {
  DisjointSets pieces(mesh.positions.size());
  for (const Triangle& face : mesh.triangles) {
    pieces.join(face[0], face[1]);
    pieces.join(face[1], face[2]);
  }
  std::vector<std::uint32_t> faces(mesh.positions.size(), 0);
  for (const Triangle& face : mesh.triangles)
    ++faces[pieces.find(face[0])];
  for (std::uint32_t v = 0; v < std::max(rim.size(), kept); ++v) {
    const bool is_at_rim = v < rim.size() && rim[v] != 0;  // the rest of the piece is not known
    const bool stays = is_at_rim || (v < kept && faces[pieces.find(v)] > 0);
    if (stays) faces[pieces.find(v)] += static_cast<std::uint32_t>(min_component);
  }
  std::vector<std::uint8_t> is_touched(mesh.positions.size(), 0);
  for (std::uint32_t v = 0; v < touched.size(); ++v) {
    if (touched[v] != 0) is_touched[pieces.find(v)] = 1;
  }
  std::vector<std::uint8_t> is_small(mesh.positions.size(), 0);
  for (std::size_t v = 0; v < faces.size(); ++v) {
    if (faces[v] == 0 || faces[v] >= min_component || is_touched[v] == 0) continue;
    is_small[v] = 1;
    ++report.dropped_components;
    report.dropped_faces += faces[v];
  }
  if (report.dropped_components == 0) return;
  std::erase_if(mesh.triangles,
                [&](const Triangle& face) { return is_small[pieces.find(face[0])] != 0; });
}

}  // namespace

CleanUpReport clean_up(TriangleMesh& mesh, std::vector<std::uint8_t> touched,
                       std::vector<std::uint8_t>& marks, std::size_t min_component,
                       const std::vector<std::uint8_t>& rim, std::size_t kept) {
  CleanUpReport report;
  Stars stars(mesh, touched);
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t removed = remove_small_fans(mesh, stars, touched, rim);
    if (removed == 0) break;
    report.opened_fans += removed;
    stars = Stars(mesh, touched);
  }
  report.split_vertices = split_fans(mesh, stars, marks);
  touched.resize(mesh.positions.size(), 1);
  drop_small_components(mesh, touched, min_component, rim, kept, report);
  return report;
}

bool is_manifold_at(const TriangleMesh& mesh, const std::vector<std::uint8_t>& marked) {
  const Stars stars(mesh, marked);
  Fans fans;
  for (std::uint32_t v = 0; v < marked.size(); ++v) {
    const auto star = stars.of(v);
    if (star.empty()) continue;
    fans.find(mesh, v, star);
    if (fans.count() > 1 || !fans.has_each_edge_once()) return false;
  }
  return true;
}

}  // namespace rangezip
