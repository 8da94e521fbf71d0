#include "saved_state.hpp"

#include "failure.hpp"

namespace ppm::render {

void refuse_state(const char* why) {
  throw Failure("", "saved state", why, "resume with the scene and options it was saved with");
}

}  // namespace ppm::render
