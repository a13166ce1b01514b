#include "core/session/session.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace rangezip {

namespace {

std::size_t bytes_of(const TriangleMesh& mesh) {
  return mesh.positions.size() * sizeof(Vec3) + mesh.triangles.size() * sizeof(Triangle) +
         mesh.sources.size() * sizeof(VertexSource);
}

}  // namespace

struct Session::Impl {
  using MeshPointer = std::shared_ptr<const TriangleMesh>;

  Scene scene;
  SessionOptions options;
  std::vector<Command> commands;    // done, and then those that can be redone
  std::vector<MeshPointer> meshes;  // before all, and after each command; null: dropped
  std::size_t current = 0;          // index into meshes = number of commands done
  VoteCache votes;
  std::shared_ptr<const Scan> last_scan;

  /// Drops the kept meshes that are farthest from `current` until the rest fits the budget.
  void enforce_budget() {
    std::size_t total = 0;
    for (const MeshPointer& mesh : meshes)
      total += mesh ? bytes_of(*mesh) : 0;
    while (total > options.history_bytes) {
      const std::size_t farthest = farthest_kept();
      if (farthest == current) return;
      total -= bytes_of(*meshes[farthest]);
      meshes[farthest].reset();
    }
  }

  /// Never 0, which every replay may start from; `current` if nothing else is kept.
  [[nodiscard]] std::size_t farthest_kept() const {
    std::size_t farthest = current;
    std::size_t longest = 0;
    for (std::size_t i = 1; i < meshes.size(); ++i) {
      const std::size_t distance = i < current ? current - i : i - current;
      if (meshes[i] && distance > longest) {
        longest = distance;
        farthest = i;
      }
    }
    return farthest;
  }

  /// Makes `target` current, replaying from the nearest kept mesh before it if its own was dropped.
  void go_to(std::size_t target, Rasterizer& rasterizer, const Progress& progress) {
    std::size_t at = target;
    while (!meshes[at])
      --at;
    std::vector<MeshPointer> replayed;
    MeshPointer mesh = meshes[at];
    for (std::size_t i = at; i < target; ++i) {
      mesh = std::make_shared<const TriangleMesh>(
          run_command(commands[i], scene, *mesh, votes, rasterizer, progress).mesh);
      replayed.push_back(mesh);
    }
    std::move(replayed.begin(), replayed.end(),
              meshes.begin() + static_cast<std::ptrdiff_t>(at + 1));
    current = target;
    last_scan.reset();
    enforce_budget();
  }
};

Session::Session(Scene scene, const SessionOptions& options)
    : Session(std::move(scene), TriangleMesh{}, options) {}

Session::Session(Scene scene, TriangleMesh initial, const SessionOptions& options)
    : impl_(std::make_unique<Impl>()) {
  impl_->scene = std::move(scene);
  impl_->options = options;
  impl_->meshes.push_back(std::make_shared<const TriangleMesh>(std::move(initial)));
}

Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

const Scene& Session::scene() const noexcept {
  return impl_->scene;
}

std::shared_ptr<const TriangleMesh> Session::mesh() const noexcept {
  return impl_->meshes[impl_->current];
}

std::span<const Command> Session::history() const noexcept {
  return std::span(impl_->commands).first(impl_->current);
}

const VisibilityVotes& Session::votes(Rasterizer& rasterizer, const VoteOptions& options,
                                      const Progress& progress) {
  return impl_->votes.votes(rasterizer, impl_->scene, options, progress);
}

std::shared_ptr<const Scan> Session::last_scan() const noexcept {
  return impl_->last_scan;
}

CommandReport Session::apply(const Command& command, Rasterizer& rasterizer,
                             const Progress& progress) {
  if (const auto* undo_steps = std::get_if<UndoSteps>(&command)) {
    const auto done = impl_->current;
    if (undo_steps->count < 1 || static_cast<std::size_t>(undo_steps->count) > done) {
      throw InvalidArgument("Session::apply: UndoSteps::count must lie in [1, commands done = " +
                            std::to_string(done) + "], got " + std::to_string(undo_steps->count));
    }
    impl_->go_to(done - static_cast<std::size_t>(undo_steps->count), rasterizer, progress);
    return {};
  }

  CommandResult result =
      run_command(command, impl_->scene, *mesh(), impl_->votes, rasterizer, progress);
  auto mesh_after = std::make_shared<const TriangleMesh>(std::move(result.mesh));
  auto scan = result.scan ? std::make_shared<const Scan>(std::move(*result.scan)) : nullptr;
  std::vector<Command> commands(history().begin(), history().end());
  commands.push_back(command);
  std::vector<Impl::MeshPointer> meshes(
      impl_->meshes.begin(),
      impl_->meshes.begin() + static_cast<std::ptrdiff_t>(impl_->current) + 1);
  meshes.push_back(std::move(mesh_after));

  // From here on nothing throws.
  impl_->commands = std::move(commands);
  impl_->meshes = std::move(meshes);
  impl_->last_scan = std::move(scan);
  ++impl_->current;
  impl_->enforce_budget();
  return result.report;
}

bool Session::undo(Rasterizer& rasterizer, const Progress& progress) {
  if (impl_->current == 0) return false;
  impl_->go_to(impl_->current - 1, rasterizer, progress);
  return true;
}

bool Session::redo(Rasterizer& rasterizer, const Progress& progress) {
  if (impl_->current == impl_->commands.size()) return false;
  impl_->go_to(impl_->current + 1, rasterizer, progress);
  return true;
}

}  // namespace rangezip
