// The picture so far in a viewer, for whoever looks on.
#pragma once

#include <optional>
#include <string>

#include "integrator.hpp"
#include "log.hpp"
#include "tev.hpp"

namespace ppm::render {

class LiveDisplay {
 public:
  /// No address: nothing is ever shown. `title`: what the viewer calls the picture.
  LiveDisplay(const std::optional<display::TevAddress>& address, const std::string& title,
              Log& log);

  /// Whether the viewer has taken the picture before, and that was a second ago, or nine times as
  /// long as making it took.
  bool due();
  /// Shows the picture so far, which took so many seconds to make.
  void show(const Picture& picture, double seconds);
  /// The picture at the end; waits a few seconds for the viewer.
  void last(const Picture& picture);

 private:
  void warn();

  std::optional<display::TevViewer> viewer_;
  std::string place_;
  Log& log_;
  double next_ = 0.0;  // reading of the clock
};

}  // namespace ppm::render
