#pragma once

#include <string>

namespace rangezip {

/// A library that is opened at run time and stays loaded to the end of the process: drivers keep
/// threads and thread-local state.
class SharedLibrary {
 public:
  /// @throws BackendError if it cannot be opened
  explicit SharedLibrary(std::string name);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// Sets `function` to the function `function_name`. @throws BackendError if there is none
  template <class Function>
  void find(const char* function_name, Function& function) const {
    function = reinterpret_cast<Function>(address_of(function_name));
  }

 private:
  [[nodiscard]] void* address_of(const char* function_name) const;

  std::string name_;
  void* handle_ = nullptr;
};

}  // namespace rangezip
