// What a folder takes up, refuses and leaves behind.
#include "report_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <stdexcept>

#include "failure.hpp"
#include "temporary_folder.hpp"

namespace ppm::compare {
namespace {

using Names = std::set<std::string>;
using test::write_text;

const Options kIdentity = {{"device", "a"}, {"scene contents", "12"}};

RunRecord some_record() {
  RunRecord record;
  record.label = "ppm";
  record.seed = 3;
  record.options = {{"alpha", "0.7"}, {"radius", "auto"}};
  record.budget_seconds = 0.1;
  record.start_seconds = 0.25;
  record.prepare_seconds = 0.125;
  record.complete = true;
  record.pictures = {{"1.exr", 0.05, 0.01, 1, 2, 3, 4, 5, 6},
                     {"2.exr", 0.1, 0.02, 2, 4, 6, 8, 10, 12}};
  record.hit_points = 7;
  record.paths_cut = 8;
  record.initial_radius = 1.0 / 3.0;
  record.rejected = {{"clamped", 9}};
  record.warnings = {"a \"b\" \xff"};
  return record;
}

std::optional<RunRecord> filled(const std::filesystem::path& folder) {
  write_text(folder / "1.exr", "1");
  write_text(folder / "2.exr", "2");
  return some_record();
}

Names names_in(const std::filesystem::path& path) {
  Names names;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// The line of the Failure that `deed` throws.
template <class Deed>
std::string refusal_of(Deed deed) {
  try {
    deed();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

class ReportFolderTest : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return folder_.path() / "report"; }
  test::TemporaryFolder folder_;
};

TEST_F(ReportFolderTest, ARunIsFoundAgainWithAllItsFigures) {
  {
    const ReportFolder folder(path(), kIdentity);
    EXPECT_FALSE(folder.find("ppm-3", some_record()));
    ASSERT_TRUE(folder.add("ppm-3", filled));
  }
  const ReportFolder folder(path(), kIdentity);
  const auto found = folder.find("ppm-3", some_record());
  ASSERT_TRUE(found);
  RunRecord expected = some_record();
  expected.warnings = {"a \"b\" \xef\xbf\xbd"};
  EXPECT_EQ(record_json(*found), record_json(expected));
  EXPECT_EQ(found->initial_radius, expected.initial_radius);
  EXPECT_EQ(found->last().rays, 12u);
}

TEST_F(ReportFolderTest, RunsAppearWholeOrNotAtAll) {
  const ReportFolder folder(path(), kIdentity);
  EXPECT_FALSE(folder.add("interrupted", [](const auto& part) -> std::optional<RunRecord> {
    filled(part);
    return std::nullopt;
  }));
  EXPECT_THROW(folder.add("broken",
                          [](const auto& part) -> std::optional<RunRecord> {
                            filled(part);
                            throw std::runtime_error("no");
                          }),
               std::runtime_error);
  EXPECT_EQ(names_in(path() / "runs"), Names{});
  // What a killed process left is begun anew.
  std::filesystem::create_directories(path() / "runs" / ".ppm-3.part");
  write_text(path() / "runs" / ".ppm-3.part" / "9.exr", "half");
  EXPECT_FALSE(folder.find("ppm-3", some_record()));
  ASSERT_TRUE(folder.add("ppm-3", filled));
  EXPECT_EQ(names_in(path() / "runs"), Names{"ppm-3"});
  EXPECT_EQ(names_in(path() / "runs" / "ppm-3"), (Names{"1.exr", "2.exr", "run.json"}));
}

TEST_F(ReportFolderTest, RefusesFoldersOfOthers) {
  { const ReportFolder folder(path(), kIdentity); }
  const std::string other = refusal_of([&] {
    ReportFolder(path(), {{"device", "a"}, {"scene contents", "13"}});
  });
  EXPECT_NE(other.find("scene contents 12 instead of 13"), std::string::npos) << other;
  EXPECT_EQ(other.find('\n'), std::string::npos);
  std::filesystem::create_directories(folder_ / "photographs");
  write_text(folder_ / "photographs" / "a.png", "");
  EXPECT_NE(refusal_of([&] { ReportFolder(folder_ / "photographs", kIdentity); }).find("not empty"),
            std::string::npos);
  EXPECT_EQ(names_in(folder_ / "photographs"), Names{"a.png"});
  write_text(folder_ / "file", "");
  EXPECT_NE(refusal_of([&] { ReportFolder(folder_ / "file", kIdentity); }), "");
  write_text(path() / "comparison.json", "{");
  EXPECT_NE(refusal_of([&] { ReportFolder(path(), kIdentity); }).find("no comparison"),
            std::string::npos);
}

TEST_F(ReportFolderTest, RefusesASecondProcess) {
  const ReportFolder folder(path(), kIdentity);
  EXPECT_NE(refusal_of([&] { ReportFolder(path(), kIdentity); }).find("is writing it"),
            std::string::npos);
}

TEST_F(ReportFolderTest, RefusesRunsWithOtherOptions) {
  const ReportFolder folder(path(), kIdentity);
  ASSERT_TRUE(folder.add("ppm-3", filled));
  RunRecord wanted = some_record();
  wanted.options["alpha"] = "0.8";
  EXPECT_NE(refusal_of([&] { folder.find("ppm-3", wanted); }).find("alpha 0.7 instead of 0.8"),
            std::string::npos);
  wanted = some_record();
  wanted.budget_seconds = 60.0;
  EXPECT_NE(refusal_of([&] { folder.find("ppm-3", wanted); }).find("0.1 s instead of 60 s"),
            std::string::npos);
  std::filesystem::remove(path() / "runs" / "ppm-3" / "2.exr");
  EXPECT_NE(refusal_of([&] { folder.find("ppm-3", some_record()); }).find("2.exr"),
            std::string::npos);
}

TEST_F(ReportFolderTest, RefusesBrokenRecords) {
  const ReportFolder folder(path(), kIdentity);
  ASSERT_TRUE(folder.add("ppm-3", filled));
  const auto file = path() / "runs" / "ppm-3" / "run.json";
  const std::string whole = test::file_text(file);
  std::string outside = whole;
  outside.replace(outside.find("1.exr"), 5, "../../../1.exr");
  for (const std::string& text :
       {std::string(), std::string("[]"), whole.substr(0, whole.size() / 2),
        std::string("{\"pictures\": []}"), outside}) {
    write_text(file, text);
    const std::string line = refusal_of([&] { folder.find("ppm-3", some_record()); });
    EXPECT_NE(line.find("run.json"), std::string::npos) << text;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST(RunRecord, DifferencesAreNamed) {
  const Options a = {{"alpha", "0.7"}}, b = {{"alpha", "0.7"}, {"nearest", "500"}};
  EXPECT_EQ(difference_of(a, a), "");
  EXPECT_EQ(difference_of(a, b), "no nearest instead of 500");
  EXPECT_EQ(difference_of(b, a), "nearest 500 instead of none");
}

}  // namespace
}  // namespace ppm::compare
