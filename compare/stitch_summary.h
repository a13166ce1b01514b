#pragma once

#include <cstddef>
#include <span>

#include "compare/mesh_distance.h"
#include "compare/stitch_judge.h"

namespace rangezip::compare {

/// What must hold for the stitches of a session.
struct StitchLimits {
  double location = 0.999;     ///< least share of the places whose face is right or close
  double length_ratio = 1.05;  ///< of 99 % of the segments, at most
};

/// Locations of several stitches.
struct LocationSummary {
  std::size_t unlocated = 0;  ///< lie on no face of the old surface
  std::size_t missed = 0;     ///< of those: a face was there
  std::size_t located = 0;
  std::size_t agreeing = 0;
  std::size_t close = 0;
  DistanceSummary losses;  ///< of those that do not agree, pixel sides

  /// Share of the located and missed ones that agree or are close; 1 if there are none.
  [[nodiscard]] double acceptance() const noexcept {
    const std::size_t judged = located + missed;
    return judged == 0 ? 1.0 : static_cast<double>(agreeing + close) / static_cast<double>(judged);
  }
};

/// Segments of several stitches.
struct SegmentSummary {
  std::size_t inserted = 0;
  std::size_t followed = 0;
  std::size_t lost = 0;
  double ratio_p99 = 0.0;  ///< length through the faces to that of the shortest path, infinite for
  double ratio_max = 0.0;  ///< one that is lost; 0 for no segment
  double line_ratio_p99 = 0.0;  ///< of the straight lines in the image
  DistanceSummary deviations;   ///< from the shortest path, pixel sides
};

[[nodiscard]] LocationSummary summarize_locations(std::span<const StitchVerdict> stitches,
                                                  LocationVerdict StitchVerdict::*which);
[[nodiscard]] SegmentSummary summarize_segments(std::span<const StitchVerdict> stitches);

/// A whole session in figures.
struct StitchSummary {
  std::size_t stitches = 0;
  LocationSummary samples;
  LocationSummary insertions;
  LocationSummary nearest;  ///< of the insertions, whatever stands in the line of sight
  SegmentSummary segments;
  std::size_t not_repeatable = 0;   ///< stitches
  std::size_t not_manifold = 0;     ///< commands after which the mesh is not manifold and oriented
  std::size_t finished_faults = 0;  ///< self-intersections and degenerate faces after a finish
  std::size_t new_crossings = 0;    ///< self-intersections that stitches made

  /// Whether all that must hold and could be judged does. What is empty could not.
  [[nodiscard]] bool is_good(const StitchLimits& limits = {}) const;
};
[[nodiscard]] StitchSummary summarize_session(std::span<const StitchStep> steps);

}  // namespace rangezip::compare
