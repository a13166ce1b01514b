#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/reconstruct/reconstruct.h"
#include "core/scene/scene.h"
#include "core/session/command.h"

namespace rangezip::app {

/// The options of `rangezip scan` that say how to scan. What is left out comes from the method.
struct ScanChoices {
  ReconstructMethod method = ReconstructMethod::automatic;

  Vec3 direction{0.0, 0.0, 1.0};  ///< toward the scanner
  std::optional<Vec3> up;
  std::optional<Extent> size;
  std::optional<double> pixel_size;
  std::optional<double> perspective;  ///< full vertical angle, degrees
  std::vector<Plane> clip_planes;
  bool align = false;  ///< the grid with the dominant feature line
  std::vector<Vec2> region;
  std::optional<int> point_size;

  // The passes, in the order in which they run.
  std::optional<bool> back_side;
  std::optional<double> min_gap;
  std::optional<bool> see_through;
  std::optional<bool> vote;
  std::optional<bool> plane_fit;
  std::optional<bool> fill_holes;
  std::optional<bool> median;
  std::optional<int> median_radius;
  std::optional<bool> steep_cells;
  std::optional<double> steep_cosine;
  std::optional<CorrespondenceMethod> correspondence;
  bool only_new = false;
  std::optional<bool> quality;
  std::optional<int> erosions;
  std::optional<int> dilations;
  std::optional<double> max_edge;
  std::optional<double> decimate;
  std::optional<StitchMethod> stitch;
  std::optional<double> collapse_ratio;
};

void add_scan_choices(CLI::App& command, ScanChoices& choices);

/// The command that carries the choices out on a scene.
/// @throws UsageError if choices contradict each other, InvalidArgument if one is out of range.
[[nodiscard]] AddScan make_scan(const Scene& scene, const ScanChoices& choices);

/// The same command with its camera aligned by align_to_feature(), for which it is carried out
/// once.
/// @throws UsageError if no feature line is seen, Cancelled.
[[nodiscard]] AddScan aligned(AddScan command, const Scene& scene, Rasterizer& rasterizer,
                              const Progress& progress);

}  // namespace rangezip::app
