// What a stitch looks at after its work, part by part: what changed, what crosses, what was lost.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "core/mesh/face_changes.h"
#include "core/mesh/self_intersection.h"
#include "core/patch/decimate.h"
#include "core/stitch/crossing_faces.h"
#include "core/stitch/lost_pixels.h"
#include "core/stitch/lost_places.h"
#include "core/stitch/mesh_part.h"
#include "core/stitch/withdraw.h"
#include "tests/core/stitch/hand_scans.h"
#include "tests/support/shapes.h"

using namespace rangezip;
using namespace rangezip::test;

namespace {

/// The faces of `whole` but the given ones.
TriangleMesh without(TriangleMesh whole, const std::set<std::uint32_t>& faces) {
  std::vector<Triangle> kept;
  for (std::uint32_t f = 0; f < whole.triangles.size(); ++f) {
    if (faces.count(f) == 0) kept.push_back(whole.triangles[f]);
  }
  whole.triangles = std::move(kept);
  return whole;
}

std::vector<Pixel> lost_between(const TriangleMesh& before, const TriangleMesh& after) {
  const View view = images::parallel_view(kExtent);
  const ImagePlane image_before = project_to_image(before.positions, view);
  const ImagePlane image_after = project_to_image(after.positions, view);
  return find_lost_pixels({before, image_before}, {after, image_after},
                          find_face_changes(before, after), view);
}

}  // namespace

TEST_CASE("of two meshes the faces that differ are found, whatever corner they start from",
          "[stitch]") {
  const TriangleMesh before = lattice({10.0, 10.0}, 4, 4, 1.0, 20.0);
  TriangleMesh after = without(before, {3, 7});
  std::rotate(after.triangles[5].begin(), after.triangles[5].begin() + 1, after.triangles[5].end());
  FaceChanges changes = find_face_changes(before, after);
  CHECK(changes.gone == std::vector<std::uint32_t>{3, 7});
  CHECK(changes.made.empty());

  after.triangles.push_back({before.triangles[3][1], before.triangles[3][0], 12});
  changes = find_face_changes(before, after);
  CHECK(changes.made == std::vector<std::uint32_t>{30});

  after.positions[0].z += 0.1;  // a face with a moved corner is another one
  changes = find_face_changes(before, after);
  for (const std::uint32_t f : changes.gone) {
    const Triangle& face = before.triangles[f];
    CHECK((f == 3 || f == 7 || std::count(face.begin(), face.end(), 0U) == 1));
  }
  CHECK(changes.gone.size() > 2);
}

TEST_CASE("without the faces chosen no pair is left, and seams go before patches", "[stitch]") {
  SECTION("of a pair the one of the earlier origin goes") {
    const std::vector<FaceOrigin> origins{FaceOrigin::old, FaceOrigin::patch, FaceOrigin::seam};
    const std::vector<FacePair> pairs{{0, 1}, {1, 2}};
    CHECK(choose_crossing_faces(pairs, origins) == std::vector<std::uint32_t>{1, 2});
  }
  SECTION("one face in the way of many goes alone, and so does one without area") {
    const std::vector<FaceOrigin> origins(6, FaceOrigin::seam);
    const std::vector<FacePair> pairs{{0, 3}, {1, 3}, {2, 3}, {5, 5}};
    CHECK(choose_crossing_faces(pairs, origins) == std::vector<std::uint32_t>{3, 5});
  }
  SECTION("random pairs") {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      CAPTURE(seed);
      shapes::Random random(seed);
      std::vector<FaceOrigin> origins;
      for (int i = 0; i < 20; ++i)
        origins.push_back(static_cast<FaceOrigin>(random.bits() % 3));
      std::set<FacePair> pairs;
      for (int i = 0; i < 30; ++i) {
        const auto a = static_cast<std::uint32_t>(random.bits() % 20);
        const auto b = static_cast<std::uint32_t>(random.bits() % 20);
        if (origins[a] == FaceOrigin::old && origins[b] == FaceOrigin::old) continue;
        pairs.insert({std::min(a, b), std::max(a, b)});
      }
      const std::vector<FacePair> list(pairs.begin(), pairs.end());
      const auto gone = choose_crossing_faces(list, origins);
      const auto is_gone = [&](std::uint32_t f) {
        return std::binary_search(gone.begin(), gone.end(), f);
      };
      for (const auto& [a, b] : list)
        CHECK((is_gone(a) || is_gone(b)));
      for (const std::uint32_t f : gone)
        CHECK(origins[f] != FaceOrigin::old);
    }
  }
}

