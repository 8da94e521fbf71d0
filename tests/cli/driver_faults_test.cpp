// A driver that fails in the middle of a rendering, as the test layer below the program makes it:
// one line, exit code 1, picture and checkpoint as they were, nothing left behind in the driver.
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>

#include "kept_rendering.hpp"
#include "layer_environment.hpp"

namespace ppm::test {
namespace {

struct DriverFault {
  const char* call;
  unsigned number;     ///< of the process's calls, from 1
  int result;          ///< VkResult; -4 lasts
  const char* naming;  ///< in the line that is printed
};
void PrintTo(const DriverFault& fault, std::ostream* stream) {
  *stream << fault.call << ' ' << fault.number << ' ' << fault.result;
}

// While the device is made, the scene uploaded, kernels made; then some way into the passes.
const DriverFault kFaults[] = {
    {"vkCreateDevice", 1, -4, "vkCreateDevice: VK_ERROR_DEVICE_LOST"},
    {"vkAllocateMemory", 6, -1, "vkAllocateMemory: VK_ERROR_OUT_OF_HOST_MEMORY"},
    {"vkCreateComputePipelines", 3, -1, "vkCreateComputePipelines: VK_ERROR_OUT_OF_HOST_MEMORY"},
    {"vkQueueSubmit", 15, -4, "vkQueueSubmit: VK_ERROR_DEVICE_LOST"},
    {"vkWaitForFences", 12, -4, "vkWaitForFences: VK_ERROR_DEVICE_LOST"},
    {"vkWaitForFences", 10, -1, "vkWaitForFences: VK_ERROR_OUT_OF_HOST_MEMORY"},
};

using DriverFaults = KeptRendering;

TEST_F(DriverFaults, EndInALineAndCostNothingThatWasThere) {
  constexpr int kOldPasses = 2;
  Words words = kept({"--passes", std::to_string(kOldPasses)});
  ASSERT_EQ(run(words).exit_code, 0);
  const std::string old_checkpoint = file_text(checkpoint()), old_picture = file_text(picture());
  const std::string expected = one_go({"--passes", "20"});
  ASSERT_NE(old_picture, expected);
  for (const DriverFault& fault : kFaults) {
    SCOPED_TRACE(::testing::PrintToString(fault));
    write_text(checkpoint(), old_checkpoint);
    write_text(picture(), old_picture);
    std::filesystem::remove(folder_ / "report");
    const auto with_layer = [&] {
      load_layer(::testing::PrintToString(fault).c_str());
      setenv("PPM_TEST_LAYER_REPORT", path("report").c_str(), 1);
    };
    const Result result =
        Program({"resume", checkpoint(), "--passes", "20", "--quiet"}, with_layer).finish();
    EXPECT_EQ(result.exit_code, 1) << "signal " << result.signal;
    EXPECT_TRUE(result.err.starts_with("ppm-vk: error: ")) << result.err;
    EXPECT_NE(result.err.find(fault.naming), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    const std::string report = file_text(folder_ / "report");
    EXPECT_TRUE(report.starts_with("failed ") && !report.starts_with("failed 0")) << report;
    EXPECT_TRUE(report.ends_with(" live 0\n")) << "Vulkan objects were left behind: " << report;
    EXPECT_TRUE(file_text(picture()) == old_picture);
    EXPECT_GE(kept_passes(), std::uint64_t{kOldPasses});
    EXPECT_EQ(folder_.names(),
              (std::set<std::string>{"c", "o.exr", "report", "s.glb", "whole.exr"}));
    EXPECT_EQ(run(resume({"--passes", "20"})).exit_code, 0);
    EXPECT_TRUE(file_text(picture()) == expected) << "resumed, it is another picture";
  }
}

}  // namespace
}  // namespace ppm::test
