#include "compare/stage_judge.h"

#include <catch2/catch.hpp>
#include <functional>
#include <utility>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/scans.h"

using namespace rangezip;
using namespace rangezip::compare;
using Catch::Contains;

namespace {

enum class Operation { render, render_in_band, accumulate };

/// Right but for one drawing of one operation, counted from 0: there it changes one pixel.
class WrongOnce final : public Rasterizer {
 public:
  WrongOnce(Operation operation, int wrong_call) : operation_(operation), wrong_call_(wrong_call) {}
  [[nodiscard]] RasterizerInfo info() const override { return right_.info(); }

 private:
  bool is_wrong_now(Operation operation) {
    return operation == operation_ && calls_++ == wrong_call_;
  }
  /// The pixel nearest to the middle of the image becomes empty.
  static void forget_middle(Framebuffer& image) {
    const Pixel middle{image.id.extent().width / 2, image.id.extent().height / 2};
    image.id[middle] = kNoPrimitive;
    image.depth[middle] = kNoDepth;
  }

  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override {
    const DrawReport report = right_.render(view, items, out);
    if (is_wrong_now(Operation::render)) forget_middle(out);
    return report;
  }
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override {
    const DrawReport report = right_.render_in_band(view, items, band, out);
    if (is_wrong_now(Operation::render_in_band)) forget_middle(out);
    return report;
  }
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override {
    const DrawReport report = right_.accumulate(view, items, window, out);
    if (is_wrong_now(Operation::accumulate)) {
      out[{out.extent().width / 2, out.extent().height / 2}].w_z += 1'000'000'000;
    }
    return report;
  }

  CpuRasterizer right_;
  Operation operation_;
  int wrong_call_;
  int calls_ = 0;
};

/// Two scans of a ball from opposite sides, then smoothing.
struct Ball {
  Scene scene = scans::scene_of(shapes::sampled(shapes::sphere(), 5000));
  std::vector<Command> commands{scan_from({0, 0, 1}), scan_from({0, 1, 0.3}), SmoothMesh{}};

  [[nodiscard]] AddScan scan_from(const Vec3& toward_viewer) const {
    return {.scan = scans::cloud_request(scene, toward_viewer, 0.06)};
  }
  [[nodiscard]] std::vector<CommandVerdict> judge(Rasterizer& reference,
                                                  Rasterizer& candidate) const {
    return judge_session(scene, {}, commands, reference, candidate);
  }
};

const StageVerdict& stage(const CommandVerdict& verdict, const std::string& name) {
  return *std::find_if(verdict.stages.begin(), verdict.stages.end(),
                       [&](const StageVerdict& s) { return s.name == name; });
}

}  // namespace

TEST_CASE("a session with two exact backends has every stage of every command equal") {
  const Ball ball;
  CpuRasterizer widest;
  CpuRasterizer scalar("scalar");
  const auto verdicts = ball.judge(widest, scalar);
  REQUIRE(verdicts.size() == 3);
  for (const CommandVerdict& verdict : verdicts)
    CHECK(verdict.identical());
  REQUIRE(verdicts[0].stages.size() == 9);
  // The scene and its sums for the first scan; for the second also two bands of the mesh.
  CHECK(verdicts[0].stages.front().compared >= 2);
  CHECK(verdicts[1].stages.front().compared >= 4);
  CHECK(verdicts[2].stages.front().compared == 0);
  for (const StageVerdict& s : verdicts[1].stages)
    CHECK(s.compared > 0);
  CHECK(verdicts[2].stages.back().compared > 1000);
}

