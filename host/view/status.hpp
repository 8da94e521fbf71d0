// What the viewer says: its window's title and the lines that it prints.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "image.hpp"
#include "mailbox.hpp"

namespace ppm::view {

/// What the title tells beside the frame.
struct Status {
  std::string scene, method;            ///< names
  std::optional<std::uint64_t> passes;  ///< after which it rests
  bool paused = false;
  image::Encoding encoding;
};

/// "1 pass", "2 passes".
std::string passes_text(std::uint64_t passes);

/// "lamp.glb: ppm, 12 passes, 2.4 M photons, exposure +0.5". `frame`: nothing where none of the
/// present camera has come yet.
std::string title_text(const Status& status, const Frame* frame);

/// Of a pixel: L of the picture; then L, R, N and tau of its hit point, where the method has any:
/// tau = pi R^2 L N_emitted [HOJ08 Eq. 13].
std::string reading_line(const Reading& reading, std::uint64_t passes, std::uint64_t emitted);

}  // namespace ppm::view
