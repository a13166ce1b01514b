#pragma once

#include <optional>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/face_tree.h"
#include "core/finish/hole_filling.h"
#include "core/finish/point_grid.h"

namespace rangezip {

/// In h: loops up to this are a few pixels across; no point can tell what they are.
inline constexpr double kSmallPerimeter = 12.0;

struct HoleChoiceOptions {
  double pixel_size = 0.0;            ///< h, model units
  double max_hole_perimeter = 0.0;    ///< in h, of holes to close although no points lie there
  double narrow_width = 3.0;          ///< in h, of cracks
  bool is_sampled = false;            ///< the cloud has points wherever the surface was seen
  bool has_narrow_gaps = false;       ///< a short loop may be the outline of one wall of a gap
  bool open_sheet = false;            ///< even small pieces are seen from one side only, and open
  double noise = 0.0;                 ///< of these, standard deviation, model units
  bool leaves_gaps = false;           ///< of what is closed because of its points, where none are
  TriangulationMemo* memo = nullptr;  ///< as for fill_loop()
};

struct FillChoice {
  FillShape shape = FillShape::smooth;
  bool is_wall = false;      ///< of something thin: each face around the loop that goes is a loss
  bool leaves_gaps = false;  ///< the fill has holes: loops to choose for in another round
  HoleFill fill;             ///< if one of this shape had to be made for the choice
};

/// Whether a boundary loop is a gap in what was scanned, and then how to close it, or the border of
/// an open surface, which stays (no value):
/// - of an open sheet, a loop that encloses two thirds of its component's area stays: its outline;
/// - a small loop (kSmallPerimeter) is closed;
/// - the outline of a sheet stays: a fill would fold back over the sheet; unless the cloud shows
///   that it is another wall (core/finish/other_wall.h). A loop up to 60 h is no outline of what is
///   much larger, but beside narrow gaps;
/// - a loop with points of the cloud inside is closed whatever its size, but, if asked for, for
///   what was not sampled (core/finish/left_out_faces.h): a hole of the object may lie beside what
///   no scan has reached;
/// - a round rim (longer than 20 h) where the surface ends without leading into the hole, as at the
///   end of a tube, stays unless points are all over the fill;
/// - a crack, nowhere wider than narrow_width, is closed whatever its length; so is one whose sides
///   are so ragged that only the fill with the shortest edges is as narrow: where sides cross, the
///   least sharp fill of a crack around a corner is a sail across it;
/// - others are first zipped where their sides are close, since cracks often open into a border;
/// - once zipped, one stays that is longer than max_hole_perimeter and has a disc so wide and
///   without points that the surface was not sampled there: a hole, or what no scan saw;
/// - others are closed, unless they are long (60 h, max_hole_perimeter) and wide.
/// Loops of more than 6000 edges always stay.
/// @param faces of the positions and the table
/// @param sheet_area of the component with the loop, square model units
/// @param is_zipped whether loops have been zipped before
/// @param cloud points of the cloud; may be empty: no evidence
[[nodiscard]] std::optional<FillChoice> choose_fill(const std::vector<Vec3>& positions,
                                                    const CornerTable& table,
                                                    const BoundaryLoop& loop, const FaceTree& faces,
                                                    double sheet_area, bool is_zipped,
                                                    const PointGrid& cloud,
                                                    const HoleChoiceOptions& options);

/// What a cloud shows inside of a hole, where a fill lies more than 1.5 h away from its loop; of a
/// smaller one, there is air if the faces beside the loop look at its axis, around which hardly any
/// point is: they are the wall of a narrow hole.
enum class Inside {
  unknown,  ///< the hole is too small for that
  air,      ///< hardly any points
  points,
};

/// What it shows where a smooth fill lies.
[[nodiscard]] Inside inside_of_fill(const std::vector<Vec3>& positions, const CornerTable& table,
                                    const BoundaryLoop& loop, const PointGrid& cloud,
                                    double pixel_size);

}  // namespace rangezip
