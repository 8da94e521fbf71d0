// The extensions of glTF and how each is treated: the one table that the loader, its warnings,
// `ppm-vk inspect` and the README follow.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ppm::scene {

enum class Treatment {
  implemented,  ///< does what its specification says; `note` names what it leaves out
  harmless,     ///< changes nothing in a picture: no warning, and accepted when required
  ignored,      ///< warned of once; a file that requires it is refused
};

struct ExtensionEntry {
  std::string_view name;
  Treatment treatment;
  std::string_view note;  ///< why, or what is left out; may be empty
};

/// Sorted by name.
std::span<const ExtensionEntry> known_extensions();

/// Nothing for a name that the table does not have: such an extension is ignored, too.
const ExtensionEntry* find_extension(std::string_view name);

/// "implemented", "harmless", "ignored".
const char* treatment_name(Treatment treatment);

/// An extension that a file declares or uses.
struct UsedExtension {
  std::string name;  ///< as it may be printed
  bool required = false;
  Treatment treatment = Treatment::ignored;
  std::string note;
};

}  // namespace ppm::scene
