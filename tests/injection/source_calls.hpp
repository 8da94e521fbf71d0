// What the host's sources say of Vulkan: through which places calls go that are checked, and which
// functions are called past them.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace ppm::test {

struct SourceCalls {
  std::set<std::string> checked;               ///< "buffer.cpp:104", uses of PPM_VK_TRY and its kin
  std::map<std::string, std::string> direct;   ///< "vkCmdDispatch" to a place where it is called
  std::map<std::string, std::string> pointed;  ///< the same of PFN_vk..., without PFN_
};

/// Of all .cpp and .hpp files below `folder`. Comments count as text.
SourceCalls read_sources(const std::filesystem::path& folder);

/// Whether the function cannot fail, as its declaration says; false for those unknown here.
bool cannot_fail(const std::string& function);

}  // namespace ppm::test
