#include "source_calls.hpp"

#include <vulkan/vulkan.h>

#include <cctype>
#include <fstream>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ppm::test {
namespace {

template <class Function>
struct Returns;
template <class Result, class... Arguments>
struct Returns<Result(VKAPI_PTR*)(Arguments...)> {
  static constexpr bool a_result = std::is_same_v<Result, VkResult>;
};

bool is_part_of_a_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Names in the line that begin with `beginning`, with what stands before and after them.
struct Name {
  std::string text;
  char before, after;
};
std::vector<Name> names_in(const std::string& line, std::string_view beginning) {
  std::vector<Name> names;
  for (auto at = line.find(beginning); at != std::string::npos; at = line.find(beginning, at + 1)) {
    const char before = at > 0 ? line[at - 1] : ' ';
    if (is_part_of_a_name(before)) continue;
    std::size_t end = at;
    while (end < line.size() && is_part_of_a_name(line[end])) ++end;
    names.push_back({line.substr(at, end - at), before, end < line.size() ? line[end] : ' '});
  }
  return names;
}

void read_line(const std::string& line, const std::string& place, SourceCalls& calls) {
  for (const Name& name : names_in(line, "PPM_VK_")) {
    if (name.after == '(') calls.checked.insert(place);
  }
  for (const Name& name : names_in(line, "vk")) {
    if (name.after == '(' && name.before != '"') calls.direct.emplace(name.text, place);
  }
  for (const Name& name : names_in(line, "PFN_vk")) {
    calls.pointed.emplace(name.text.substr(4), place);
  }
}

}  // namespace

SourceCalls read_sources(const std::filesystem::path& folder) {
  SourceCalls calls;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".cpp" && file.extension() != ".hpp") continue;
    std::ifstream stream(file);
    std::string line;
    for (unsigned number = 1; std::getline(stream, line); ++number) {
      if (line.starts_with("#define")) continue;
      read_line(line, file.filename().string() + ":" + std::to_string(number), calls);
    }
  }
  // The seam's own text.
  std::erase_if(calls.checked, [](const std::string& place) { return place.starts_with("call."); });
  return calls;
}

bool cannot_fail(const std::string& function) {
#define PPM_SURE(name) \
  { #name, !Returns < PFN_##name> ::a_result }
  static const std::map<std::string, bool> sure = {
      PPM_SURE(vkCmdBeginDebugUtilsLabelEXT),
      PPM_SURE(vkCmdBindDescriptorSets),
      PPM_SURE(vkCmdBindPipeline),
      PPM_SURE(vkCmdCopyBuffer),
      PPM_SURE(vkCmdDispatch),
      PPM_SURE(vkCmdDispatchIndirect),
      PPM_SURE(vkCmdEndDebugUtilsLabelEXT),
      PPM_SURE(vkCmdFillBuffer),
      PPM_SURE(vkCmdPipelineBarrier),
      PPM_SURE(vkCmdPushConstants),
      PPM_SURE(vkCmdResetQueryPool),
      PPM_SURE(vkCmdWriteTimestamp),
      PPM_SURE(vkDestroyBuffer),
      PPM_SURE(vkDestroyBufferView),
      PPM_SURE(vkDestroyCommandPool),
      PPM_SURE(vkDestroyDebugUtilsMessengerEXT),
      PPM_SURE(vkDestroyDescriptorPool),
      PPM_SURE(vkDestroyDescriptorSetLayout),
      PPM_SURE(vkDestroyDevice),
      PPM_SURE(vkDestroyFence),
      PPM_SURE(vkDestroyInstance),
      PPM_SURE(vkDestroyPipeline),
      PPM_SURE(vkDestroyPipelineLayout),
      PPM_SURE(vkDestroyQueryPool),
      PPM_SURE(vkDestroyShaderModule),
      PPM_SURE(vkFreeMemory),
      PPM_SURE(vkGetBufferMemoryRequirements),
      PPM_SURE(vkGetDeviceProcAddr),
      PPM_SURE(vkGetDeviceQueue),
      PPM_SURE(vkGetInstanceProcAddr),
      PPM_SURE(vkGetPhysicalDeviceFeatures2),
      PPM_SURE(vkGetPhysicalDeviceFormatProperties),
      PPM_SURE(vkGetPhysicalDeviceMemoryProperties),
      PPM_SURE(vkGetPhysicalDeviceMemoryProperties2),
      PPM_SURE(vkGetPhysicalDeviceProperties),
      PPM_SURE(vkGetPhysicalDeviceProperties2),
      PPM_SURE(vkGetPhysicalDeviceQueueFamilyProperties),
      PPM_SURE(vkUpdateDescriptorSets),
  };
#undef PPM_SURE
  const auto found = sure.find(function);
  return found != sure.end() && found->second;
}

}  // namespace ppm::test