TEST_CASE("a pixel is lost where its face goes and none takes its place at that depth",
          "[stitch]") {
  // Its corners are the centres of the pixels 10..20.
  const TriangleMesh before = lattice({10.0, 10.0}, 10, 10, 1.0, 20.0);
  SECTION("nothing goes, nothing is lost") {
    CHECK(lost_between(before, before).empty());
  }
  SECTION("a hole of six faces loses the corner in its middle alone") {
    std::set<std::uint32_t> star;
    const std::uint32_t middle = 5 * 11 + 5;
    for (std::uint32_t f = 0; f < before.triangles.size(); ++f) {
      const Triangle& face = before.triangles[f];
      if (std::count(face.begin(), face.end(), middle) > 0) star.insert(f);
    }
    CHECK(lost_between(before, without(before, star)) == std::vector<Pixel>{{15, 15}});
  }
  const auto replaced_at = [&](double depth) {
    TriangleMesh after = merged(before, lattice({10.0, 10.0}, 10, 10, 1.0, depth));
    after.triangles.erase(after.triangles.begin(), after.triangles.begin() + 200);
    return lost_between(before, after).size();
  };
  SECTION("another sheet counts if it is near in depth") {
    CHECK(replaced_at(20.9) == 0);
    CHECK(replaced_at(19.1) == 0);
    CHECK(replaced_at(30.0) == 121);
    CHECK(replaced_at(10.0) == 121);
  }
}

TEST_CASE("a wall that shows no pixel is missed by its corners", "[stitch]") {
  // A wall along the line of sight over x = 20.5, from depth 20 to 30.
  TriangleMesh wall;
  for (int i = 0; i <= 10; ++i) {
    for (const double depth : {20.0, 25.0, 30.0})
      wall.positions.push_back(world(20.5, 10.25 + i, depth));
  }
  for (std::uint32_t i = 0; i < 10; ++i) {
    for (std::uint32_t k = 0; k < 2; ++k) {
      const std::uint32_t a = 3 * i + k;
      wall.triangles.push_back({a, a + 3, a + 4});
      wall.triangles.push_back({a, a + 4, a + 1});
    }
  }
  const View view = images::parallel_view(kExtent);
  const ImagePlane image = project_to_image(wall.positions, view);
  TriangleMesh after = wall;
  after.triangles.clear();
  const FaceChanges changes = find_face_changes(wall, after);
  CHECK(find_lost_pixels({wall, image}, {after, image}, changes, view).empty());
  const std::size_t places = find_lost_places({wall, image}, {after, image}, changes, 1.0).size();
  CHECK(places > 20 * 10);  // sides are 5 long

  // A copy beside it covers all of it, one farther away none of it.
  const auto lost_beside = [&](double distance) {
    TriangleMesh moved = wall;
    for (Vec3& p : moved.positions)
      p.x += distance;
    TriangleMesh both = merged(after, moved);
    const ImagePlane image_both = project_to_image(both.positions, view);
    return find_lost_places({wall, image}, {both, image_both}, changes, 1.0).size();
  };
  CHECK(lost_beside(0.9) == 0);
  CHECK(lost_beside(1.1) == places);
}

TEST_CASE("a new vertex far outside of the image changes nothing about lost places", "[stitch]") {
  const TriangleMesh before = lattice({10.0, 10.0}, 4, 4, 1.0, 20.0);
  TriangleMesh after = before;
  after.triangles.clear();
  const FaceChanges gone = find_face_changes(before, after);
  const View view = images::parallel_view(kExtent);
  const ImagePlane image = project_to_image(before.positions, view);
  const std::size_t places = find_lost_places({before, image}, {after, image}, gone, 1.0).size();
  // A pixel of a grid as wide as that would take gigabytes.
  TriangleMesh far = lattice({10.0, 10.0}, 1, 1, 1.0, 60.0);
  far.positions.back() = world(16'000.0, 16'000.0, 60.0);
  const TriangleMesh both = merged(after, far);
  const ImagePlane image_both = project_to_image(both.positions, view);
  const FaceChanges changes = find_face_changes(before, both);
  CHECK(find_lost_places({before, image}, {both, image_both}, changes, 1.0).size() == places);
}

