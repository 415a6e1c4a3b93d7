#include "gl/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace penumbra::gl {
namespace {

// A whole word of a list that is parted by blanks.
bool has_word(const char* list, std::string_view word) {
  if (!list) return false;
  std::string padded(1, ' '), wanted(1, ' ');
  padded.append(list) += ' ';
  wanted.append(word) += ' ';
  return padded.find(wanted) != std::string::npos;
}

struct Platform {
  EGLenum platform;
  void* native;
};

void add_devices(bool software, std::vector<Platform>& platforms) {
  std::array<EGLDeviceEXT, 32> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(devices.size(), devices.data(), &count)) return;
  for (EGLint i = 0; i < count; ++i) {
    const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
    if (has_word(extensions, "EGL_MESA_device_software") == software)
      platforms.push_back({EGL_PLATFORM_DEVICE_EXT, devices[i]});
  }
}

// What to try, the best first.
std::vector<Platform> platforms() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool devices =
      has_word(client, "EGL_EXT_platform_device") &&
      (has_word(client, "EGL_EXT_device_base") || has_word(client, "EGL_EXT_device_enumeration"));
  std::vector<Platform> found;
  if (devices) add_devices(false, found);
  if (has_word(client, "EGL_MESA_platform_surfaceless"))
    found.push_back({EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
  if (devices) add_devices(true, found);
  return found;
}

struct Api {
  EGLenum api;
  EGLint renderable;
  std::array<EGLint, 7> attributes;
};

constexpr Api core_api(EGLint minor) {
  return {EGL_OPENGL_API,
          EGL_OPENGL_BIT,
          {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, minor,
           EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE}};
}

std::vector<Api> apis(Profile profile) {
  if (profile == Profile::core) return {core_api(5)};
  return {{EGL_OPENGL_ES_API,
           EGL_OPENGL_ES3_BIT,
           {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE, 0, 0}},
          core_api(3)};
}

EGLContext current_context(EGLDisplay display, const Api& api) {
  const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, api.renderable, EGL_SURFACE_TYPE, 0,
                                     EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglBindAPI(api.api) || !eglChooseConfig(display, wanted.data(), &config, 1, &count) ||
      count == 0)
    return EGL_NO_CONTEXT;
  const EGLContext context =
      eglCreateContext(display, config, EGL_NO_CONTEXT, api.attributes.data());
  if (context == EGL_NO_CONTEXT) return context;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) return context;
  eglDestroyContext(display, context);
  return EGL_NO_CONTEXT;
}

bool draws_floats() {
  return !epoxy_is_desktop_gl()
             ? epoxy_gl_version() >= 32 || epoxy_has_gl_extension("GL_EXT_color_buffer_float")
             : true;
}

[[noreturn]] void refuse(Profile profile) {
  throw WorkError(std::string("there is no OpenGL driver that draws without a display (EGL, ") +
                      (profile == Profile::core ? "OpenGL 4.5)" : "OpenGL ES 3.0)"),
                  "install one (Mesa's: apt-get install libegl1 libgl1-mesa-dri) or leave out "
                  "--device gl");
}

}  // namespace

Context::Context(Profile profile) {
  ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // what fails is said here, in one line
  if (!epoxy_has_egl()) refuse(profile);
  for (const Platform& platform : platforms()) {
    display_ = eglGetPlatformDisplayEXT(platform.platform, platform.native, nullptr);
    if (!display_ || !eglInitialize(display_, nullptr, nullptr)) continue;
    for (const Api& api : apis(profile)) {
      context_ = current_context(display_, api);
      if (context_ == EGL_NO_CONTEXT) continue;
      if (draws_floats()) {
        renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        glGetIntegerv(GL_MAX_TEXTURE_SIZE, &longest_side_);
        return;
      }
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglDestroyContext(display_, context_);
    }
    eglTerminate(display_);
  }
  refuse(profile);
}

Context::~Context() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

}  // namespace penumbra::gl
