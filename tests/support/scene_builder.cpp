#include "tests/support/scene_builder.h"

#include <limits>

#include "tests/support/lattice.h"

namespace rangezip::scenes {

int whole(Random& random, int lower, int upper) {
  const auto span = static_cast<std::uint64_t>(upper - lower + 1);
  return lower + static_cast<int>(random.bits() % span);
}

Extent random_extent(Random& random) {
  return {whole(random, 1, 40), whole(random, 1, 40)};
}

float random_depth(Random& random) {
  constexpr int kMax = static_cast<int>(kMaxDepth);
  switch (whole(random, 0, 5)) {
    case 0:
      return static_cast<float>(whole(random, -3, 3));
    case 1:
      return static_cast<float>(kMax + whole(random, -3, 3));
    case 2:
      return 1000.0F;
    default:
      return static_cast<float>(whole(random, 0, kMax));
  }
}

float anywhere(Random& random, int size, int margin) {
  return static_cast<float>(whole(random, -margin * 256, (size + margin) * 256));
}

float not_finite(Random& random) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const int kind = whole(random, 0, 2);
  return kind == 0 ? std::numeric_limits<float>::quiet_NaN() : (kind == 1 ? kInf : -kInf);
}

Facing random_facing(Random& random) {
  return static_cast<Facing>(whole(random, 0, 2));
}

std::vector<std::int8_t> random_votes(Random& random, std::size_t count) {
  std::vector<std::int8_t> votes(count);
  for (std::int8_t& vote : votes)
    vote = static_cast<std::int8_t>(whole(random, -127, 127));
  return votes;
}

void SceneBuilder::add_points(std::vector<Vec3f> positions, int size,
                              std::vector<std::int8_t> votes) {
  const auto count = static_cast<PrimitiveId>(positions.size());
  scene_.positions.push_back(std::move(positions));
  scene_.votes.push_back(std::move(votes));
  scene_.items.emplace_back(DrawPoints{.positions = scene_.positions.back(),
                                       .world_from_item = placement_,
                                       .first_id = next_id_,
                                       .point_size = size,
                                       .votes = scene_.votes.back()});
  next_id_ += count;
}

void SceneBuilder::add_triangles(std::vector<Vec3f> positions, std::vector<Triangle> corners,
                                 Facing facing) {
  const auto count = static_cast<PrimitiveId>(corners.size());
  scene_.positions.push_back(std::move(positions));
  scene_.corners.push_back(std::move(corners));
  scene_.items.emplace_back(DrawTriangles{.positions = scene_.positions.back(),
                                          .triangles = scene_.corners.back(),
                                          .world_from_item = placement_,
                                          .first_id = next_id_,
                                          .facing = facing});
  next_id_ += count;
}

void SceneBuilder::add_soup(std::vector<Vec3f> positions, Facing facing) {
  std::vector<Triangle> corners;
  for (std::uint32_t i = 0; i + 2 < positions.size(); i += 3) {
    corners.push_back({i, i + 1, i + 2});
  }
  add_triangles(std::move(positions), std::move(corners), facing);
}

SceneBuilder lattice_builder(Extent extent) {
  return {lattice::view(extent), lattice::placement(extent)};
}

}  // namespace rangezip::scenes
