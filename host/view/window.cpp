// By GLFW 3 and OpenGL 1.1: what every desktop has, with or without a GPU of its own.
#include "window.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "failure.hpp"

namespace ppm::view {
namespace {

/// What GLFW has to say of its last call that failed.
std::string reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "for no reason that is known";
}

[[noreturn]] void refuse(const std::string& what) {
  throw Failure("", "view", what + " (" + reason() + ")",
                "set DISPLAY to a screen with OpenGL, or watch by render --preview or --display");
}

/// The functions of OpenGL that are used, of the context that is current.
struct Gl {
  decltype(&glDrawPixels) draw_pixels = nullptr;
  decltype(&glPixelStorei) pixel_store = nullptr;
  decltype(&glRasterPos2f) raster_position = nullptr;
  decltype(&glViewport) viewport = nullptr;
  decltype(&glDisable) disable = nullptr;

  void load() {
    get(draw_pixels, "glDrawPixels");
    get(pixel_store, "glPixelStorei");
    get(raster_position, "glRasterPos2f");
    get(viewport, "glViewport");
    get(disable, "glDisable");
  }

 private:
  template <class Function>
  static void get(Function& function, const char* name) {
    function = reinterpret_cast<Function>(glfwGetProcAddress(name));
    if (function == nullptr) refuse(std::string("its OpenGL has no ") + name);
  }
};

/// As Key::name; empty for keys that have none.
std::string key_name(int key, int scancode) {
  if (key == GLFW_KEY_ESCAPE) return "escape";
  if (key == GLFW_KEY_SPACE) return "space";
  const char* const name = glfwGetKeyName(key, scancode);
  std::string text = name != nullptr ? name : "";
  if (text.size() != 1) return {};
  text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

/// Largest of this shape that fits the screen beside its bars.
glm::uvec2 fitting(glm::uvec2 size) {
  GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return size;
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  const glm::dvec2 room(std::max(width, 1), std::max(height, 1)), shape(size);
  const double scale = std::min({1.0, room.x / shape.x, room.y / shape.y});
  return glm::max(glm::uvec2(scale * shape), glm::uvec2(1));
}

}  // namespace

Desktop::Desktop() {
  if (glfwInit() != GLFW_TRUE) refuse("there is no screen to open a window on");
}

Desktop::~Desktop() {
  glfwTerminate();
}

void Desktop::wake() {
  glfwPostEmptyEvent();
}

struct Window::Implementation {
  GLFWwindow* window = nullptr;
  Gl gl;
  std::vector<Event> events;
  bool stale = true;

  ~Implementation() {
    if (window != nullptr) glfwDestroyWindow(window);
  }

  static Implementation& of(GLFWwindow* window) {
    return *static_cast<Implementation*>(glfwGetWindowUserPointer(window));
  }

  glm::uvec2 frame() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    return {static_cast<unsigned>(std::max(width, 0)), static_cast<unsigned>(std::max(height, 0))};
  }

  /// From the window's coordinates, which may be coarser than pixels.
  glm::dvec2 in_frame(double x, double y) const {
    int width = 0, height = 0;
    glfwGetWindowSize(window, &width, &height);
    const glm::dvec2 size(std::max(width, 1), std::max(height, 1));
    return glm::dvec2(x, y) * glm::dvec2(frame()) / size;
  }

  glm::dvec2 cursor() const {
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window, &x, &y);
    return in_frame(x, y);
  }

  void listen() {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int modifiers) {
      constexpr int kCommands = GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;
      if (action == GLFW_RELEASE || (modifiers & kCommands) != 0) return;
      const std::string name = key_name(key, scancode);
      if (!name.empty()) of(w).events.push_back(KeyPress{name});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
      Implementation& self = of(w);
      if (action == GLFW_RELEASE) {
        self.events.push_back(ButtonRelease{self.cursor()});
      } else {
        const bool is_left = button == GLFW_MOUSE_BUTTON_LEFT;
        self.events.push_back(ButtonPress{is_left ? Button::left : Button::right, self.cursor(),
                                          (modifiers & GLFW_MOD_SHIFT) != 0});
      }
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
      of(w).events.push_back(MouseMove{of(w).in_frame(x, y)});
    });
    glfwSetScrollCallback(
        window, [](GLFWwindow* w, double, double up) { of(w).events.push_back(Scroll{up}); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).stale = true; });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).stale = true; });
  }
};

Window::Window(const Desktop& /*desktop*/, const std::string& title, glm::uvec2 size)
    : implementation_(std::make_unique<Implementation>()) {
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_ALPHA_BITS, 0);
  const glm::ivec2 shape(fitting(size));
  GLFWwindow* const window = glfwCreateWindow(shape.x, shape.y, title.c_str(), nullptr, nullptr);
  if (window == nullptr) refuse("no window can be opened");
  implementation_->window = window;
  glfwMakeContextCurrent(window);
  glfwSwapInterval(0);  // a hidden window would wait for ever, and pictures are few
  implementation_->gl.load();
  implementation_->gl.disable(GL_DITHER);
  implementation_->listen();
}

Window::~Window() = default;

std::vector<Event> Window::wait(double seconds) {
  glfwWaitEventsTimeout(seconds);
  return std::exchange(implementation_->events, {});
}

bool Window::closing() const {
  return glfwWindowShouldClose(implementation_->window) == GLFW_TRUE;
}

bool Window::stale() const {
  return implementation_->stale;
}

glm::uvec2 Window::frame() const {
  return implementation_->frame();
}

void Window::show(std::span<const std::uint8_t> rgb, glm::uvec2 frame) {
  const Gl& gl = implementation_->gl;
  const glm::ivec2 size(frame);
  gl.viewport(0, 0, size.x, size.y);
  gl.raster_position(-1.0f, -1.0f);
  gl.pixel_store(GL_UNPACK_ALIGNMENT, 1);
  gl.draw_pixels(size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
  glfwSwapBuffers(implementation_->window);
  implementation_->stale = false;
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(implementation_->window, title.c_str());
}

}  // namespace ppm::view
