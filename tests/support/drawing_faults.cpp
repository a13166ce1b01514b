#include "tests/support/drawing_faults.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace rangezip {

namespace {

/// A rasterizer of which only render() is asked.
class DrawsOnly : public Rasterizer {
 private:
  DrawReport do_render_in_band(const View&, std::span<const DrawItem>, const DepthBand&,
                               Framebuffer&) override {
    throw std::logic_error("faulty rasterizers do not draw in bands");
  }
  DrawReport do_accumulate(const View&, std::span<const DrawItem>, const AccumulateWindow&,
                           Grid<PixelMoments>&) override {
    throw std::logic_error("faulty rasterizers do not accumulate");
  }
};

/// Changes an image after it was drawn.
class ChangedImage final : public DrawsOnly {
 public:
  using Change = void (*)(Framebuffer&, std::span<const DrawItem>);
  ChangedImage(std::unique_ptr<Rasterizer> right, Change change)
      : right_(std::move(right)), change_(change) {}
  [[nodiscard]] RasterizerInfo info() const override { return right_->info(); }

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override {
    const DrawReport report = right_->render(view, items, out);
    change_(out, items);
    return report;
  }

  std::unique_ptr<Rasterizer> right_;
  Change change_;
};

void add_one_to_depth(Framebuffer& image, std::span<const DrawItem>) {
  for (std::uint32_t& depth : image.depth.pixels()) {
    if (depth < kMaxDepth) ++depth;
  }
}

/// As a wrong base vertex or a lost lowest bit would.
void swap_ids(Framebuffer& image, std::span<const DrawItem> items) {
  PrimitiveId end = 0;
  for (const DrawItem& item : items)
    end = first_id(item) + static_cast<PrimitiveId>(primitive_count(item));
  for (PrimitiveId& id : image.id.pixels()) {
    if (id != kNoPrimitive && (id ^ 1U) < end) id ^= 1U;
  }
}

void move_right(Framebuffer& image, std::span<const DrawItem>) {
  const Extent extent = image.id.extent();
  for (int y = 0; y < extent.height; ++y) {
    std::shift_right(image.id.row(y).begin(), image.id.row(y).end(), 1);
    std::shift_right(image.depth.row(y).begin(), image.depth.row(y).end(), 1);
    image.id[{0, y}] = kNoPrimitive;
    image.depth[{0, y}] = kNoDepth;
  }
}

/// The primitives [begin, end) of an item.
DrawItem part_of(const DrawItem& item, std::size_t begin, std::size_t end) {
  return std::visit(
      [&](auto part) -> DrawItem {
        part.first_id += static_cast<PrimitiveId>(begin);
        if constexpr (std::is_same_v<decltype(part), DrawPoints>) {
          part.positions = part.positions.subspan(begin, end - begin);
          part.votes = {};
        } else {
          part.triangles = part.triangles.subspan(begin, end - begin);
        }
        return part;
      },
      item);
}

PrimitiveId most_seen(const Framebuffer& image) {
  std::map<PrimitiveId, std::size_t> pixels;
  for (const PrimitiveId id : image.id.pixels()) {
    if (id != kNoPrimitive) ++pixels[id];
  }
  const auto most = std::max_element(pixels.begin(), pixels.end(),
                                     [](auto& a, auto& b) { return a.second < b.second; });
  return most == pixels.end() ? kNoPrimitive : most->first;
}

class WithoutAPrimitive final : public DrawsOnly {
 public:
  explicit WithoutAPrimitive(std::unique_ptr<Rasterizer> right) : right_(std::move(right)) {}
  [[nodiscard]] RasterizerInfo info() const override { return right_->info(); }

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override {
    const PrimitiveId missing = most_seen(right_->render(view, items));
    std::vector<DrawItem> kept;
    for (const DrawItem& item : items) {
      const std::size_t index = missing - first_id(item);
      if (missing < first_id(item) || index >= primitive_count(item)) {
        kept.push_back(item);
        continue;
      }
      kept.push_back(part_of(item, 0, index));
      kept.push_back(part_of(item, index + 1, primitive_count(item)));
    }
    return right_->render(view, kept, out);
  }

  std::unique_ptr<Rasterizer> right_;
};

bool is_drawing_fault(const WrongRasterizer& wrong) {
  return wrong.name == "other_edges_own_ties" || wrong.name == "ties_go_to_higher_id";
}

}  // namespace

std::unique_ptr<Rasterizer> without_a_primitive(std::unique_ptr<Rasterizer> right) {
  return std::make_unique<WithoutAPrimitive>(std::move(right));
}

std::vector<WrongRasterizer> drawing_faults(
    const std::function<std::unique_ptr<Rasterizer>()>& make_right) {
  std::vector<WrongRasterizer> faults = wrong_rasterizers(make_right);
  std::erase_if(faults, [](const WrongRasterizer& wrong) { return !is_drawing_fault(wrong); });
  const auto add_change = [&](const char* name, ChangedImage::Change change) {
    faults.push_back({name, [=] { return std::make_unique<ChangedImage>(make_right(), change); }});
  };
  add_change("depth_plus_one", &add_one_to_depth);
  add_change("ids_are_swapped", &swap_ids);
  add_change("viewport_is_off_by_one", &move_right);
  faults.push_back({"a_primitive_is_missing", [=] { return without_a_primitive(make_right()); }});
  return faults;
}

}  // namespace rangezip
