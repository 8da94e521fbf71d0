// Whole renderings, small ones, into a folder that holds the files of an earlier one: as the
// program makes them, with checkpoint, preview and layers.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "device.hpp"
#include "driver.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {

class RenderingRig {
 public:
  RenderingRig();

  /// Makes this the method, the files that it finds, and those that it must end with.
  void take(gpu::Device& device, std::string_view method);
  /// From now on renderings go on from the checkpoint that they find, instead of beginning.
  void resume_from_now_on() { resumes_ = true; }

  /// Puts the files of before back and renders. Returns the message of the Failure that ended it;
  /// nothing: it was completed.
  std::optional<std::string> render(gpu::Device& device);

  /// Every file is as it was, or as it is to be in the end; the checkpoint, if there is one, is
  /// sound; nothing else is there. `complete`: all are as they are to be.
  void expect_whole_files(bool complete) const;

  /// Warnings of the last rendering.
  const std::vector<std::string>& warnings() const { return log_.warnings(); }

  /// The checkpoint, if there is one, leads to the files that are to be.
  void expect_resumable(gpu::Device& device);

 private:
  using Bytes = std::string;

  void run(gpu::Device& device, std::uint64_t passes, bool resumes, bool with_layers = true);
  Bytes text(const char* name) const { return file_text(folder_ / name); }

  TemporaryFolder folder_;
  scene::Scene scene_;
  render::Settings settings_;
  render::Interruption interruption_;
  Log log_{Verbosity::quiet};
  bool resumes_ = false;
  Bytes old_picture_, old_checkpoint_, old_preview_;
  Bytes whole_picture_, bare_picture_;  ///< bare: without its layers
  std::set<Bytes> previews_;            ///< after any number of passes
};

/// One line that names the call and its result, and then says what would mend it.
::testing::AssertionResult is_clear(const std::string& message, const std::string& call,
                                    const std::string& result);

}  // namespace ppm::test
