#pragma once

#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/sphere.h"
#include "core/finish/finish.h"
#include "core/scan/scan.h"
#include "core/stitch/stitch.h"

namespace rangezip {

/// A visibility vote; computed once per session for each distinct value.
struct VoteOptions {
  double pixel_size = 0.0;  ///< model units, of the scans; must be positive
  int directions = 40;

  friend bool operator==(const VoteOptions&, const VoteOptions&) = default;
};

/// Scans and stitches the patch into the mesh (the green lasso, or everything in view).
struct AddScan {
  ScanRequest scan;
  StitchOptions stitch;
  std::optional<VoteOptions> vote;  ///< absent, or without scan.plane_fit: no visibility vote
};

/// Deletes the faces seen inside a lasso (the red one) [Kobbelt, Botsch 2000, 3].
struct EraseRegion {
  Camera camera;  ///< its depth planes are fitted to the mesh
  Extent extent{1024, 1024};
  std::vector<Vec2> region;  ///< window coordinates; empty: all
  bool visible_only = true;  ///< false: also what lies behind
};

/// Deletes the faces with their centroid in one of the places, to scan these anew.
struct ErasePlaces {
  std::vector<Sphere> places;
};

/// Laplacian smoothing of all vertices that are not on the boundary [Kobbelt, Botsch 2000, Fig. 9].
struct SmoothMesh {
  int iterations = 1;
  double factor = 0.5;  ///< in (0, 1]: share of the way to the mean of the neighbours
};

/// Closes boundary loops up to a perimeter.
struct FillMeshHoles {
  double pixel_size = 0.0;  ///< length of new edges, model units; 0: as long as those around the
                            ///< hole
  double max_perimeter = std::numeric_limits<double>::infinity();  ///< model units
};

/// Drops the faces that no point of the scene lies near (core/finish/unsupported_faces.h): scans
/// that join samples over steps of depth make them across narrow gaps.
struct DropUnsupported {
  double pixel_size = 0.0;  ///< h, model units; 0: the mesh's mean edge length
};

/// The finish; projects onto the evidence_points() of the scene, but for layers that polygons have
/// behind the mesh (core/finish/hidden_layers.h).
struct FinishMesh {
  FinishOptions options;            ///< pixel_size 0: the mesh's mean edge length
  std::optional<VoteOptions> vote;  ///< tells which faces the points contradict; absent: none
};

/// Turns components that show their backs to where scanners stood
/// (core/session/turn_to_scanners.h).
struct TurnToScanners {
  std::vector<Vec3> scanners;  ///< positions, world coordinates
};

/// Takes back the last `count` commands (for hand-written sessions; Session::undo() otherwise).
struct UndoSteps {
  int count = 1;
};

/// One step of a session. Plain data: written to a session file, it can be played back.
using Command = std::variant<AddScan, EraseRegion, ErasePlaces, SmoothMesh, FillMeshHoles,
                             DropUnsupported, FinishMesh, TurnToScanners, UndoSteps>;

}  // namespace rangezip
