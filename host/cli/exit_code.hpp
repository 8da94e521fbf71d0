// What the program ends with.
#pragma once

namespace ppm::cli {

enum ExitCode : int {
  kDone = 0,
  kFailed = 1,        ///< the scene, a file or the device
  kWrongUsage = 2,    ///< nothing was begun
  kInterrupted = 130  ///< what there is has been saved
};

}  // namespace ppm::cli
