#include "compare/stitch_judge.h"

#include <catch2/catch.hpp>
#include <functional>

#include "compare/stitch_summary.h"
#include "core/base/error.h"
#include "core/stitch/stitch.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/compare/cubes.h"
#include "tests/core/stitch/hand_scans.h"
#include "tests/support/scans.h"

using namespace rangezip;
using namespace rangezip::compare;

namespace {

/// A patch in the middle of a flat mesh, zippered in.
struct Zippered {
  TriangleMesh before = test::lattice({8.2, 8.3}, 40, 40, 1.0, 20.0);
  Scan scan = test::hand_scan(test::plane(20.0), test::rectangle({20, 22}, {35, 33}), before);
  StitchRecord record = stitch(before, scan, {.method = StitchMethod::zipper}).record;

  [[nodiscard]] StitchVerdict judge() const { return judge_stitch(before, scan, record); }
};

StitchSummary summary_of(const StitchVerdict& verdict) {
  StitchStep step{.stitch = verdict};
  step.mesh.is_manifold = true;
  return summarize_session({&step, 1});
}

/// A ball scanned from both sides and a third one, and finished.
std::vector<StitchStep> judge_ball(StitchMethod method, CorrespondenceMethod correspondence) {
  const Scene scene = scans::scene_of(shapes::sampled(shapes::sphere(), 20'000));
  std::vector<Command> commands;
  for (const Vec3& toward_viewer : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0, 1, 0.3}}) {
    AddScan add{.scan = scans::cloud_request(scene, toward_viewer, 0.04)};
    add.scan.correspondence.method = correspondence;
    add.stitch.method = method;
    commands.emplace_back(add);
  }
  commands.emplace_back(FinishMesh{});
  CpuRasterizer rasterizer;
  return judge_stitches(scene, {}, commands, rasterizer);
}

}  // namespace

TEST_CASE("a patch zippered into a plane has every vertex and segment in its place") {
  const Zippered zippered;
  const StitchVerdict verdict = zippered.judge();
  CHECK(verdict.pixel_size == Approx(1.0));
  CHECK(verdict.samples.points == 16 * 12);
  CHECK(verdict.samples.agreeing == 16 * 12);
  CHECK(verdict.insertions.points == 2 * (15 + 11));
  CHECK(verdict.insertions.acceptance() == 1.0);
  CHECK(verdict.nearest.acceptance() == 1.0);
  CHECK(verdict.segments.inserted == 2 * (15 + 11));
  CHECK(verdict.segments.followed == verdict.segments.inserted);
  CHECK(verdict.segments.lost == 0);
  for (const double ratio : verdict.segments.ratios)
    CHECK(ratio == Approx(1.0).epsilon(1e-9));
  CHECK(summary_of(verdict).is_good());
}

TEST_CASE("of a large mesh so many segments are followed, the same for the same seed") {
  const Zippered zippered;
  StitchJudgeOptions options{.sample_above = 1000, .sample = 20};
  const auto judge = [&] {
    return judge_stitch(zippered.before, zippered.scan, zippered.record, options).segments;
  };
  const SegmentVerdict first = judge();
  CHECK(first.inserted == 52);
  CHECK(first.followed == 20);
  CHECK(first.ratios == judge().ratios);
}

TEST_CASE("a wrong face of an inserted vertex is noticed, and the segments at it are lost") {
  Zippered zippered;
  zippered.record.vertices[7].old_face += 400;
  const StitchVerdict verdict = zippered.judge();
  REQUIRE(verdict.insertions.wrong.size() == 1);
  CHECK(verdict.insertions.wrong[0].point == 7);
  CHECK(verdict.insertions.wrong[0].loss > 1.0);
  CHECK(verdict.nearest.wrong.size() == 1);
  CHECK(verdict.segments.lost == 2);
  CHECK_FALSE(summary_of(verdict).is_good());
}

TEST_CASE("a wrong corresponding face is noticed") {
  Zippered zippered;
  PrimitiveId& face = zippered.scan.correspondence.face[zippered.scan.patch.pixels[40]];
  face = (face + 400) % static_cast<PrimitiveId>(zippered.before.triangles.size());
  const StitchVerdict verdict = zippered.judge();
  REQUIRE(verdict.samples.wrong.size() == 1);
  CHECK(verdict.samples.wrong[0].point == 40);
  CHECK(verdict.samples.wrong[0].loss > verdict.slack);
  CHECK_FALSE(summary_of(verdict).is_good());
}

