#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tests/support/random_sessions.h"

/// CGAL's verdict on the mesh after each command of a session. What is wrong is counted by cause.
namespace rangezip::sessions {

/// What can be wrong, each a number of elements. All zero is what the project promises.
struct Faults {
  std::size_t exceptions = 0;
  std::size_t not_manifold = 0;        ///< meshes, by CGAL: edges, vertices or orientation
  std::size_t misoriented_edges = 0;   ///< of those
  std::size_t self_intersections = 0;  ///< pairs, by CGAL
  std::size_t degenerate_faces = 0;    ///< by CGAL, exactly
  std::size_t lost_pixels = 0;   ///< of a scan's image, that showed the mesh before it was stitched
                                 ///< and show nothing after
  std::size_t lost_matches = 0;  ///< samples that lay on a face before and on none after
  std::size_t lost_points = 0;   ///< of the cloud, with a face within a pixel side before and none
                                 ///< within two after
  std::size_t changed_outside = 0;  ///< faces away from the patch that are not there after

  /// Name and count of each.
  [[nodiscard]] std::map<std::string, std::size_t> by_cause() const;
  [[nodiscard]] bool any() const;
};

/// One command, and what its mesh is like.
struct Step {
  std::string kind;  ///< "clear_and_fill", "zipper", "erase"
  Faults faults;
  std::string what;  ///< of the exception
};

struct Outcome {
  std::vector<Step> steps;
  std::size_t faces = 0;                       ///< of the last mesh
  std::map<std::string, std::size_t> repairs;  ///< faces that the stitches report as rolled back,
                                               ///< beside those of the patches that came in,
                                               ///< and patches, of them given up as a whole
};

/// Runs the session and judges the mesh after each command. A command that throws ends it.
[[nodiscard]] Outcome run_session(const RandomSession& session);

}  // namespace rangezip::sessions