TEST_CASE("a patch is withdrawn from places by the radius and no farther", "[stitch]") {
  const Scan scan = hand_scan(plane(20.0), rectangle({10, 10}, {30, 30}));
  const Patch& patch = scan.patch;
  for (const int radius : {0, 1, 3, 50}) {
    CAPTURE(radius);
    const std::vector<Pixel> places{{15, 16}, {40, 40}};
    const auto is_near = [&](Pixel p) {
      return std::any_of(places.begin(), places.end(), [&](Pixel q) {
        return std::max(std::abs(p.x - q.x), std::abs(p.y - q.y)) <= radius;
      });
    };
    const Patch rest = withdraw_near(scan.image, patch, places, radius);
    const auto stays = [&](const Triangle& t) {
      return std::none_of(t.begin(), t.end(), [&](auto v) { return is_near(patch.pixels[v]); });
    };
    CHECK(rest.mesh.triangles.size() ==
          static_cast<std::size_t>(
              std::count_if(patch.mesh.triangles.begin(), patch.mesh.triangles.end(), stays)));
    CHECK(std::none_of(rest.pixels.begin(), rest.pixels.end(), is_near));
    CHECK(rest.mesh.sources.size() == rest.pixels.size());
    check_mesh(rest.mesh);
  }
}

TEST_CASE("a part cut out and put back unchanged is the whole again", "[stitch]") {
  const TriangleMesh whole = lattice({2.2, 2.3}, 55, 55, 1.0, 20.0);
  const View view = images::parallel_view(kExtent);
  const std::vector<Pixel> pixels{{20, 20}, {30, 25}};
  const MeshPart part = cut_out_part(whole, view, pixels, 3);
  CHECK(part.mesh.triangles.size() < whole.triangles.size() / 3);
  CHECK(part.mesh.triangles.size() > std::size_t{2} * 16 * 11);
  TriangleMesh back = whole;
  put_back(back, part, part.mesh, {});
  CHECK(back == whole);

  // Vertices inside have all their faces in the part.
  std::vector<std::size_t> in_whole(whole.positions.size(), 0);
  std::vector<std::size_t> in_part(whole.positions.size(), 0);
  for (const Triangle& face : whole.triangles) {
    for (const std::uint32_t v : face)
      ++in_whole[v];
  }
  for (const Triangle& face : part.mesh.triangles) {
    for (const std::uint32_t v : face)
      ++in_part[part.vertex_in_whole[v]];
  }
  for (std::size_t v = 0; v < part.vertex_in_whole.size(); ++v) {
    if (part.is_rim[v] != 0) continue;
    CHECK(in_part[part.vertex_in_whole[v]] == in_whole[part.vertex_in_whole[v]]);
  }
}

TEST_CASE("the part around pixels far apart leaves out what lies between them", "[stitch]") {
  const TriangleMesh whole = lattice({2.2, 2.3}, 55, 55, 1.0, 20.0);
  const View view = images::parallel_view(kExtent);
  const std::vector<Pixel> pixels{{6, 6}, {54, 54}};
  const MeshPart part = cut_out_part(whole, view, pixels, 3);
  CHECK(part.mesh.triangles.size() < whole.triangles.size() / 2);
  for (const Pixel p : pixels) {
    const Vec2 place = in_pixels(grid_point(p));
    std::size_t near = 0, near_in_part = 0;
    const auto is_near = [&](const TriangleMesh& mesh, const Triangle& face) {
      const ImagePlane corners = project_to_image(
          std::array{mesh.positions[face[0]], mesh.positions[face[1]], mesh.positions[face[2]]},
          view);
      return std::any_of(corners.points.begin(), corners.points.end(), [&](const GridPoint& q) {
        return glm::length(in_pixels(q) - place) < 3.0;
      });
    };
    for (const Triangle& face : whole.triangles)
      near += is_near(whole, face) ? 1 : 0;
    for (const Triangle& face : part.mesh.triangles)
      near_in_part += is_near(part.mesh, face) ? 1 : 0;
    CHECK(near > 20);
    CHECK(near_in_part == near);
  }
}

