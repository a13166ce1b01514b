#include "apps/rangezip-compare/stitch_report.h"

#include <fmt/format.h>

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace rangezip::compare {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kPercent = 100.0;

std::string_view text_of(bool holds) {
  return holds ? "holds" : "MISSED";
}

/// The parts of which the session had nothing: no verdict is claimed for them.
std::vector<std::string> parts_without_verdict(const StitchSummary& summary) {
  std::vector<std::string> parts;
  if (summary.samples.located == 0) parts.emplace_back("samples");
  if (summary.insertions.located == 0) parts.emplace_back("insertions");
  if (summary.segments.followed == 0) parts.emplace_back("segments");
  return parts;
}

std::string verdict_text(const StitchSummary& summary, const StitchLimits& limits) {
  const std::vector<std::string> missing = parts_without_verdict(summary);
  if (!summary.is_good(limits) || missing.empty()) {
    return fmt::format("verdict: {}", text_of(summary.is_good(limits)));
  }
  return fmt::format("verdict: {}; nothing to judge: {}",
                     missing.size() == 3 ? "of the meshes alone holds" : "holds",
                     fmt::join(missing, ", "));
}

std::string share_text(const LocationSummary& summary) {
  return summary.located == 0 ? "-" : fmt::format("{:.3f} %", kPercent * summary.acceptance());
}

std::string ratio_text(const SegmentSummary& summary) {
  return summary.followed == 0 ? "-" : fmt::format("{:.4f}", summary.ratio_p99);
}

void print_step(std::ostream& out, std::size_t number, const std::string& name,
                const StitchStep& step) {
  LocationSummary samples;
  LocationSummary insertions;
  SegmentSummary segments;
  if (step.stitch) {
    const std::span<const StitchVerdict> one(&*step.stitch, 1);
    samples = summarize_locations(one, &StitchVerdict::samples);
    insertions = summarize_locations(one, &StitchVerdict::insertions);
    segments = summarize_segments(one);
  }
  const std::string mesh =
      step.mesh.is_manifold ? fmt::format("{} crossing, {} degenerate",
                                          step.mesh.self_intersections, step.mesh.degenerate_faces)
                            : "NOT MANIFOLD";
  out << fmt::format("{:>7}  {:<7} {:>8} {:>10}  {:>8} {:>10}  {:>8} {:>8}  {}{}\n", number, name,
                     samples.located, share_text(samples), insertions.located,
                     share_text(insertions), segments.followed, ratio_text(segments), mesh,
                     step.is_repeatable ? "" : ", NOT REPEATABLE");
}

std::string limit_text(std::size_t judged, bool is_kept, std::string_view kind, double limit,
                       std::string_view unit) {
  return fmt::format("{} {:g}{}: {}", kind, limit, unit,
                     judged == 0 ? "nothing to judge" : text_of(is_kept));
}

std::string locations_text(const LocationSummary& summary) {
  return fmt::format(
      "{} of {} right, {} more close: {}; lost by the others: p95 {:.3g}, max {:.3g} pixel sides; "
      "{} on no face, {} of them wrongly",
      summary.agreeing, summary.located, summary.close, share_text(summary), summary.losses.p95,
      summary.losses.max, summary.unlocated, summary.missed);
}

std::string location_limit(const LocationSummary& summary, const StitchLimits& limits) {
  return limit_text(summary.located, summary.acceptance() >= limits.location, "at least",
                    kPercent * limits.location, " %");
}

void print_segments(std::ostream& out, const SegmentSummary& summary, const StitchLimits& limits) {
  out << fmt::format(
      "segments: {} inserted, {} followed, {} lost; length through their faces to the shortest "
      "path's: p99 {} ({}), max {:.4f}; apart by p95 {:.3g}, max {:.3g} pixel sides; of the "
      "lines in the image: p99 {:.4f}\n",
      summary.inserted, summary.followed, summary.lost, ratio_text(summary),
      limit_text(summary.followed, summary.ratio_p99 <= limits.length_ratio, "at most",
                 limits.length_ratio, ""),
      summary.ratio_max, summary.deviations.p95, summary.deviations.max, summary.line_ratio_p99);
}

Json json_of(const DistanceSummary& summary) {
  return {
      {"count", summary.count}, {"mean", summary.mean}, {"p95", summary.p95}, {"max", summary.max}};
}

/// null where there was nothing to judge.
Json figure_of(std::size_t judged, double figure) {
  return judged == 0 ? Json() : Json(figure);
}

Json json_of(const LocationSummary& summary) {
  return {{"unlocated", summary.unlocated},
          {"missed", summary.missed},
          {"located", summary.located},
          {"agreeing", summary.agreeing},
          {"close", summary.close},
          {"acceptance", figure_of(summary.located, summary.acceptance())},
          {"losses", json_of(summary.losses)}};
}

Json json_of(const SegmentSummary& summary) {
  return {{"inserted", summary.inserted},
          {"followed", summary.followed},
          {"lost", summary.lost},
          {"ratio_p99", figure_of(summary.followed, summary.ratio_p99)},
          {"ratio_max", figure_of(summary.followed, summary.ratio_max)},
          {"line_ratio_p99", figure_of(summary.followed, summary.line_ratio_p99)},
          {"deviations", json_of(summary.deviations)}};
}

/// The places that do not agree, close ones too, one by one.
Json wrong_places(const LocationVerdict& verdict, const StitchVerdict& stitch) {
  Json places = Json::array();
  for (const WrongFace& wrong : verdict.wrong) {
    places.push_back({{"place", wrong.point},
                      {"face", wrong.given},
                      {"nearest", wrong.nearest},
                      {"loss", wrong.loss / stitch.pixel_size},
                      {"close", wrong.loss <= stitch.slack}});
  }
  return places;
}

Json json_of(const StitchVerdict& stitch) {
  const std::span<const StitchVerdict> one(&stitch, 1);
  Json json{{"pixel_size", stitch.pixel_size},
            {"samples", json_of(summarize_locations(one, &StitchVerdict::samples))},
            {"insertions", json_of(summarize_locations(one, &StitchVerdict::insertions))},
            {"insertions_nearest", json_of(summarize_locations(one, &StitchVerdict::nearest))},
            {"segments", json_of(summarize_segments(one))}};
  json["samples"]["wrong"] = wrong_places(stitch.samples, stitch);
  json["insertions"]["wrong"] = wrong_places(stitch.insertions, stitch);
  return json;
}

Json json_of(const std::string& name, const StitchStep& step) {
  Json json{{"command", name},
            {"manifold", step.mesh.is_manifold},
            {"self_intersections", step.mesh.self_intersections},
            {"degenerate_faces", step.mesh.degenerate_faces}};
  if (!step.stitch) return json;
  json["repeatable"] = step.is_repeatable;
  json["new_self_intersections"] = step.new_crossings;
  json["stitch"] = json_of(*step.stitch);
  return json;
}

}  // namespace

