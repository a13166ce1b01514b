#include "tests/support/wrong_rasterizers.h"

#include <array>
#include <span>
#include <utility>

#include "tests/support/raster_oracle.h"

namespace rangezip {

namespace {

RasterizerInfo info_of(const std::string& name) {
  return {.name = name,
          .max_extent = {kMaxRasterExtent, kMaxRasterExtent},
          .max_point_size = kMaxPointSize};
}

/// The oracle as a rasterizer. It counts nothing that is dropped.
class MistakenOracle final : public Rasterizer {
 public:
  explicit MistakenOracle(const oracle::Mistakes& mistakes) : mistakes_(mistakes) {}
  [[nodiscard]] RasterizerInfo info() const override { return info_of("oracle"); }

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override {
    out = oracle::render(view, items, nullptr, mistakes_);
    return {};
  }
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override {
    out = oracle::render(view, items, &band, mistakes_);
    return {};
  }
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override {
    out = oracle::accumulate(view, items, window, mistakes_);
    return {};
  }

  oracle::Mistakes mistakes_;
};

/// The primitives [begin, end) of an item.
DrawItem part_of(const DrawItem& item, std::size_t begin, std::size_t end) {
  if (const auto* points = std::get_if<DrawPoints>(&item)) {
    DrawPoints part = *points;
    part.positions = part.positions.subspan(begin, end - begin);
    if (!part.votes.empty()) part.votes = part.votes.subspan(begin, end - begin);
    part.first_id += static_cast<PrimitiveId>(begin);
    return part;
  }
  DrawTriangles part = std::get<DrawTriangles>(item);
  part.triangles = part.triangles.subspan(begin, end - begin);
  part.first_id += static_cast<PrimitiveId>(begin);
  return part;
}

using Items = std::vector<DrawItem>;

/// Each item in eight parts without their last primitives, as if each thread stopped too early.
Items without_ends_of_parts(std::span<const DrawItem> items) {
  constexpr std::size_t kParts = 8;
  Items kept;
  for (const DrawItem& item : items) {
    const std::size_t count = primitive_count(item);
    for (std::size_t part = 0; part < kParts; ++part) {
      const std::size_t begin = count * part / kParts;
      const std::size_t end = count * (part + 1) / kParts;
      if (end > begin) kept.push_back(part_of(item, begin, end - 1));
    }
  }
  return kept;
}

Items without_votes(std::span<const DrawItem> items) {
  Items changed(items.begin(), items.end());
  for (DrawItem& item : changed) {
    if (auto* points = std::get_if<DrawPoints>(&item)) points->votes = {};
  }
  return changed;
}

/// The halves of every item.
std::array<Items, 2> halves_of(std::span<const DrawItem> items) {
  std::array<Items, 2> halves;
  for (const DrawItem& item : items) {
    const std::size_t count = primitive_count(item);
    halves[0].push_back(part_of(item, 0, count / 2));
    halves[1].push_back(part_of(item, count / 2, count));
  }
  return halves;
}

/// Puts two images together as if depth alone decided.
void merge_by_depth(Framebuffer& onto, const Framebuffer& from) {
  for (std::size_t i = 0; i < onto.depth.pixels().size(); ++i) {
    if (from.depth.pixels()[i] > onto.depth.pixels()[i]) continue;
    onto.depth.pixels()[i] = from.depth.pixels()[i];
    onto.id.pixels()[i] = from.id.pixels()[i];
  }
}

/// Hands other items to a right rasterizer than it was given.
class ChangedItems final : public Rasterizer {
 public:
  using Change = Items (*)(std::span<const DrawItem>);
  ChangedItems(std::unique_ptr<Rasterizer> right, Change change)
      : right_(std::move(right)), change_(change) {}
  [[nodiscard]] RasterizerInfo info() const override { return right_->info(); }

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override {
    return right_->render(view, change_(items), out);
  }
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override {
    return right_->render_in_band(view, change_(items), band, out);
  }
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override {
    return right_->accumulate(view, change_(items), window, out);
  }

  std::unique_ptr<Rasterizer> right_;
  Change change_;
};

/// Draws two halves apart and gives ties to the second, as if threads merged their buffers without
/// a look at the IDs.
class TiesToTheLaterPart final : public Rasterizer {
 public:
  explicit TiesToTheLaterPart(std::unique_ptr<Rasterizer> right) : right_(std::move(right)) {}
  [[nodiscard]] RasterizerInfo info() const override { return right_->info(); }

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override {
    const auto halves = halves_of(items);
    const DrawReport first = right_->render(view, halves[0], out);
    Framebuffer later;
    const DrawReport second = right_->render(view, halves[1], later);
    merge_by_depth(out, later);
    return {.dropped_points = first.dropped_points + second.dropped_points,
            .dropped_triangles = first.dropped_triangles + second.dropped_triangles};
  }
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override {
    return right_->render_in_band(view, items, band, out);
  }
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override {
    return right_->accumulate(view, items, window, out);
  }

  std::unique_ptr<Rasterizer> right_;
};

}  // namespace

std::vector<WrongRasterizer> wrong_rasterizers(
    const std::function<std::unique_ptr<Rasterizer>()>& make_right) {
  std::vector<WrongRasterizer> wrong;
  const auto add_mistake = [&](const char* name, const oracle::Mistakes& mistakes) {
    wrong.push_back({name, [=] { return std::make_unique<MistakenOracle>(mistakes); }, true});
  };
  add_mistake("other_edges_own_ties", {.other_edges_own_ties = true});
  add_mistake("depth_rounds_to_nearest", {.depth_rounds_to_nearest = true});
  add_mistake("quotient_in_float", {.quotient_in_float = true});
  add_mistake("halves_go_down", {.halves_go_down = true});
  add_mistake("ties_go_to_higher_id", {.ties_go_to_higher_id = true});
  add_mistake("points_lean_left", {.points_lean_left = true});
  add_mistake("denormals_are_zero", {.denormals_are_zero = true});
  add_mistake("band_is_open", {.band_is_open = true});
  add_mistake("shift_rounds_to_zero", {.shift_rounds_to_zero = true});
  const auto add_change = [&](const char* name, ChangedItems::Change change) {
    wrong.push_back({name, [=] { return std::make_unique<ChangedItems>(make_right(), change); }});
  };
  add_change("parts_lose_their_last", &without_ends_of_parts);
  add_change("votes_are_lost", &without_votes);
  wrong.push_back({"ties_go_to_the_later_part",
                   [=] { return std::make_unique<TiesToTheLaterPart>(make_right()); }});
  return wrong;
}

}  // namespace rangezip