TEST_CASE("the part around pixels at the edge of the image leaves out what the image does not show",
          "[stitch]") {
  const TriangleMesh whole = lattice({-150.3, -150.2}, 364, 364, 1.0, 20.0);
  const View view = images::parallel_view(kExtent);
  std::vector<Pixel> edge;
  for (int i = 0; i < kExtent.width; ++i) {
    edge.insert(edge.end(), {{i, 0}, {i, kExtent.height - 1}, {0, i}, {kExtent.width - 1, i}});
  }
  constexpr int kMargin = 3;
  const MeshPart part = cut_out_part(whole, view, edge, kMargin);
  // The margin, then what those faces meet, each to two tiles of 4 pixels, and a ring.
  constexpr double kFarthest = kMargin + 4 * 4 + 2;
  const ImagePlane image = project_to_image(part.mesh.positions, view);
  for (const GridPoint& p : image.points) {
    const Vec2 place = in_pixels(p);
    CHECK(std::min(place.x, place.y) > -kFarthest);
    CHECK(std::max(place.x, place.y) < kExtent.width + kFarthest);
  }
  CHECK(part.mesh.triangles.size() > std::size_t{2} * 64 * 4);
}

TEST_CASE("changes are found whatever the order of the faces", "[stitch]") {
  constexpr std::uint64_t kSeed = 11;
  INFO("seed " << kSeed);
  shapes::Random random(kSeed);
  const TriangleMesh before = lattice({2.2, 2.3}, 20, 20, 1.0, 20.0);
  TriangleMesh after = before;
  std::vector<std::uint32_t> gone;
  std::vector<Triangle> kept;
  for (std::uint32_t f = 0; f < before.triangles.size(); ++f) {
    if (random.unit() < 0.1) {
      gone.push_back(f);
    } else {
      kept.push_back(before.triangles[f]);
    }
  }
  after.triangles = kept;
  CHECK(find_face_changes(before, after).gone == gone);
  CHECK(find_face_changes(before, after).made.empty());

  // Turned faces in another order, new ones between them, and a vertex that moves.
  for (Triangle& t : after.triangles)
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.bits() % 3), t.end());
  for (std::size_t f = after.triangles.size(); f > 1; --f)
    std::swap(after.triangles[f - 1], after.triangles[random.bits() % f]);
  const auto tip = static_cast<std::uint32_t>(after.positions.size());
  after.positions.emplace_back(0.0, 0.0, 1.0);
  const auto middle = static_cast<std::ptrdiff_t>(after.triangles.size() / 2);
  after.triangles.insert(after.triangles.begin() + middle, {tip, 0, 1});
  const std::uint32_t moved = after.triangles.front()[0];
  after.positions[moved].z += 0.1;

  const FaceChanges changes = find_face_changes(before, after);
  std::size_t expected_gone = gone.size();
  for (const Triangle& t : kept)
    expected_gone += std::count(t.begin(), t.end(), moved) > 0 ? 1 : 0;
  CHECK(changes.gone.size() == expected_gone);
  CHECK(changes.made.size() == expected_gone - gone.size() + 1);
  for (const std::uint32_t f : changes.made) {
    const Triangle& t = after.triangles[f];
    CHECK((std::count(t.begin(), t.end(), tip) > 0 || std::count(t.begin(), t.end(), moved) > 0));
  }
}

TEST_CASE("what is done to a part is done to the whole and to nothing else", "[stitch]") {
  const TriangleMesh whole = lattice({2.2, 2.3}, 55, 55, 1.0, 20.0);
  const View view = images::parallel_view(kExtent);
  const std::vector<Pixel> pixels{{20, 20}, {30, 25}};
  const MeshPart part = cut_out_part(whole, view, pixels, 3);
  // One inner face is split at a new vertex.
  TriangleMesh changed = part.mesh;
  std::size_t split = 0;
  while (part.is_rim[changed.triangles[split][0]] + part.is_rim[changed.triangles[split][1]] +
             part.is_rim[changed.triangles[split][2]] >
         0) {
    ++split;
  }
  const Triangle t = changed.triangles[split];
  const auto middle = static_cast<std::uint32_t>(changed.positions.size());
  changed.positions.push_back(
      (changed.positions[t[0]] + changed.positions[t[1]] + changed.positions[t[2]]) / 3.0);
  changed.triangles[split] = {t[0], t[1], middle};
  changed.triangles.push_back({t[1], t[2], middle});
  changed.triangles.push_back({t[2], t[0], middle});
  const FaceChanges changes = find_face_changes(part.mesh, changed);
  TriangleMesh result = whole;
  put_back(result, part, changed, changes);
  check_mesh(result);
  CHECK(result.triangles.size() == whole.triangles.size() + 2);
  CHECK(std::equal(whole.positions.begin(), whole.positions.end(), result.positions.begin()));
  CHECK(projected_area(result) == Approx(projected_area(whole)));
  CHECK(self_intersections(result).empty());
}