TEST_CASE("a face on the sheet behind is not the one in sight") {
  // Two sheets 2 apart; the record names the farther one for every vertex.
  const TriangleMesh near = test::lattice({8.2, 8.3}, 40, 40, 1.0, 20.0);
  Zippered zippered;
  zippered.before = test::merged(near, test::lattice({8.2, 8.3}, 40, 40, 1.0, 22.0));
  for (auto& vertex : zippered.record.vertices)
    vertex.old_face += static_cast<std::uint32_t>(near.triangles.size());
  const StitchVerdict verdict = zippered.judge();
  CHECK(verdict.insertions.acceptance() == 0.0);
  CHECK(verdict.insertions.max_loss == Approx(2.0).epsilon(1e-6));
}

TEST_CASE("segments that are too long spoil the verdict, a few of a hundred do not") {
  StitchVerdict verdict = Zippered().judge();
  verdict.segments.ratios.assign(99, 1.0);
  verdict.segments.ratios.push_back(2.0);
  CHECK(summary_of(verdict).is_good());
  verdict.segments.ratios.push_back(2.0);
  CHECK_FALSE(summary_of(verdict).is_good());
  CHECK(summary_of(verdict).segments.ratio_p99 == 2.0);
}

TEST_CASE("a crossing mesh after a finish, one that is no manifold and one unlike itself are bad") {
  StitchStep good;
  good.mesh = judge_mesh(test::cube(1.0));
  good.is_finished = true;
  const auto is_good = [&](const std::function<void(StitchStep&)>& change) {
    StitchStep step = good;
    change(step);
    return summarize_session({&step, 1}).is_good();
  };
  CHECK(is_good([](StitchStep&) {}));
  const MeshVerdict crossing =
      judge_mesh(test::together(test::cube(1.0), test::cube(1.0, Vec3{1.0, 0.9, 0.8})));
  REQUIRE(crossing.self_intersections > 0);
  CHECK_FALSE(is_good([&](StitchStep& s) { s.mesh = crossing; }));
  CHECK(is_good([&](StitchStep& s) {
    s.mesh = crossing;
    s.is_finished = false;  // the finish is still to come
  }));
  CHECK_FALSE(is_good([](StitchStep& s) { s.mesh.is_manifold = false; }));
  CHECK_FALSE(is_good([](StitchStep& s) { s.is_repeatable = false; }));
}

TEST_CASE("a stitch after which a mesh crosses itself more than before is bad") {
  StitchStep step;
  step.mesh = judge_mesh(test::together(test::cube(1.0), test::cube(1.0, Vec3{1.0, 0.9, 0.8})));
  CHECK(summarize_session({&step, 1}).is_good());  // they came with the mesh
  step.new_crossings = step.mesh.self_intersections;
  CHECK_FALSE(summarize_session({&step, 1}).is_good());
}

TEST_CASE("crossings that a stitch leaves as they were are not its fault") {
  // Two sheets that cross beside what is scanned.
  const TriangleMesh given = test::together(test::cube(1.0), test::cube(1.0, Vec3{1.0, 0.9, 0.8}));
  const Scene scene = scans::scene_of(shapes::sampled(shapes::sphere(), 20'000));
  AddScan add{.scan = scans::cloud_request(scene, {0, 0, 1}, 0.04)};
  CpuRasterizer rasterizer;
  TriangleMesh moved = given;
  for (Vec3& p : moved.positions)
    p += Vec3{20.0, 0.0, 0.0};
  const auto steps = judge_stitches(scene, moved, std::vector<Command>{add}, rasterizer);
  REQUIRE(steps.size() == 1);
  CHECK(steps[0].mesh.self_intersections == judge_mesh(given).self_intersections);
  CHECK(steps[0].new_crossings == 0);
}

TEST_CASE("the stitches of a ball are good by both methods") {
  const auto automatic = judge_ball(StitchMethod::clear_and_fill, CorrespondenceMethod::depth_band);
  const auto paper = judge_ball(StitchMethod::zipper, CorrespondenceMethod::id_buffer);
  for (const auto& steps : {automatic, paper}) {
    REQUIRE(steps.size() == 4);
    const StitchSummary summary = summarize_session(steps);
    CHECK(summary.stitches == 3);
    CHECK(summary.samples.located > 100);
    CAPTURE(summary.samples.acceptance(), summary.insertions.acceptance(),
            summary.segments.ratio_p99, summary.not_manifold, summary.finished_faults,
            summary.not_repeatable);
    CHECK(summary.is_good());
    CHECK(steps.back().is_finished);
  }
  CHECK(summarize_session(automatic).segments.inserted == 0);
  CHECK(summarize_session(paper).segments.inserted > 100);
}

TEST_CASE("a record of another scan is refused") {
  Zippered zippered;
  SECTION("a vertex that the patch has not") {
    zippered.record.vertices[0].patch_vertex = 10'000;
  }
  SECTION("a face that the mesh has not") {
    zippered.record.vertices[0].old_face = 10'000;
  }
  SECTION("a segment whose end was not inserted") {
    zippered.record.vertices.pop_back();
  }
  CHECK_THROWS_AS(zippered.judge(), InvalidArgument);
}
