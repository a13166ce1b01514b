#include "apps/rangezip-compare/draw_command.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

#include "apps/rangezip-compare/drawing_report.h"
#include "apps/rangezip-compare/json_file.h"
#include "apps/rangezip/backend.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/outputs.h"
#include "compare/difference_picture.h"
#include "compare/drawing_files.h"
#include "compare/drawing_judge.h"
#include "compare/views_around.h"
#include "core/base/error.h"
#include "core/io/image_file.h"
#include "core/io/input_file.h"
#include "core/io/session_file.h"

namespace rangezip::compare {

namespace {

using Json = nlohmann::ordered_json;

/// What is drawn, the same for all.
struct Drawn {
  std::vector<View> views;
  std::vector<DrawItem> items;
};

/// Something that draws all views: a backend, or the files of another program, of one view.
struct Painter {
  std::string name;
  std::string renderer;
  bool is_exact = false;
  int subpixel_bits = 8;
  std::unique_ptr<Rasterizer> rasterizer;  ///< null: `drawing` is all there is
  Framebuffer drawing;

  void draw(const View& view, std::span<const DrawItem> items, Framebuffer& out) const {
    if (rasterizer) {
      rasterizer->render(view, items, out);
    } else {
      out = drawing;
    }
  }
};

/// A candidate, judged so far.
struct Judged {
  Painter painter;
  std::optional<DrawingTolerance> tolerance;  ///< absent: none, both are exact
  DrawingCounts total;
  Json views = Json::array();

  [[nodiscard]] bool is_good() const { return total.of(Cause::unexplained) == 0; }
};

/// A backend, with OpenGL and a strategy that was asked for.
struct Brush {
  std::string backend;
  std::string strategy;