TEST_CASE("a wrong drawing is named with its command, operation and pixel, and ends the play") {
  struct Case {
    Operation operation;
    int wrong_call;
    std::size_t command;
    std::string text;
  };
  const Ball ball;
  for (const Case& c : {Case{Operation::render, 0, 0, "drawing 0 (render), 1 pixels, pixel ("},
                        Case{Operation::accumulate, 0, 0, "(accumulate), 1 pixels, pixel ("},
                        Case{Operation::render, 1, 1, "drawing 0 (render), 1 pixels"},
                        Case{Operation::accumulate, 1, 1, "(accumulate), 1 pixels"}}) {
    CAPTURE(c.text);
    CpuRasterizer reference;
    WrongOnce candidate(c.operation, c.wrong_call);
    const auto verdicts = ball.judge(reference, candidate);
    REQUIRE(verdicts.size() == c.command + 1);
    for (std::size_t i = 0; i < c.command; ++i)
      CHECK(verdicts[i].identical());
    REQUIRE_FALSE(verdicts.back().identical());
    CHECK(verdicts.back().first_difference().name == "framebuffers");
    CHECK(verdicts.back().first_difference().different == 1);
    CHECK_THAT(verdicts.back().first_difference().first, Contains(c.text));
    CHECK_FALSE(stage(verdicts.back(), "mesh").identical());
  }
}

TEST_CASE("a wrong drawing in a band is seen although it changes little") {
  const Ball ball;
  CpuRasterizer reference;
  WrongOnce candidate(Operation::render_in_band, 0);
  const auto verdicts = ball.judge(reference, candidate);
  REQUIRE(verdicts.size() == 2);
  CHECK_THAT(verdicts[1].first_difference().first, Contains("(render_in_band)"));
  CHECK(stage(verdicts[1], "range image").identical());
  CHECK_FALSE(stage(verdicts[1], "correspondence").identical());
}

TEST_CASE("if only one run of the pipeline goes astray, the first product that differs is named") {
  // The reference errs in the run of its own and draws rightly when it is the witness: all drawings
  // that are held against each other are equal, what was made of them is not.
  const Ball ball;
  WrongOnce reference(Operation::render, 0);
  CpuRasterizer candidate;
  const auto verdicts = ball.judge(reference, candidate);
  REQUIRE(verdicts.size() == 1);
  CHECK(stage(verdicts[0], "framebuffers").identical());
  CHECK(verdicts[0].first_difference().name == "scene framebuffer");
  CHECK_THAT(verdicts[0].first_difference().first, Contains("pixel ("));
}

TEST_CASE("a whole session is played: scans, a view into a hole, commands on the mesh, undo") {
  Ball ball;
  AddScan into_hole = ball.scan_from({1, 0, 0});
  into_hole.scan.unmatched_only = true;
  EraseRegion erase{.extent = {64, 64}, .region = {{20, 20}, {40, 20}, {30, 40}}};
  erase.camera = ball.scan_from({0, 0, 1}).scan.camera;
  ball.commands = {ball.scan_from({0, 0, 1}),
                   ball.scan_from({0, 0, -1}),
                   into_hole,
                   erase,
                   FillMeshHoles{},
                   SmoothMesh{},
                   UndoSteps{2},
                   FinishMesh{}};
  CpuRasterizer reference;
  CpuRasterizer scalar("scalar");
  const auto verdicts = ball.judge(reference, scalar);
  REQUIRE(verdicts.size() == ball.commands.size());
  for (const CommandVerdict& verdict : verdicts) {
    CHECK(verdict.identical());
    CHECK(stage(verdict, "mesh").compared > 1000);
  }
  for (const std::size_t scan : {0U, 1U, 2U})
    CHECK(verdicts[scan].stages.size() == 9);
  CHECK(stage(verdicts[2], "patch").compared > 0);
  CHECK(stage(verdicts[3], "framebuffers").compared == 1);
  CHECK(verdicts[3].stages.size() == 2);

  // A drawing that only a late command makes: the render of the erasure, after those of the scans.
  WrongOnce candidate(Operation::render, 3);
  const auto wrong = ball.judge(reference, candidate);
  REQUIRE(wrong.size() == 4);
  CHECK_THAT(wrong[3].first_difference().first, Contains("drawing 0 (render), 1 pixels"));
}

