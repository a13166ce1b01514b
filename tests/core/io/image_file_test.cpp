#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/image/range_image.h"
#include "core/io/file_hash.h"
#include "core/io/image_file.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

namespace rangezip {

using test::load;
using test::TemporaryFolder;

TEST_CASE("Depths come back from PFM as the nearest floats, missing ones as missing") {
  const TemporaryFolder folder;
  shapes::Random random(1);
  Grid<double> image(Extent{37, 21});
  for (double& depth : image.pixels()) {
    depth = random.bits() % 5 == 0 ? kNoSample : random.between(0.1, 1e4);
  }
  write_pfm(folder / "a.pfm", image);
  const Grid<double> back = read_pfm(folder / "a.pfm");
  REQUIRE(back.extent() == image.extent());
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    CHECK(back.pixels()[i] == static_cast<double>(static_cast<float>(image.pixels()[i])));
  }
  write_pfm(folder / "b.pfm", back);
  CHECK(read_pfm(folder / "b.pfm") == back);
}

TEST_CASE("A PFM file has the bottom row first, four bytes a pixel, lowest first") {
  const TemporaryFolder folder;
  Grid<double> image(Extent{2, 2});
  image[{0, 0}] = 1.0;
  image[{1, 0}] = 2.0;
  image[{0, 1}] = -0.5;
  image[{1, 1}] = kNoSample;
  write_pfm(folder / "a.pfm", image);
  const std::string expected{
      "Pf\n2 2\n-1.0\n\x00\x00\x80\x3f\x00\x00\x00\x40\x00\x00\x00\xbf\x00\x00\x80\x7f", 28};
  CHECK(load(folder / "a.pfm") == expected);
  const std::string big{
      "Pf 2 2\n1.0\n\x3f\x80\x00\x00\x40\x00\x00\x00\xbf\x00\x00\x00\x7f\x80\x00\x00", 27};
  CHECK(read_pfm(folder.store("big.pfm", big)) == image);
}

TEST_CASE("Masks come back from PNG, the top row first in the file") {
  const TemporaryFolder folder;
  shapes::Random random(2);
  Mask mask(Extent{19, 33});
  for (std::uint8_t& active : mask.pixels())
    active = random.bits() % 2 == 0 ? 1 : 0;
  write_mask_png(folder / "a.png", mask);
  CHECK(read_mask_png(folder / "a.png") == mask);
}

TEST_CASE("IDs come back from PNG with all 32 bits") {
  const TemporaryFolder folder;
  shapes::Random random(3);
  Grid<PrimitiveId> ids(Extent{64, 17}, kNoPrimitive);
  for (PrimitiveId& id : ids.pixels())
    id = static_cast<PrimitiveId>(random.bits());
  ids[{0, 0}] = kNoPrimitive;
  ids[{1, 0}] = 0;
  ids[{2, 0}] = 0x0100'0000U;
  ids[{3, 0}] = 0x8000'0000U;
  ids[{4, 0}] = 0x1234'5600U;
  write_id_png(folder / "a.png", ids);
  CHECK(read_id_png(folder / "a.png") == ids);
}

TEST_CASE("Pictures come back from PNG") {
  const TemporaryFolder folder;
  Grid<Rgb> image(Extent{3, 2}, Rgb{10, 20, 30});
  image[{2, 1}] = {255, 0, 1};
  write_rgb_png(folder / "a.png", image);
  CHECK(read_rgb_png(folder / "a.png") == image);
}

TEST_CASE("Image files that are not what they claim to be are refused") {
  const TemporaryFolder folder;
  Mask mask(Extent{40, 40}, 1);
  write_mask_png(folder / "mask.png", mask);
  const std::string png = load(folder / "mask.png");
  CHECK_THROWS_AS(read_id_png(folder / "mask.png"), IoError);
  CHECK_THROWS_AS(read_rgb_png(folder / "mask.png"), IoError);
  CHECK_THROWS_AS(read_mask_png(folder / "none.png"), IoError);
  for (std::size_t length = 0; length + 12 < png.size(); ++length) {  // all but the end mark
    CAPTURE(length);
    CHECK_THROWS_AS(read_mask_png(folder.store("cut.png", png.substr(0, length))), IoError);
  }
  for (const std::string text :
       {"", "Pf", "PF\n1 1\n-1.0\nabcdabcdabcd", "Pf\n1 1\n-1.0\nabc", "Pf\n1 1\n-1.0\nabcde",
        "Pf\n0 1\n-1.0\n", "Pf\n1.5 1\n-1.0\nabcdef", "Pf\n16777217 1\n-1.0\nabcd",
        "Pf\na 1\n-1.0\nabcd", "Pf\n16777216 16777216\n-1.0\nabcd", "Pf\n1 1\nnan\nabcd"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(read_pfm(folder.store("bad.pfm", text)), IoError);
  }
}

TEST_CASE("Images without pixels and places that cannot be written are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(write_pfm(folder / "a.pfm", {}), InvalidArgument);
  CHECK_THROWS_AS(write_mask_png(folder / "a.png", {}), InvalidArgument);
  CHECK_THROWS_AS(write_id_png(folder / "a.png", {}), InvalidArgument);
  CHECK_THROWS_AS(write_rgb_png(folder / "a.png", {}), InvalidArgument);
  CHECK_THROWS_AS(write_pfm(folder / "none/a.pfm", Grid<double>(Extent{1, 1})), IoError);
  CHECK_THROWS_AS(write_mask_png(folder / "none/a.png", Mask(Extent{1, 1})), IoError);
  CHECK(folder.count() == 0);
}

TEST_CASE("The hash of a file is FNV-1a of its bytes") {
  // Published values of the 64-bit FNV-1a test suite.
  CHECK(hash_bytes("") == 0xcbf29ce484222325U);
  CHECK(hash_bytes("a") == 0xaf63dc4c8601ec8cU);
  CHECK(hash_bytes("foobar") == 0x85944171f73967e8U);
  const TemporaryFolder folder;
  CHECK(hash_file(folder.store("a.gz", "foobar")) == hash_bytes("foobar"));
  CHECK_THROWS_AS(hash_file(folder.path()), IoError);
}

}  // namespace rangezip