  /// "gl:osmesa compute"
  [[nodiscard]] std::string name() const {
    return strategy.empty() ? backend : backend + " " + strategy;
  }
};

std::vector<Brush> brushes_of(const DrawCommand& command) {
  std::vector<Brush> brushes;
  for (const std::string& backend : command.backends) {
    if (command.strategies.empty() || !app::is_gl(backend)) {
      brushes.push_back({.backend = backend});
      continue;
    }
    for (const std::string& strategy : command.strategies)
      brushes.push_back({.backend = backend, .strategy = strategy});
  }
  return brushes;
}

void check_options(const DrawCommand& command) {
  if (command.depth.has_value() != command.ids.has_value()) {
    throw app::UsageError("draw: --depth and --ids belong together");
  }
  if (command.depth && !command.view_of) {
    throw app::UsageError("draw: --depth and --ids need --view-of, the session with their view");
  }
  const auto& backends = command.backends;
  if (!command.strategies.empty() && std::none_of(backends.begin(), backends.end(), app::is_gl)) {
    throw app::UsageError(
        "draw: --strategy is how OpenGL draws, but none of --backends is 'gl' or "
        "begins with 'gl:'");
  }
  if (brushes_of(command).size() + (command.depth ? 1 : 0) < 2) {
    throw app::UsageError(
        "draw: nothing to compare with: give two --backends (or one with OpenGL and two of "
        "--strategy), or one and --depth and --ids");
  }
  if (command.json) check_json_place(*command.json);
  if (!command.images) return;
  if (!std::filesystem::is_directory(*command.images)) {
    throw app::OutputError("--images " + command.images->string() + ": there is no such folder");
  }
  if (access(command.images->c_str(), W_OK | X_OK) != 0) {
    throw app::OutputError("--images " + command.images->string() + ": is not writable");
  }
}

/// The first scan of a session.
ScanRequest read_scan_request(const std::filesystem::path& path) {
  for (const Command& step : read_session(path).commands) {
    if (const auto* add_scan = std::get_if<AddScan>(&step)) return add_scan->scan;
  }
  throw IoError(path.string() + ": /commands: must hold a scan, whose view is taken");
}

View checked_view(const Camera& camera, Extent extent, const std::filesystem::path& path) {
  try {
    return View(camera, extent);
  } catch (const InvalidArgument& error) {
    throw IoError(path.string() + ": /commands: " + error.what());
  }
}

Drawn prepare(const DrawCommand& command, const Scene& scene) {
  if (!command.view_of) {
    return {.views = views_around(scene.bounds(), command.views, command.size),
            .items = scene.draw_items(command.point_size)};
  }
  const ScanRequest scan = read_scan_request(*command.view_of);
  return {.views = {checked_view(scan.camera, scan.extent, *command.view_of)},
          .items = scene.draw_items(scan.point_size)};
}

Painter make_painter(const Brush& brush) {
  Painter painter{.name = brush.name(),
                  .rasterizer = app::make_rasterizer(brush.backend, brush.strategy)};
  const RasterizerInfo info = painter.rasterizer->info();
  painter.renderer = info.name;
  painter.is_exact = info.reproducible;
  painter.subpixel_bits = info.subpixel_bits;
  return painter;
}

Painter read_painter(const DrawCommand& command, const View& view) {
  Painter painter{.name = "files",
                  .renderer = command.depth->string() + ", " + command.ids->string(),
                  .drawing = read_drawing(*command.depth, *command.ids)};
  if (painter.drawing.id.extent() == view.extent()) return painter;
  const auto text = [](Extent e) {
    return std::to_string(e.width) + " x " + std::to_string(e.height);
  };
  throw IoError(command.ids->string() + ": must be of the size of the view, " +
                text(view.extent()) + ", got " + text(painter.drawing.id.extent()));
}

std::optional<DrawingTolerance> tolerance_of(const DrawCommand& command, const Painter& reference,
                                             const Painter& candidate) {
  if (reference.is_exact && candidate.is_exact) return {};
  if (command.tolerance) return command.tolerance;
  return driver_tolerance(std::min(reference.subpixel_bits, candidate.subpixel_bits));
}

/// "view-03-cpu_scalar.png"
std::string picture_name(std::size_t view, const std::string& candidate) {
  std::string name = candidate;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  const std::string number = std::to_string(view);
  return "view-" + std::string(number.size() < 2 ? "0" : "") + number + "-" + name + ".png";
}

/// Judges one view, prints it and keeps its figures.
void judge_view(const DrawCommand& command, const Drawn& drawn, std::size_t view,
                const Framebuffer& reference, Judged& judged, std::ostream& out) {
  Framebuffer candidate;
  judged.painter.draw(drawn.views[view], drawn.items, candidate);
  const DrawingVerdict verdict = judge_drawing(drawn.views[view], drawn.items, reference, candidate,
                                               judged.tolerance.value_or(DrawingTolerance{}));
  judged.total += verdict.counts;
  Json json = json_of(verdict.counts);
  if (verdict.first) json["first"] = json_of(*verdict.first);
  if (verdict.first_unexplained) json["first_unexplained"] = json_of(*verdict.first_unexplained);
  judged.views.push_back(std::move(json));
  if (verdict.identical()) return;

  out << "view " << view << ", " << judged.painter.name << ": " << text_of(verdict.counts) << '\n'
      << "  first: " << text_of(*verdict.first);
  if (verdict.first_unexplained && verdict.first_unexplained->pixel != verdict.first->pixel) {
    out << "  first unexplained: " << text_of(*verdict.first_unexplained);
  }
  if (!command.images) return;
  app::write_output([&] {
    write_rgb_png(*command.images / picture_name(view, judged.painter.name),
                  draw_differences(reference, verdict.causes));
  });
}

Json judged_json(const Judged& judged) {
  return {{"name", judged.painter.name},
          {"renderer", judged.painter.renderer},
          {"exact", judged.painter.is_exact},
          {"tolerance", judged.tolerance ? json_of(*judged.tolerance) : Json()},
          {"good", judged.is_good()},
          {"total", json_of(judged.total)},
          {"views", judged.views}};
}

void write_report(const std::filesystem::path& path, const DrawCommand& command, const Drawn& drawn,
                  const Painter& reference, const std::vector<Judged>& candidates) {
  Json json{
      {"inputs", Json::array()},
      {"reference",
       {{"name", reference.name}, {"renderer", reference.renderer}, {"exact", reference.is_exact}}},
      {"views", Json::array()},
      {"candidates", Json::array()}};
  for (const auto& input : command.inputs)
    json["inputs"].push_back(input.string());
  for (const View& view : drawn.views) {
    json["views"].push_back(
        {{"camera", json_of(view.camera())},
         {"extent", {{"width", view.extent().width}, {"height", view.extent().height}}}});
  }
  for (const Judged& judged : candidates)
    json["candidates"].push_back(judged_json(judged));
  write_json(path, json);
}

void print_total(std::ostream& out, const Judged& judged, const Painter& reference) {
  out << judged.painter.name << " (" << judged.painter.renderer << ") against " << reference.name
      << " (" << reference.renderer << "), ";
  if (judged.tolerance) {
    out << "tolerance: edges " << judged.tolerance->edge << "/256 px, depth "
        << judged.tolerance->depth << " units and " << judged.tolerance->slope
        << "/256 px of slope: ";
  } else {
    out << "exact: ";
  }
  out << judged.views.size() << (judged.views.size() == 1 ? " view, " : " views, ")
      << text_of(judged.total) << '\n';
}

}  // namespace

bool run_draw_command(const DrawCommand& command, std::ostream& out, const Progress& progress) {
  check_options(command);
  const std::vector<Brush> brushes = brushes_of(command);
  const Painter reference = make_painter(brushes.front());
  std::vector<Painter> painters;
  for (std::size_t i = 1; i < brushes.size(); ++i)
    painters.push_back(make_painter(brushes[i]));
  const Scene scene = read_scene(command.inputs, progress).scene;
  const Drawn drawn = prepare(command, scene);
  if (command.depth) painters.push_back(read_painter(command, drawn.views.front()));

  std::vector<Judged> candidates;
  for (Painter& painter : painters) {
    const auto tolerance = tolerance_of(command, reference, painter);
    candidates.push_back({.painter = std::move(painter), .tolerance = tolerance});
  }
  Framebuffer expected;
  for (std::size_t view = 0; view < drawn.views.size(); ++view) {
    progress.check_stop();
    reference.draw(drawn.views[view], drawn.items, expected);
    for (Judged& judged : candidates)
      judge_view(command, drawn, view, expected, judged, out);
  }
  for (const Judged& judged : candidates)
    print_total(out, judged, reference);
  if (command.json) write_report(*command.json, command, drawn, reference, candidates);
  return std::all_of(candidates.begin(), candidates.end(),
                     [](const Judged& judged) { return judged.is_good(); });
}

}  // namespace rangezip::compare
