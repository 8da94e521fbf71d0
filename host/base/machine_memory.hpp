// How much memory the machine has left for this process.
#pragma once

#include <cstdint>
#include <filesystem>

namespace ppm {

/// Bytes that can be allocated without swapping or being killed, as far as the system tells:
/// MemAvailable, or what the control group has left where that is less. UINT64_MAX where neither
/// tells. `root` stands for / in tests.
std::uint64_t available_memory(const std::filesystem::path& root = "/");

}  // namespace ppm
