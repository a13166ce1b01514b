#pragma once

#include <vector>

#include "core/session/command.h"
#include "tests/support/shapes.h"

namespace rangezip::test {

inline Camera random_camera(shapes::Random& random, bool is_perspective) {
  const Vec3 eye{random.normal(), random.normal(), 3.0 + random.unit()};
  Camera camera = look_at(eye, {random.unit(), random.unit(), 0.0}, {0.0, 1.0, 0.0});
  if (is_perspective) {
    camera.lens = Perspective{.fov_y = random.between(0.1, 2.0)};
  } else {
    camera.lens = Orthographic{.height = random.between(1e-9, 1e9)};
  }
  camera.near_depth = random.normal();
  camera.far_depth = camera.near_depth + random.unit();
  camera.clip_planes = {{{random.normal(), random.normal(), random.normal()}, random.normal()},
                        {{0.1, 0.2, 0.3}, -1e-300}};
  return camera;
}

/// One command of each kind, every optional part present, no member at its default.
inline std::vector<Command> full_commands(shapes::Random& random) {
  const auto share = [&] { return random.between(0.01, 1.0); };
  const auto count = [&] { return 2 + static_cast<int>(random.unit() * 6.0); };
  AddScan scan;
  scan.scan.camera = random_camera(random, false);
  scan.scan.extent = {count(), count()};
  scan.scan.region = {{random.normal(), 1.0 / 3.0}, {random.normal(), 2.0}, {5.0, -0.0}};
  scan.scan.places = {{{random.normal(), random.normal(), random.normal()}, share()}};
  scan.scan.point_size = count();
  scan.scan.see_through = {.max_slope = share(), .remove_outliers = false, .rounds = count()};
  scan.scan.back_side = {.min_gap = share()};
  scan.scan.plane_fit = {.slope_ridge = share()};
  scan.scan.fill_holes = {
      .min_neighbours = count(), .rounds = count() + 1, .max_step = share(), .reach = count() + 2};
  scan.scan.median = {.radius = count(), .max_step = share()};
  scan.scan.steep_cells = {.min_cosine = share()};
  scan.scan.correspondence = {
      .method = CorrespondenceMethod::id_buffer, .band = share(), .back_band = share()};
  scan.scan.unmatched_only = true;
  scan.scan.quality = {.hysteresis = share(), .max_replacing_slope = share()};
  scan.scan.smooth_quality = false;
  scan.scan.clean_mask = {.erosions = count(), .dilations = count() + 1};
  scan.scan.triangulate = {.max_edge = share(),
                           .max_slope_cosine = share(),
                           .min_component = static_cast<std::size_t>(count())};
  scan.scan.decimate = {.tolerance = share(), .max_block = count()};
  scan.stitch.method = StitchMethod::zipper;
  scan.stitch.band = share();
  scan.stitch.clearance = share();
  scan.stitch.max_gap = share();
  scan.stitch.min_strip_cosine = share();
  scan.stitch.collapse_ratio = share();
  scan.stitch.withdrawal = count();
  scan.stitch.min_component = static_cast<std::size_t>(count());
  scan.stitch.view = 7;
  scan.vote = VoteOptions{.pixel_size = share(), .directions = count()};

  EraseRegion erase;
  erase.camera = random_camera(random, true);
  erase.extent = {count(), count()};
  erase.region = {{0.0, 0.0}, {random.unit(), 0.0}, {0.0, random.unit()}};
  erase.visible_only = false;

  FinishMesh finish;
  finish.options.method = FinishMethod::fast;
  finish.options.pixel_size = share();
  finish.options.max_hole_perimeter = share();
  finish.options.narrow_width = share();
  finish.options.rounds = count() + 10;
  finish.options.relaxations = count() + 10;
  finish.options.triangles = static_cast<std::size_t>(count());
  finish.options.flat_tolerance = share();
  finish.options.snap_features = false;
  finish.options.gap = share();
  finish.options.narrow_gaps = true;
  finish.options.regrow = true;
  finish.options.open_sheet = true;
  finish.options.follow_density = true;
  finish.options.min_component = static_cast<std::size_t>(count());
  finish.options.is_clean = true;
  finish.vote = VoteOptions{.pixel_size = share(), .directions = count()};

  return {scan,
          erase,
          ErasePlaces{{{{random.normal(), random.normal(), 1.0 / 3.0}, share()}}},
          SmoothMesh{.iterations = count(), .factor = share()},
          FillMeshHoles{.pixel_size = share(), .max_perimeter = share()},
          DropUnsupported{.pixel_size = share()},
          finish,
          TurnToScanners{{{random.normal(), 1.0 / 3.0, random.normal()}, {0.0, -0.0, 1e9}}},
          UndoSteps{.count = count()}};
}

}  // namespace rangezip::test
