#include "compare/stitch_summary.h"

#include <limits>
#include <vector>

namespace rangezip::compare {

LocationSummary summarize_locations(std::span<const StitchVerdict> stitches,
                                    LocationVerdict StitchVerdict::*which) {
  LocationSummary summary;
  std::vector<double> losses;
  for (const StitchVerdict& stitch : stitches) {
    const LocationVerdict& verdict = stitch.*which;
    summary.unlocated += verdict.unlocated;
    summary.missed += verdict.missed;
    summary.located += verdict.points - verdict.unlocated;
    summary.agreeing += verdict.agreeing;
    summary.close += verdict.close;
    for (const WrongFace& wrong : verdict.wrong)
      losses.push_back(wrong.loss / stitch.pixel_size);
  }
  summary.losses = summarize(losses);
  return summary;
}

SegmentSummary summarize_segments(std::span<const StitchVerdict> stitches) {
  SegmentSummary summary;
  std::vector<double> ratios;
  std::vector<double> line_ratios;
  std::vector<double> deviations;
  for (const StitchVerdict& stitch : stitches) {
    const SegmentVerdict& verdict = stitch.segments;
    summary.inserted += verdict.inserted;
    summary.followed += verdict.followed;
    summary.lost += verdict.lost;
    ratios.insert(ratios.end(), verdict.ratios.begin(), verdict.ratios.end());
    ratios.insert(ratios.end(), verdict.lost, std::numeric_limits<double>::infinity());
    line_ratios.insert(line_ratios.end(), verdict.line_ratios.begin(), verdict.line_ratios.end());
    deviations.insert(deviations.end(), verdict.deviations.begin(), verdict.deviations.end());
  }

  summary.ratio_p99 = percentile(ratios, 99);
  summary.ratio_max = percentile(ratios, 100);
  summary.line_ratio_p99 = percentile(line_ratios, 99);
  summary.deviations = summarize(deviations);
  return summary;
}

StitchSummary summarize_session(std::span<const StitchStep> steps) {
  StitchSummary summary;
  std::vector<StitchVerdict> stitches;
  for (const StitchStep& step : steps) {
    if (!step.mesh.is_manifold) ++summary.not_manifold;
    if (step.is_finished) {
      summary.finished_faults += step.mesh.self_intersections + step.mesh.degenerate_faces;
    }
    summary.new_crossings += step.new_crossings;
    if (!step.is_repeatable) ++summary.not_repeatable;
    if (step.stitch) stitches.push_back(*step.stitch);
  }
  summary.stitches = stitches.size();
  summary.samples = summarize_locations(stitches, &StitchVerdict::samples);
  summary.insertions = summarize_locations(stitches, &StitchVerdict::insertions);
  summary.nearest = summarize_locations(stitches, &StitchVerdict::nearest);
  summary.segments = summarize_segments(stitches);
  return summary;
}

bool StitchSummary::is_good(const StitchLimits& limits) const {
  return samples.acceptance() >= limits.location && insertions.acceptance() >= limits.location &&
         nearest.acceptance() >= limits.location && segments.ratio_p99 <= limits.length_ratio &&
         not_repeatable == 0 && not_manifold == 0 && finished_faults == 0 && new_crossings == 0;
}

}  // namespace rangezip::compare
