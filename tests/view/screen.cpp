#include "screen.hpp"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace ppm::test {
namespace {

constexpr int kStartMilliseconds = 60000;
constexpr int kSteps = 4;  // of a drag

/// Windows come and go between a question and its answer.
int ignore(Display* /*display*/, XErrorEvent* /*error*/) {
  return 0;
}

}  // namespace

void pause_a_little() {
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

struct Screen::Connection {
  explicit Connection(Display* to) : display(to) {}
  ~Connection() { XCloseDisplay(display); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Display* display;
  Window window = 0;

  Atom atom(const char* name) const { return XInternAtom(display, name, False); }

  std::string title_of(Window of) const {
    XTextProperty property{};
    if (XGetTextProperty(display, of, &property, atom("_NET_WM_NAME")) == 0) return {};
    std::string text(reinterpret_cast<const char*>(property.value), property.nitems);
    XFree(property.value);
    return text;
  }

  bool is_shown(Window of) const {
    XWindowAttributes attributes{};
    return XGetWindowAttributes(display, of, &attributes) != 0 &&
           attributes.map_state == IsViewable;
  }

  /// A child of the root with a title; 0: none.
  Window find() const {
    Window root = 0, parent = 0, *children = nullptr, found = 0;
    unsigned count = 0;
    if (XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count) == 0) {
      return 0;
    }
    for (unsigned i = 0; i < count; ++i) {
      if (is_shown(children[i]) && !title_of(children[i]).empty()) found = children[i];
    }
    if (children != nullptr) XFree(children);
    return found;
  }
};

void Screen::start_server() {
  int channel[2];
  if (pipe2(channel, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const std::string descriptor = std::to_string(channel[1]);
  server_ = fork();
  if (server_ < 0) throw std::runtime_error("no fork");
  if (server_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    fcntl(channel[1], F_SETFD, 0);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execl(PPM_XVFB, PPM_XVFB, "-displayfd", descriptor.c_str(), "-screen", "0", "800x600x24",
          "-nolisten", "tcp", nullptr);
    _exit(127);
  }
  ::close(channel[1]);
  std::string text;
  char character = 0;
  pollfd stream{channel[0], POLLIN, 0};
  while (poll(&stream, 1, kStartMilliseconds) > 0 && read(channel[0], &character, 1) == 1 &&
         character != '\n') {
    text += character;
  }
  ::close(channel[0]);
  if (text.empty()) throw std::runtime_error("Xvfb does not start");
  number_ = std::stoi(text);
}

Screen::Screen() {
  XSetErrorHandler(ignore);
  start_server();
  Display* const display = XOpenDisplay(this->display().c_str());
  if (display == nullptr) throw std::runtime_error("Xvfb does not answer");
  connection_ = std::make_unique<Connection>(display);
}

Screen::~Screen() {
  connection_.reset();
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

std::string Screen::display() const {
  return ":" + std::to_string(number_);
}

bool Screen::find_window() {
  connection_->window = 0;
  const bool found = eventually([&] { return (connection_->window = connection_->find()) != 0; });
  if (found) move({1, 1});
  return found;
}

std::string Screen::title() {
  return connection_->title_of(connection_->window);
}

bool Screen::wait_for_title(std::string_view part) {
  return eventually([&] { return title().find(part) != std::string::npos; });
}

Shot Screen::shot() {
  Shot shot;
  XWindowAttributes attributes{};
  if (XGetWindowAttributes(connection_->display, connection_->window, &attributes) == 0) return {};
  shot.width = static_cast<unsigned>(attributes.width);
  shot.height = static_cast<unsigned>(attributes.height);
  XImage* const image = XGetImage(connection_->display, connection_->window, 0, 0, shot.width,
                                  shot.height, AllPlanes, ZPixmap);
  if (image == nullptr) return {};
  for (int y = 0; y < attributes.height; ++y) {
    for (int x = 0; x < attributes.width; ++x) {
      const unsigned long pixel = XGetPixel(image, x, y);  // 24 bits, red on top
      for (const int shift : {16, 8, 0}) {
        shot.rgb.push_back(static_cast<std::uint8_t>(pixel >> shift & 255u));
      }
    }
  }
  XDestroyImage(image);
  return shot;
}

void Screen::key(const char* keysym) {
  Display* const display = connection_->display;
  const KeyCode code = XKeysymToKeycode(display, XStringToKeysym(keysym));
  XTestFakeKeyEvent(display, code, True, CurrentTime);
  XTestFakeKeyEvent(display, code, False, CurrentTime);
  XSync(display, False);
}

void Screen::move(glm::ivec2 to) {
  Display* const display = connection_->display;
  int x = 0, y = 0;
  Window child = 0;
  XTranslateCoordinates(display, connection_->window, DefaultRootWindow(display), to.x, to.y, &x,
                        &y, &child);
  XTestFakeMotionEvent(display, -1, x, y, CurrentTime);
  XSync(display, False);
}

void Screen::press(unsigned button) {
  XTestFakeButtonEvent(connection_->display, button, True, CurrentTime);
  XSync(connection_->display, False);
}

void Screen::release(unsigned button) {
  XTestFakeButtonEvent(connection_->display, button, False, CurrentTime);
  XSync(connection_->display, False);
}

void Screen::drag(unsigned button, glm::ivec2 from, glm::ivec2 to) {
  move(from);
  press(button);
  for (int step = 1; step <= kSteps; ++step) move(from + (to - from) * step / kSteps);
  release(button);
}

void Screen::click(glm::ivec2 at) {
  move(at);
  press(1);
  release(1);
}

void Screen::resize(unsigned width, unsigned height) {
  XResizeWindow(connection_->display, connection_->window, width, height);
  XSync(connection_->display, False);
}

void Screen::close() {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = connection_->window;
  event.xclient.message_type = connection_->atom("WM_PROTOCOLS");
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(connection_->atom("WM_DELETE_WINDOW"));
  event.xclient.data.l[1] = CurrentTime;
  XSendEvent(connection_->display, connection_->window, False, NoEventMask, &event);
  XSync(connection_->display, False);
}

}  // namespace ppm::test
