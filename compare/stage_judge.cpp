#include "compare/stage_judge.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <type_traits>

#include "compare/checked_rasterizer.h"
#include "core/base/error.h"
#include "core/session/session.h"

namespace rangezip::compare {

namespace {

std::string text_of(Pixel pixel) {
  return "pixel (" + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + ")";
}

/// Compares element by element, by their bytes; elements that one side lacks differ.
template <class Values, class Place>
void compare_values(const Values& reference, const Values& candidate, const Place& place_of,
                    StageVerdict& verdict) {
  using Value = std::remove_cvref_t<decltype(reference[0])>;
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::size_t common = std::min(reference.size(), candidate.size());
  const std::size_t all = std::max(reference.size(), candidate.size());
  verdict.compared += all;
  for (std::size_t i = 0; i < all; ++i) {
    if (i < common && std::memcmp(&reference[i], &candidate[i], sizeof(Value)) == 0) continue;
    ++verdict.different;
    if (verdict.first.empty()) verdict.first = place_of(i);
  }
}

template <class T>
StageVerdict compare_grids(const char* name, const Grid<T>& reference, const Grid<T>& candidate) {
  StageVerdict verdict{.name = name};
  const auto width = static_cast<std::size_t>(std::max(1, reference.extent().width));
  compare_values(
      reference.pixels(), candidate.pixels(),
      [&](std::size_t i) {
        return text_of(Pixel{static_cast<int>(i % width), static_cast<int>(i / width)});
      },
      verdict);
  return verdict;
}

StageVerdict compare_meshes(const char* name, const TriangleMesh& reference,
                            const TriangleMesh& candidate) {
  StageVerdict verdict{.name = name};
  const auto number = [](const char* what) {
    return [what](std::size_t i) { return std::string(what) + " " + std::to_string(i); };
  };
  compare_values(reference.positions, candidate.positions, number("vertex"), verdict);
  compare_values(reference.triangles, candidate.triangles, number("face"), verdict);
  compare_values(reference.sources, candidate.sources, number("source of vertex"), verdict);
  return verdict;
}

/// Two parts of one stage.
StageVerdict together(StageVerdict first, const StageVerdict& second) {
  first.compared += second.compared;
  first.different += second.different;
  if (first.first.empty()) first.first = second.first;
  return first;
}

StageVerdict compare_framebuffers(const char* name, const Framebuffer& reference,
                                  const Framebuffer& candidate) {
  return together(compare_grids(name, reference.depth, candidate.depth),
                  compare_grids(name, reference.id, candidate.id));
}

StageVerdict compare_correspondences(const char* name, const Correspondence& reference,
                                     const Correspondence& candidate) {
  return together(compare_grids(name, reference.face, candidate.face),
                  compare_grids(name, reference.from_behind, candidate.from_behind));
}

StageVerdict compare_patches(const char* name, const Patch& reference, const Patch& candidate) {
  StageVerdict verdict = compare_meshes(name, reference.mesh, candidate.mesh);
  compare_values(
      reference.pixels, candidate.pixels,
      [](std::size_t i) { return "pixel of vertex " + std::to_string(i); }, verdict);
  return verdict;
}

StageVerdict verdict_on(const DrawingsRecord& record) {
  StageVerdict verdict{
      .name = "framebuffers", .compared = record.drawings, .different = record.different};
  if (!record.first) return verdict;
  const auto& [number, operation, pixels, first] = *record.first;
  verdict.first = "drawing " + std::to_string(number) + " (" + operation + "), " +
                  (first ? std::to_string(pixels) + " pixels, " + text_of(*first)
                         : std::string("the report of what was dropped"));
  return verdict;
}

void apply(Session& session, const Command& command, Rasterizer& rasterizer, std::size_t number,
           const Progress& progress) {
  try {
    session.apply(command, rasterizer, progress);
  } catch (const InvalidArgument& error) {
    throw InvalidArgument("/commands/" + std::to_string(number) + ": " + error.what());
  }
}

}  // namespace

bool CommandVerdict::identical() const noexcept {
  return std::all_of(stages.begin(), stages.end(), std::mem_fn(&StageVerdict::identical));
}

const StageVerdict& CommandVerdict::first_difference() const {
  return *std::find_if_not(stages.begin(), stages.end(), std::mem_fn(&StageVerdict::identical));
}

std::vector<StageVerdict> judge_scans(const Scan& reference, const Scan& candidate) {
  return {
      compare_framebuffers("scene framebuffer", reference.scene_buffer, candidate.scene_buffer),
      compare_grids("range image", reference.image.depth(), candidate.image.depth()),
      compare_grids("filled", reference.filled, candidate.filled),
      compare_grids("slopes", reference.slopes, candidate.slopes),
      compare_correspondences("correspondence", reference.correspondence, candidate.correspondence),
      compare_grids("mask", reference.active, candidate.active),
      compare_patches("patch", reference.patch, candidate.patch)};
}

StageVerdict judge_meshes(const TriangleMesh& reference, const TriangleMesh& candidate) {
  return compare_meshes("mesh", reference, candidate);
}

std::vector<CommandVerdict> judge_session(const Scene& scene, const TriangleMesh& initial,
                                          std::span<const Command> commands, Rasterizer& reference,
                                          Rasterizer& candidate, const Progress& progress) {
  CheckedRasterizer checked(reference, candidate);
  Session expected(scene, initial);
  Session found(scene, initial);
  std::vector<CommandVerdict> verdicts;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    apply(expected, commands[i], reference, i, progress);
    apply(found, commands[i], checked, i, progress);
    CommandVerdict& verdict = verdicts.emplace_back();
    verdict.stages.push_back(verdict_on(checked.take_record()));
    if (expected.last_scan() && found.last_scan()) {
      const auto of_scan = judge_scans(*expected.last_scan(), *found.last_scan());
      verdict.stages.insert(verdict.stages.end(), of_scan.begin(), of_scan.end());
    }
    verdict.stages.push_back(judge_meshes(*expected.mesh(), *found.mesh()));
    if (!verdict.identical()) break;
  }
  return verdicts;
}

}  // namespace rangezip::compare
