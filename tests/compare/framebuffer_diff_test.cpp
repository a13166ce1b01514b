#include "compare/framebuffer_diff.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/image/range_image.h"

using namespace rangezip;
using namespace rangezip::compare;

namespace {

/// 4 x 3 pixels; the lower row drawn with IDs 10..13 at depth 1000.
Framebuffer lower_row_drawn() {
  Framebuffer buffer = make_framebuffer({4, 3});
  for (int x = 0; x < 4; ++x) {
    buffer.id[{x, 0}] = 10U + static_cast<PrimitiveId>(x);
    buffer.depth[{x, 0}] = 1000;
  }
  return buffer;
}

}  // namespace

TEST_CASE("a framebuffer is identical to its copy") {
  const FramebufferDiff diff = compare_framebuffers(lower_row_drawn(), lower_row_drawn());
  CHECK(diff.identical());
  CHECK(diff.pixels == 12);
  CHECK(diff.missing + diff.unexpected + diff.id_differences + diff.depth_differences == 0);
}

TEST_CASE("each kind of difference is counted as what it is, once a pixel") {
  const Framebuffer reference = lower_row_drawn();
  Framebuffer candidate = reference;
  candidate.id[{0, 0}] = kNoPrimitive;  // missing
  candidate.depth[{0, 0}] = kNoDepth;
  candidate.id[{2, 2}] = 5;  // unexpected
  candidate.depth[{2, 2}] = 7;
  candidate.id[{1, 0}] = 99;      // another primitive
  candidate.depth[{2, 0}] = 990;  // another depth, nearer
  candidate.id[{3, 0}] = 98;      // both
  candidate.depth[{3, 0}] = 1025;

  const FramebufferDiff diff = compare_framebuffers(reference, candidate);
  CHECK_FALSE(diff.identical());
  CHECK(diff.missing == 1);
  CHECK(diff.unexpected == 1);
  CHECK(diff.id_differences == 2);
  CHECK(diff.depth_differences == 2);
  CHECK(diff.largest_depth_step == 25);
  CHECK(diff.first == Pixel{0, 0});
}

TEST_CASE("swapping reference and candidate swaps missing and unexpected") {
  Framebuffer candidate = lower_row_drawn();
  candidate.id[{1, 0}] = kNoPrimitive;
  candidate.depth[{1, 0}] = kNoDepth;
  CHECK(compare_framebuffers(lower_row_drawn(), candidate).missing == 1);
  CHECK(compare_framebuffers(candidate, lower_row_drawn()).unexpected == 1);
}

TEST_CASE("a depth left in an empty pixel is a difference although no ID differs") {
  Framebuffer candidate = lower_row_drawn();
  candidate.depth[{3, 2}] = 12;
  const FramebufferDiff diff = compare_framebuffers(lower_row_drawn(), candidate);
  CHECK_FALSE(diff.identical());
  CHECK(diff.depth_differences == 1);
  CHECK(diff.first == Pixel{3, 2});
}

TEST_CASE("IDs above 2^24 and 2^31 that differ in the lowest bit differ") {
  for (const PrimitiveId id : {PrimitiveId{1} << 24U, PrimitiveId{1} << 31U, kNoPrimitive - 2}) {
    Framebuffer reference = lower_row_drawn();
    reference.id[{0, 0}] = id;
    Framebuffer candidate = reference;
    candidate.id[{0, 0}] = id ^ 1U;
    CHECK(compare_framebuffers(reference, candidate).id_differences == 1);
  }
}

TEST_CASE("framebuffers of other extents are refused") {
  CHECK_THROWS_AS(compare_framebuffers(make_framebuffer({4, 3}), make_framebuffer({3, 4})),
                  InvalidArgument);
  Framebuffer torn = make_framebuffer({4, 3});
  torn.depth.reset({4, 4});
  CHECK_THROWS_AS(compare_framebuffers(make_framebuffer({4, 3}), torn), InvalidArgument);
}

TEST_CASE("depth images: steps are measured between samples only") {
  Grid<double> reference({3, 1}, kNoSample);
  reference[{0, 0}] = 2.0;
  reference[{1, 0}] = 3.0;
  Grid<double> candidate({3, 1}, kNoSample);
  candidate[{0, 0}] = 2.25;
  candidate[{2, 0}] = 9.0;

  const GridDiff diff = compare_depths(reference, candidate);
  CHECK(diff.differences == 3);
  CHECK(diff.missing == 1);
  CHECK(diff.unexpected == 1);
  CHECK(diff.largest_step == 0.25);
  CHECK(diff.first == Pixel{0, 0});
  CHECK(compare_depths(reference, reference).identical());
}

TEST_CASE("ID images and masks are compared by value") {
  Grid<PrimitiveId> ids({2, 2}, kNoPrimitive);
  Grid<PrimitiveId> other_ids = ids;
  other_ids[{1, 1}] = 3;
  CHECK(compare_ids(ids, ids).identical());
  CHECK(compare_ids(ids, other_ids).unexpected == 1);
  CHECK(compare_ids(other_ids, ids).missing == 1);

  Mask mask({2, 2}, 1);
  Mask other_mask = mask;
  other_mask[{0, 1}] = 0;
  CHECK(compare_masks(mask, mask).identical());
  CHECK(compare_masks(mask, other_mask).missing == 1);
  CHECK(compare_masks(mask, other_mask).first == Pixel{0, 1});
}

TEST_CASE("images of other extents are refused") {
  CHECK_THROWS_AS(compare_depths(Grid<double>({1, 2}), Grid<double>({2, 1})), InvalidArgument);
  CHECK_THROWS_AS(compare_ids(Grid<PrimitiveId>({1, 2}), Grid<PrimitiveId>({2, 1})),
                  InvalidArgument);
  CHECK_THROWS_AS(compare_masks(Mask({1, 2}), Mask({2, 1})), InvalidArgument);
}
