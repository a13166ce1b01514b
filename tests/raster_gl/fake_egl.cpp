// A libEGL with one fault, which the environment variable RANGEZIP_FAKE_EGL names: what machines
// without a driver, or with an old one, do.

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdlib>
#include <cstring>

namespace {

bool has_fault(const char* name) {
  const char* const fault = std::getenv("RANGEZIP_FAKE_EGL");
  return fault != nullptr && std::strcmp(fault, name) == 0;
}

/// Something to point at.
int object = 0;

EGLBoolean query_devices(EGLint capacity, EGLDeviceEXT* devices, EGLint* count) {
  *count = has_fault("no device") ? 0 : 1;
  if (capacity > 0 && *count > 0) *devices = &object;
  return EGL_TRUE;
}

EGLDisplay get_platform_display(EGLenum /*platform*/, void* /*native*/, const EGLint* /*list*/) {
  return has_fault("no display") ? EGL_NO_DISPLAY : &object;
}

template <class Function>
__eglMustCastToProperFunctionPointerType address_of(Function* function) {
  return reinterpret_cast<__eglMustCastToProperFunctionPointerType>(function);
}

}  // namespace

extern "C" {

EGLBoolean eglBindAPI(EGLenum /*api*/) {
  return EGL_TRUE;
}
EGLContext eglCreateContext(EGLDisplay /*display*/, EGLConfig /*config*/, EGLContext /*share*/,
                            const EGLint* /*attributes*/) {
  return has_fault("old OpenGL") ? EGL_NO_CONTEXT : &object;
}
EGLBoolean eglDestroyContext(EGLDisplay /*display*/, EGLContext /*context*/) {
  return EGL_TRUE;
}
EGLint eglGetError() {
  return EGL_BAD_MATCH;
}
__eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
  if (std::strcmp(name, "eglQueryDevicesEXT") == 0) return address_of(&query_devices);
  if (std::strcmp(name, "eglGetPlatformDisplayEXT") == 0) return address_of(&get_platform_display);
  return nullptr;
}
EGLBoolean eglInitialize(EGLDisplay /*display*/, EGLint* /*major*/, EGLint* /*minor*/) {
  return has_fault("display does not start") ? EGL_FALSE : EGL_TRUE;
}
EGLBoolean eglMakeCurrent(EGLDisplay /*display*/, EGLSurface /*draw*/, EGLSurface /*read*/,
                          EGLContext /*context*/) {
  return has_fault("not current") ? EGL_FALSE : EGL_TRUE;
}
const char* eglQueryString(EGLDisplay display, EGLint /*name*/) {
  if (display == EGL_NO_DISPLAY) {
    if (has_fault("no platforms")) return nullptr;
    // NVIDIA's driver names the older extension only, of which enumeration is a part.
    if (has_fault("older name")) return "EGL_EXT_device_base EGL_EXT_platform_device";
    return "EGL_EXT_device_enumeration EGL_EXT_platform_device EGL_MESA_platform_surfaceless";
  }
  return has_fault("needs surfaces") ? "EGL_KHR_no_config_context"
                                     : "EGL_KHR_no_config_context EGL_KHR_surfaceless_context";
}
}
