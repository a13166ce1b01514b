#include "raster_gl/compute_triangles.h"

#include <algorithm>
#include <numeric>

#include "core/base/error.h"
#include "raster_gl/gathered_triangles.h"

namespace rangezip {

namespace {

constexpr std::size_t kBytesPerTile = 2 * sizeof(std::uint32_t);

int number_of(Facing facing) {
  if (facing == Facing::both) return 0;
  return facing == Facing::front ? 1 : -1;
}

}  // namespace

ComputeTriangles::ComputeTriangles(const ComputeTools& tools, ComputeTarget& target)
    : tools_(tools),
      target_(target),
      rows_(tools.device),
      counters_(tools.device),
      snapped_(tools.device),
      rejected_(tools.device),
      tiles_(tools.device),
      piece_snapped_(tools.device),
      piece_corners_(tools.device),
      piece_ids_(tools.device),
      piece_tiles_(tools.device) {
  constexpr std::size_t kUsualTiles = 4096;
  tiles_.reserve(kUsualTiles * kBytesPerTile, "tiles");
  piece_tiles_.reserve(kUsualTiles * kBytesPerTile, "tiles");
  piece_ids_.reserve(sizeof(PrimitiveId), "IDs");
}

std::size_t ComputeTriangles::draw(const DrawTriangles& item, const RowTransform& rows) {
  if (item.triangles.empty()) return 0;
  rows_.upload(rows);
  if (item.positions.size() > tools_.chunk_of(sizeof(PlacedPosition)))
    return draw_gathered(item, rows);
  rows_.snap(tools_, item.positions,
             {.content_key = item.content_key, .count = item.positions.size()}, snapped_);
  const std::size_t chunk = tools_.chunk_of(sizeof(Triangle));
  std::size_t dropped = 0;
  for (std::size_t end = item.triangles.size(); end > 0;) {
    const std::size_t begin = (end - 1) / chunk * chunk;
    const GlBuffer& corners = tools_.uploads.get(
        {.content_key = item.content_key, .is_corners = true, .first = begin, .count = end - begin},
        item.triangles.subspan(begin, end - begin));
    dropped += draw_range({item, rows, corners, begin}, begin, end);
    end = begin;
  }
  return dropped;
}

/// For items with more positions than a buffer holds: each chunk of triangles brings its own.
std::size_t ComputeTriangles::draw_gathered(const DrawTriangles& item, const RowTransform& rows) {
  const std::size_t chunk = tools_.chunk_of(3 * sizeof(PlacedPosition));
  std::size_t dropped = 0;
  for (std::size_t end = item.triangles.size(); end > 0;) {
    const std::size_t begin = (end - 1) / chunk * chunk;
    const GatheredTriangles part = gather(item, begin, end);
    rows_.snap(tools_, part.positions, {}, snapped_);
    const GlBuffer& corners = tools_.uploads.get({}, std::span<const Triangle>(part.triangles));
    dropped += draw_range({item, rows, corners, begin}, begin, end);
    end = begin;
  }
  return dropped;
}

/// Draws the item's triangles [begin, end), in halves if there are too many tiles for a buffer.
std::size_t ComputeTriangles::draw_range(const Source& source, std::size_t begin, std::size_t end) {
  Batch whole{.snapped = snapped_,
              .corners = source.corners,
              .ids = nullptr,
              .tiles = tiles_,
              .facing = source.item.facing,
              .first = begin - source.first,
              .count = end - begin,
              .first_id = source.item.first_id + static_cast<PrimitiveId>(begin)};
  std::size_t rejected = 0;
  bool fits = list_tiles(whole, rejected);
  std::size_t dropped = 0;
  Batch cut_off{.snapped = piece_snapped_,
                .corners = piece_corners_,
                .ids = &piece_ids_,
                .tiles = piece_tiles_,
                .facing = source.item.facing};
  if (fits && rejected > 0) {
    dropped = cut(source, begin, rejected);
    cut_off.count = pieces_.size();
    std::size_t none = 0;
    fits = list_tiles(cut_off, none);
  }
  if (!fits && whole.count > 1) {
    const std::size_t middle = begin + whole.count / 2;
    dropped = draw_range(source, middle, end);
    return dropped + draw_range(source, begin, middle);
  }
  if (!fits) throw BackendError("OpenGL: one triangle takes more tiles than a buffer holds");
  for (const DrawPass pass : target_.passes()) {
    plot(whole, pass);
    plot(cut_off, pass);
  }
  return dropped;
}

/// Cuts the triangles of the list that the last list_tiles() made. @return those dropped
std::size_t ComputeTriangles::cut(const Source& source, std::size_t begin, std::size_t rejected) {
  std::vector<std::uint32_t> numbers(rejected);
  rejected_.download(std::span(numbers));
  pieces_.clear();
  ids_of_pieces_.clear();
  std::size_t dropped = 0;
  for (const std::uint32_t number : numbers) {
    const std::size_t index = begin + number;
    const auto& [a, b, c] = source.item.triangles[index];
    const std::span<const Vec3f> at = source.item.positions;
    if (!split_triangle(source.rows, {at[a], at[b], at[c]}, pieces_)) ++dropped;
    ids_of_pieces_.resize(pieces_.size(), source.item.first_id + static_cast<PrimitiveId>(index));
  }
  std::vector<std::uint32_t> indices(3 * pieces_.size());
  std::iota(indices.begin(), indices.end(), 0U);
  std::vector<PlacedPosition> corners;
  corners.reserve(3 * pieces_.size());
  for (const SnappedTriangle& piece : pieces_) {
    for (const SnappedPosition& p : piece)
      corners.push_back({p.x, p.y, p.z, Place::outside});  // never left to the hardware
  }
  piece_snapped_.upload(std::span<const PlacedPosition>(corners), "pieces of triangles");
  piece_corners_.upload(std::span<const std::uint32_t>(indices), "pieces of triangles");
  piece_ids_.upload(std::span<const PrimitiveId>(ids_of_pieces_), "pieces of triangles");
  return dropped;
}

/// Lists the tiles of the batch's large triangles, and the triangles with a rejected corner.
/// @return false if they are more than a buffer holds
bool ComputeTriangles::list_tiles(Batch& batch, std::size_t& rejected) {
  const GlProgram& program = target_.kernel(Kernel::classify_triangles, {});
  rejected_.reserve(batch.count * sizeof(std::uint32_t), "rejected triangles");
  tools_.kernels.bind(Binding::rejected, rejected_);
  for (;;) {
    const std::size_t capacity = batch.tiles.capacity() / kBytesPerTile;
    counters_.restart(tools_.kernels);
    bind(program, batch);
    program.set("tile_capacity", static_cast<unsigned>(capacity));
    tools_.kernels.dispatch(program, groups_of(batch.count, kTriangleGroup));
    tools_.device.check("listing triangles");
    const auto counters = counters_.read();
    rejected = counters[static_cast<std::size_t>(Counter::rejected_triangles)];
    batch.tile_count = counters[static_cast<std::size_t>(Counter::tiles)];
    if (batch.tile_count <= capacity) return true;
    if (batch.tile_count * kBytesPerTile > tools_.setup.block_bytes) return false;
    batch.tiles.reserve(batch.tile_count * kBytesPerTile, "tiles");
  }
}

void ComputeTriangles::bind(const GlProgram& program, const Batch& batch) const {
  const Kernels& kernels = tools_.kernels;
  kernels.bind(Binding::snapped, batch.snapped);
  kernels.bind(Binding::corners, batch.corners);
  kernels.bind(Binding::ids, batch.ids != nullptr ? *batch.ids : piece_ids_);
  kernels.bind(Binding::tiles, batch.tiles);
  program.set("count", static_cast<unsigned>(batch.count));
  program.set("first_triangle", static_cast<unsigned>(batch.first));
  program.set("first_id", batch.first_id);
  program.set("has_ids", batch.ids != nullptr ? 1U : 0U);
  program.set("facing", number_of(batch.facing));
}

void ComputeTriangles::plot(const Batch& batch, DrawPass pass) const {
  if (batch.count == 0) return;
  const GlProgram& small = target_.kernel(Kernel::draw_small_triangles, {.pass = pass});
  bind(small, batch);
  tools_.kernels.dispatch(small, groups_of(batch.count, kTriangleGroup));
  if (batch.tile_count > 0) {
    const GlProgram& large = target_.kernel(Kernel::draw_tiles, {.pass = pass});
    bind(large, batch);
    large.set("count", static_cast<unsigned>(batch.tile_count));
    tools_.kernels.dispatch(large, batch.tile_count);
  }
  tools_.device.check("drawing triangles");
}

}  // namespace rangezip
