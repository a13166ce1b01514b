#include "raster_gl/borrowed_context.h"

#include <optional>
#include <utility>

#include "core/base/error.h"

namespace rangezip {

namespace {

/// Leaves no context of the application current for the life of this object.
class SetAside {
 public:
  explicit SetAside(const ContextSwitch& contexts)
      : contexts_(contexts), before_(contexts.current()) {
    contexts_.make_current(nullptr);
  }
  ~SetAside() { contexts_.make_current(before_); }
  SetAside(const SetAside&) = delete;
  SetAside& operator=(const SetAside&) = delete;

 private:
  const ContextSwitch& contexts_;
  void* before_;
};

void check_given(bool is_given, const char* function, const char* what) {
  if (is_given) return;
  throw InvalidArgument(std::string(function) + ": " + what + " must be given");
}

void check_given(const ContextSwitch& contexts, const char* function) {
  check_given(contexts.current != nullptr, function, "contexts.current");
  check_given(contexts.make_current != nullptr, function, "contexts.make_current");
}

class ContextOfApplication final : public GlContext {
 public:
  explicit ContextOfApplication(BorrowedContext borrowed) : borrowed_(std::move(borrowed)) {}

  [[nodiscard]] std::string name() const override { return borrowed_.name; }
  [[nodiscard]] Function function(const char* name) const override {
    return borrowed_.function(name);
  }

 private:
  void make_current() override {
    const ContextSwitch& contexts = borrowed_.contexts;
    aside_.emplace(contexts);
    contexts.make_current(borrowed_.context);
    if (contexts.current() == borrowed_.context) return;
    aside_.reset();
    throw BackendError("context " + borrowed_.name +
                       ": cannot be made current; it may be so on another thread, or be gone");
  }
  void release() noexcept override {
    borrowed_.contexts.make_current(nullptr);
    aside_.reset();
  }

  BorrowedContext borrowed_;
  std::optional<SetAside> aside_;
};

class ContextBesideApplication final : public GlContext {
 public:
  ContextBesideApplication(std::unique_ptr<GlContext> context, ContextSwitch contexts)
      : context_(std::move(context)), contexts_(std::move(contexts)) {}

  [[nodiscard]] std::string name() const override { return context_->name(); }
  [[nodiscard]] Function function(const char* name) const override {
    return context_->function(name);
  }

 private:
  void make_current() override {
    aside_.emplace(contexts_);
    try {
      current_.emplace(*context_);
    } catch (const BackendError&) {
      aside_.reset();
      throw;
    }
  }
  void release() noexcept override {
    current_.reset();
    aside_.reset();
  }

  std::unique_ptr<GlContext> context_;
  ContextSwitch contexts_;
  std::optional<SetAside> aside_;
  std::optional<CurrentContext> current_;
};

}  // namespace

std::unique_ptr<GlContext> borrow_context(BorrowedContext borrowed) {
  constexpr const char* kName = "borrow_context";
  check_given(borrowed.context != nullptr, kName, "context");
  check_given(borrowed.contexts, kName);
  check_given(borrowed.function != nullptr, kName, "function");
  return std::make_unique<ContextOfApplication>(std::move(borrowed));
}

std::unique_ptr<GlContext> beside_application(std::unique_ptr<GlContext> context,
                                              ContextSwitch contexts) {
  constexpr const char* kName = "beside_application";
  check_given(context != nullptr, kName, "context");
  check_given(contexts, kName);
  return std::make_unique<ContextBesideApplication>(std::move(context), std::move(contexts));
}

}  // namespace rangezip
