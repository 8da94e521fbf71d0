// The table of extensions, and that the loader follows it.
#include "extensions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "made_document.hpp"

namespace ppm::test {
namespace {

using scene::ExtensionEntry;
using scene::Treatment;

TEST(Extensions, TheTableIsSortedAndSaysWhyWhatIsIgnoredIs) {
  const auto table = scene::known_extensions();
  EXPECT_TRUE(std::ranges::is_sorted(table, {}, &ExtensionEntry::name));
  EXPECT_EQ(std::ranges::adjacent_find(table, {}, &ExtensionEntry::name), table.end());
  for (const ExtensionEntry& entry : table) {
    EXPECT_EQ(scene::find_extension(entry.name), &entry);
    if (entry.treatment != Treatment::implemented) {
      EXPECT_FALSE(entry.note.empty()) << entry.name;
    }
  }
  EXPECT_EQ(scene::find_extension("EXT_that_nobody_knows"), nullptr);
}

TEST(Extensions, DeclaredOnesAreTreatedAsTheTableSays) {
  for (const ExtensionEntry& entry : scene::known_extensions()) {
    GltfDocument document;
    document.triangle();
    document.root["extensionsUsed"] = {entry.name};
    Log log(Verbosity::quiet);
    const scene::Scene scene = load(document, log);
    const std::size_t warnings = entry.treatment == Treatment::ignored ? 1 : 0;
    EXPECT_EQ(warnings_with(log, std::string(entry.name)), warnings) << entry.name;
    EXPECT_EQ(warnings_with(log, std::string(entry.note)), warnings) << entry.name;
    ASSERT_EQ(scene.findings.extensions.size(), 1u) << entry.name;
    const scene::UsedExtension& found = scene.findings.extensions.front();
    EXPECT_EQ(found.name, entry.name);
    EXPECT_EQ(found.treatment, entry.treatment) << entry.name;
    EXPECT_EQ(found.note, entry.note) << entry.name;
    EXPECT_FALSE(found.required) << entry.name;
  }
}

TEST(Extensions, RequiredOnesAreRefusedWhereTheyAreIgnored) {
  const TemporaryFolder folder;
  for (const ExtensionEntry& entry : scene::known_extensions()) {
    GltfDocument document;
    document.triangle();
    document.root["extensionsUsed"] = document.root["extensionsRequired"] = {entry.name};
    document.write_gltf(folder / "scene.gltf");
    const std::string message = refusal(folder / "scene.gltf");
    EXPECT_EQ(message.find(entry.name) != std::string::npos, entry.treatment == Treatment::ignored)
        << entry.name << ": " << message;
  }
}

TEST(Extensions, AreInTheReadmeAsTheyAreTreated) {
  std::ifstream file(PPM_README);
  const std::string readme((std::istreambuf_iterator<char>(file)),
                           std::istreambuf_iterator<char>());
  for (const ExtensionEntry& entry : scene::known_extensions()) {
    const std::string row = "| " + std::string(entry.name) + " | " +
                            scene::treatment_name(entry.treatment) + " | " +
                            std::string(entry.note) + " |\n";
    EXPECT_NE(readme.find(row), std::string::npos) << row;
  }
}

TEST(Extensions, UnknownOnesAreIgnoredAndListed) {
  GltfDocument document;
  document.triangle();
  document.root["extensionsUsed"] = {"EXT_nobody"};
  Log log(Verbosity::quiet);
  const scene::Scene scene = load(document, log);
  EXPECT_EQ(warnings_with(log, "EXT_nobody"), 1u);
  ASSERT_EQ(scene.findings.extensions.size(), 1u);
  EXPECT_EQ(scene.findings.extensions[0].treatment, Treatment::ignored);
}

}  // namespace
}  // namespace ppm::test