TEST_CASE("a difference in any product of a scan is named with its stage and its place") {
  struct Case {
    std::string stage;
    std::string place;
    std::function<void(Scan&)> change;
  };
  const Pixel at{20, 17};
  const std::string pixel = "pixel (20, 17)";
  const std::vector<Case> cases{
      {"scene framebuffer", pixel, [&](Scan& s) { ++s.scene_buffer.depth[at]; }},
      {"scene framebuffer", pixel, [&](Scan& s) { ++s.scene_buffer.id[at]; }},
      {"range image", pixel, [&](Scan& s) { s.image[at] = 3.0; }},
      {"filled", pixel, [&](Scan& s) { s.filled[at] ^= 1U; }},
      {"slopes", pixel, [&](Scan& s) { s.slopes[at].y += 1e-15; }},
      {"correspondence", pixel, [&](Scan& s) { ++s.correspondence.face[at]; }},
      {"correspondence", pixel, [&](Scan& s) { s.correspondence.from_behind[at] ^= 1U; }},
      {"mask", pixel, [&](Scan& s) { s.active[at] ^= 1U; }},
      {"patch", "vertex 7", [](Scan& s) { s.patch.mesh.positions[7].x += 1e-15; }},
      {"patch", "face 9",
       [](Scan& s) { std::swap(s.patch.mesh.triangles[9][0], s.patch.mesh.triangles[9][1]); }},
      {"patch", "source of vertex 2", [](Scan& s) { ++s.patch.mesh.sources[2].primitive; }},
      {"patch", "pixel of vertex 5", [](Scan& s) { ++s.patch.pixels[5].x; }},
  };
  const Ball ball;
  const AddScan request = ball.scan_from({0, 0, 1});
  const Scan reference = scans::run(ball.scene, request.scan);
  for (const StageVerdict& verdict : judge_scans(reference, reference))
    CHECK(verdict.identical());
  for (const auto& [name, place, change] : cases) {
    CAPTURE(name, place);
    Scan candidate = reference;
    change(candidate);
    const CommandVerdict verdict{judge_scans(reference, candidate)};
    REQUIRE_FALSE(verdict.identical());
    CHECK(verdict.first_difference().name == name);
    CHECK(verdict.first_difference().first == place);
    CHECK(verdict.first_difference().different == 1);
    CHECK(std::count_if(verdict.stages.begin(), verdict.stages.end(),
                        std::mem_fn(&StageVerdict::identical)) == 6);
  }
}

TEST_CASE("meshes differ in positions, faces, sources, and in what one of them lacks") {
  TriangleMesh reference = shapes::to_mesh(shapes::box(Vec3{0.0}, Vec3{1.0}));
  reference.sources.resize(reference.positions.size());
  const auto first = [&](const std::function<void(TriangleMesh&)>& change) {
    TriangleMesh candidate = reference;
    change(candidate);
    const StageVerdict verdict = judge_meshes(reference, candidate);
    CHECK(verdict.name == "mesh");
    CHECK(verdict.different == 1);
    return verdict.first;
  };
  CHECK(judge_meshes(reference, reference).identical());
  CHECK(first([](TriangleMesh& m) { m.positions[4].z += 1e-15; }) == "vertex 4");
  CHECK(first([](TriangleMesh& m) { m.triangles[3][2] += 1; }) == "face 3");
  CHECK(first([](TriangleMesh& m) { m.sources[1].view = 6; }) == "source of vertex 1");
  CHECK(first([](TriangleMesh& m) { m.triangles.pop_back(); }) == "face 11");
  CHECK(first([](TriangleMesh& m) { m.positions.emplace_back(0.0); }) == "vertex 8");
}

TEST_CASE("the play of a session can be cancelled") {
  const Ball ball;
  CpuRasterizer reference;
  CpuRasterizer candidate;
  std::stop_source stop;
  stop.request_stop();
  CHECK_THROWS_AS(judge_session(ball.scene, {}, ball.commands, reference, candidate,
                                {.stop = stop.get_token()}),
                  Cancelled);
}

TEST_CASE("a command that cannot be carried out is named by its place") {
  Ball ball;
  ball.commands[1] = SmoothMesh{.iterations = -1};
  CpuRasterizer reference;
  CpuRasterizer candidate;
  CHECK_THROWS_WITH(ball.judge(reference, candidate), Contains("/commands/1: "));
}
