#include "raster_gl/shared_library.h"

#include <dlfcn.h>

#include <utility>

#include "core/base/error.h"

namespace rangezip {

SharedLibrary::SharedLibrary(std::string name)
    : name_(std::move(name)),
      handle_(dlopen(name_.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
  if (handle_ != nullptr) return;
  const char* const reason = dlerror();
  throw BackendError("cannot open " + name_ + ": " +
                     (reason != nullptr ? reason : "no reason given"));
}

void* SharedLibrary::address_of(const char* function_name) const {
  void* const address = dlsym(handle_, function_name);
  if (address == nullptr) throw BackendError(name_ + " has no function " + function_name);
  return address;
}

}  // namespace rangezip
