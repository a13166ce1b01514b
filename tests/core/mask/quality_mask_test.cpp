#include "core/mask/quality_mask.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/images.h"

namespace rangezip {
namespace {

const Extent kExtent{12, 10};

RangeImage tilted(double slope, double pixel_size = 0.5) {
  return images::image_of(images::parallel_view(kExtent, pixel_size, 1000.0),
                          [=](Pixel p) { return 100.0 + slope * pixel_size * p.x; });
}

/// A mesh whose only face has a longest side of this length.
TriangleMesh face_of_length(double length) {
  return {.positions = {{0, 0, 0}, {length, 0, 0}, {0.5 * length, 0.5 * length, 0}},
          .triangles = {{0, 1, 2}},
          .sources = {}};
}

Correspondence all_on_face(PrimitiveId face) {
  return {.face = Grid<PrimitiveId>(kExtent, face), .from_behind = Mask(kExtent, 0)};
}

TEST_CASE("sample_quality is the longest edge of the grid at a sample", "[mask]") {
  const Mask all = full_mask(kExtent);
  const RangeImage flat = tilted(0.0);
  const Grid<double> level = sample_quality(flat, estimate_slopes(flat), all, false);
  // All cells are cut from (x, y) to (x + 1, y + 1), so the other two corners have no diagonal.
  CHECK(level[{5, 5}] == Approx(0.5 * std::sqrt(2.0)).epsilon(1e-12));
  CHECK(level[{0, 9}] == Approx(0.5).epsilon(1e-12));

  // On a slope along x of 2 the diagonal spans (1, 1, 2) pixel sides.
  const RangeImage steep = tilted(2.0);
  CHECK(sample_quality(steep, estimate_slopes(steep), all, false)[{5, 5}] ==
        Approx(0.5 * std::sqrt(6.0)).epsilon(1e-12));
  // The smooth measure is the mean of that and of sqrt(2 + 1.5 slope^2).
  CHECK(sample_quality(steep, estimate_slopes(steep), all, true)[{5, 5}] ==
        Approx(0.25 * (std::sqrt(6.0) + std::sqrt(8.0))).epsilon(1e-12));
}

TEST_CASE("sample_quality is better for a finer and for a less tilted view", "[mask]") {
  const auto quality = [](double slope, double pixel_size, bool smooth) {
    const RangeImage image = tilted(slope, pixel_size);
    return sample_quality(image, estimate_slopes(image), full_mask(kExtent), smooth)[{5, 5}];
  };
  for (const bool smooth : {false, true}) {
    CHECK(quality(0.0, 0.5, smooth) < quality(1.0, 0.5, smooth));
    CHECK(quality(1.0, 0.5, smooth) < quality(2.0, 0.5, smooth));
    CHECK(quality(1.0, 0.25, smooth) == Approx(0.5 * quality(1.0, 0.5, smooth)).epsilon(1e-12));
  }
}

TEST_CASE("sample_quality knows no quality where triangulate would build nothing", "[mask]") {
  RangeImage image = tilted(0.0);
  image[{5, 5}] = kNoSample;
  Mask active = full_mask(kExtent);
  for (int y = 0; y < kExtent.height; ++y)
    active[{8, y}] = active[{10, y}] = 0;
  const Grid<double> quality = sample_quality(image, estimate_slopes(image), active);
  CHECK(quality[{5, 5}] == kNoSample);
  CHECK(quality[{8, 3}] == kNoSample);
  CHECK(quality[{9, 3}] == kNoSample);  // a column of its own has no cells
  CHECK(quality[{4, 5}] < 1.0);

  const RangeImage steep = tilted(3.0);
  const Grid<double> broken =
      sample_quality(steep, estimate_slopes(steep), full_mask(kExtent), true, {.max_edge = 2.0});
  CHECK(broken[{5, 5}] == kNoSample);  // steps of 3 pixel sides, allowed 2.83
}

TEST_CASE("keep_better_samples compares with the longest side of the old face", "[mask]") {
  const RangeImage image = tilted(0.0);
  const SlopeImage slopes = estimate_slopes(image);
  const Grid<double> quality(kExtent, 1.0);
  const Mask all = full_mask(kExtent);
  const auto kept = [&](double old_length, const QualityMaskOptions& options = {}) {
    return images::count_of(keep_better_samples(quality, slopes, all, face_of_length(old_length),
                                                all_on_face(0), options));
  };
  CHECK(kept(1.2) == 0);  // 0.8 * 1.2 < 1
  CHECK(kept(1.26) == kExtent.count());
  CHECK(kept(1.01, {.hysteresis = 1.0}) == kExtent.count());
  CHECK(kept(1.0, {.hysteresis = 1.0}) == 0);  // equal quality: the old surface stays
}

TEST_CASE("keep_better_samples keeps what extends the surface, never what is seen from behind",
          "[mask]") {
  const RangeImage image = tilted(2.0);
  const SlopeImage slopes = estimate_slopes(image);
  const Grid<double> quality(kExtent, 1.0);
  Correspondence found = all_on_face(0);
  found.face[{3, 3}] = kNoPrimitive;
  found.face[{4, 4}] = kNoPrimitive;
  found.from_behind[{4, 4}] = 1;
  Mask active = full_mask(kExtent);
  const TriangleMesh fine = face_of_length(0.01);
  const Mask kept = keep_better_samples(quality, slopes, active, fine, found);
  CHECK(images::count_of(kept) == 1);
  CHECK(kept[{3, 3}] == 1);

  active[{3, 3}] = 0;
  CHECK(images::count_of(keep_better_samples(quality, slopes, active, fine, found)) == 0);

  // Steep samples extend, but never replace.
  const TriangleMesh coarse = face_of_length(100.0);
  CHECK(images::count_of(keep_better_samples(quality, slopes, full_mask(kExtent), coarse, found,
                                             {.max_replacing_slope = 1.5})) == 1);
  CHECK(images::count_of(keep_better_samples(quality, slopes, full_mask(kExtent), coarse, found,
                                             {.max_replacing_slope = 2.5})) == kExtent.count() - 1);
}

TEST_CASE("keep_unmatched_samples keeps pieces that are large enough", "[mask]") {
  Correspondence found = all_on_face(0);
  const std::vector<Pixel> diagonal{{1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5}};
  for (const Pixel p : diagonal)
    found.face[p] = kNoPrimitive;
  for (const Pixel p : {Pixel{9, 1}, Pixel{9, 2}, Pixel{10, 1}, Pixel{10, 2}}) {
    found.face[p] = kNoPrimitive;
  }
  const Mask all = full_mask(kExtent);
  CHECK(images::count_of(keep_unmatched_samples(all, found)) == 5);
  CHECK(images::count_of(keep_unmatched_samples(all, found, 4)) == 9);
  CHECK(images::count_of(keep_unmatched_samples(all, found, 6)) == 0);
  found.from_behind[{3, 3}] = 1;  // splits the diagonal
  CHECK(images::count_of(keep_unmatched_samples(all, found)) == 0);
}

TEST_CASE("quality masks refuse images of other extents", "[mask]") {
  const RangeImage image = tilted(0.0);
  const SlopeImage slopes = estimate_slopes(image);
  const Mask small(Extent{3, 3}, 1);
  CHECK_THROWS_AS(sample_quality(image, slopes, small), InvalidArgument);
  CHECK_THROWS_AS(
      keep_better_samples(Grid<double>(kExtent, 1.0), slopes, small, {}, all_on_face(kNoPrimitive)),
      InvalidArgument);
  CHECK_THROWS_AS(keep_unmatched_samples(small, all_on_face(kNoPrimitive)), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
