// In place of window.cpp where the program is built without GLFW.
#include "failure.hpp"
#include "window.hpp"

namespace ppm::view {

Desktop::Desktop() {
  throw Failure("", "view", "this program was built without windows",
                "install GLFW 3 (Debian: libglfw3-dev) and build it again");
}
Desktop::~Desktop() = default;
void Desktop::wake() {}

struct Window::Implementation {};

Window::Window(const Desktop&, const std::string&, glm::uvec2) {}
Window::~Window() = default;
std::vector<Event> Window::wait(double) {
  return {};
}
bool Window::closing() const {
  return true;
}
bool Window::stale() const {
  return false;
}
glm::uvec2 Window::frame() const {
  return glm::uvec2(0);
}
void Window::show(std::span<const std::uint8_t>, glm::uvec2) {}
void Window::set_title(const std::string&) {}

}  // namespace ppm::view