TEST_CASE("a patch that runs through a sheet it does not replace is cut, not the sheet",
          "[stitch]") {
  const StitchMethod method = GENERATE(StitchMethod::clear_and_fill, StitchMethod::zipper);
  // A sheet with its back to the viewer is never covered by a patch; this patch crosses it.
  TriangleMesh sheet = lattice({5.3, 5.4}, 50, 50, 1.0, 20.0);
  for (Triangle& t : sheet.triangles)
    std::swap(t[1], t[2]);
  const Scan scan = hand_scan([](Pixel p) { return 20.0 + 0.2 * (p.x - 31.4); },
                              rectangle({12, 12}, {50, 50}), sheet);
  const StitchResult result = stitch(sheet, scan, {.method = method});
  check_mesh(result.mesh);
  CHECK(self_intersections(result.mesh).empty());
  CHECK(result.report.crossing_patch_faces > 0);
  CHECK(std::equal(sheet.triangles.begin(), sheet.triangles.end(), result.mesh.triangles.begin()));
  CHECK(result.mesh.triangles.size() > sheet.triangles.size() + 2000);
}

TEST_CASE("a patch whose seam would leave a hole gives way by as many pixels as told", "[stitch]") {
  const StitchMethod method = GENERATE(StitchMethod::clear_and_fill, StitchMethod::zipper);
  std::array<std::size_t, 3> withdrawn{};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    // Coarse and rough against fine and rough: the band and the limits of the strip are left often.
    shapes::Random random(seed);
    TriangleMesh mesh = lattice({4.3, 4.4}, 18, 18, 3.0, 20.0);
    for (Vec3& p : mesh.positions)
      p.z += random.between(-1.5, 1.5);
    const Scan scan = hand_scan([&](Pixel) { return 20.0 + random.between(-0.8, 0.8); },
                                rectangle({15, 15}, {48, 48}), mesh);
    for (std::size_t radius = 0; radius < withdrawn.size(); ++radius) {
      const StitchResult result =
          stitch(mesh, scan, {.method = method, .withdrawal = static_cast<int>(radius)});
      check_mesh(result.mesh);
      CHECK(self_intersections(result.mesh).empty());
      CHECK(lost_between(mesh, result.mesh).empty());
      withdrawn[radius] += result.report.withdrawn_faces;
    }
  }
  CHECK(withdrawn[0] > 0);
  CHECK(withdrawn[0] < withdrawn[1]);
  CHECK(withdrawn[1] < withdrawn[2]);
}

TEST_CASE("a decimated patch that is withdrawn from a hole stays decimated elsewhere", "[stitch]") {
  std::size_t withdrawn = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);  // rough where it begins under the patch, so that it is withdrawn
    TriangleMesh mesh = lattice({4.3, 4.4}, 18, 18, 3.0, 20.0);
    for (Vec3& p : mesh.positions) {
      if (p.x < 13.0) p.z += random.between(-1.2, 1.2);
    }
    const Scan whole = hand_scan(plane(20.0), rectangle({12, 12}, {52, 52}), mesh);
    Scan decimated = whole;
    decimated.decimate = DecimateOptions{.tolerance = 0.01};
    decimated.whole_patch = whole.patch;
    decimated.patch = decimate(whole.image, whole.patch, *decimated.decimate);
    const StitchResult result = stitch(mesh, decimated);
    check_mesh(result.mesh);
    CHECK(self_intersections(result.mesh).empty());
    CHECK(lost_between(mesh, result.mesh).empty());
    withdrawn += result.report.withdrawn_faces;
    const std::size_t left = whole.patch.mesh.triangles.size() - result.report.withdrawn_faces;
    CHECK(10 * result.report.patch_faces < 9 * left);
  }
  CHECK(withdrawn > 0);
}