void print_stitches(std::ostream& out, std::span<const std::string> commands,
                    std::span<const StitchStep> steps, const StitchLimits& limits) {
  out << "command            samples       good  inserted       good  segments  p99  mesh\n";
  for (std::size_t i = 0; i < steps.size(); ++i)
    print_step(out, i, commands[i], steps[i]);
  const StitchSummary summary = summarize_session(steps);
  out << fmt::format("samples, nearest face: {} ({})\n", locations_text(summary.samples),
                     location_limit(summary.samples, limits));
  out << fmt::format("inserted vertices, face in sight: {} ({})\n",
                     locations_text(summary.insertions),
                     location_limit(summary.insertions, limits));
  out << fmt::format("inserted vertices, nearest face: {} ({})\n", locations_text(summary.nearest),
                     location_limit(summary.nearest, limits));
  print_segments(out, summary.segments, limits);
  out << fmt::format(
      "meshes: {} not manifold and oriented, {} faults after a finish, {} self-intersections made "
      "by stitches, {} stitches not repeatable\n{}\n",
      summary.not_manifold, summary.finished_faults, summary.new_crossings, summary.not_repeatable,
      verdict_text(summary, limits));
}

Json json_of(std::span<const std::string> commands, std::span<const StitchStep> steps,
             const StitchLimits& limits) {
  const StitchSummary summary = summarize_session(steps);
  Json json{{"good", summary.is_good(limits)},
            {"nothing_to_judge", parts_without_verdict(summary)},
            {"limits", {{"location", limits.location}, {"length_ratio_p99", limits.length_ratio}}},
            {"stitches", summary.stitches},
            {"samples", json_of(summary.samples)},
            {"insertions", json_of(summary.insertions)},
            {"insertions_nearest", json_of(summary.nearest)},
            {"segments", json_of(summary.segments)},
            {"not_manifold", summary.not_manifold},
            {"finished_faults", summary.finished_faults},
            {"new_self_intersections", summary.new_crossings},
            {"not_repeatable", summary.not_repeatable},
            {"commands", Json::array()}};
  for (std::size_t i = 0; i < steps.size(); ++i)
    json["commands"].push_back(json_of(commands[i], steps[i]));
  return json;
}

}  // namespace rangezip::compare
