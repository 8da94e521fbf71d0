#include "report_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "failure.hpp"
#include "false_colour.hpp"
#include "image.hpp"
#include "output_file.hpp"
#include "page_text.hpp"
#include "picture_reader.hpp"
#include "progress.hpp"
#include "report_content.hpp"
#include "tables.hpp"

namespace ppm::compare {
namespace {

namespace fs = std::filesystem;

// Pixels of all pictures that the page holds together, about: some ten megabytes.
constexpr double kPagePixels = 4e6;
constexpr unsigned kCrops = 3;

/// Writes pictures and knows what the page needs of them.
class ReportWriter {
 public:
  ReportWriter(const ReportFolder& folder, const Plan& plan, const Reference& reference)
      : folder_(folder),
        plan_(plan),
        reference_(reference),
        epsilon_(relative_epsilon(reference.rgb)),
        exposure_(plan.exposure.value_or(suitable_exposure(reference.rgb))),
        width_(plan.methods.front().settings.width),
        height_(plan.methods.front().settings.height) {
    std::error_code error;
    fs::create_directories(folder.path() / "pictures", error);
    if (error) {
      throw Failure((folder.path() / "pictures").string(), "cannot create the folder",
                    error.message(), "name a folder that can be written");
    }
  }

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  double exposure() const { return exposure_; }

  std::vector<float> read(const std::string& run, const std::string& file) const {
    return image::read_rgb(folder_.run_folder(run) / file, width_, height_);
  }
  void write_text(const std::string& name, const std::string& text) const {
    write_whole(folder_.path() / name, text);
  }
  /// pictures/NAME.exr and .png; the PNG's bytes.
  std::string write_picture(const std::string& name, const std::vector<float>& rgb) const {
    image::write(folder_.path() / "pictures" / (name + ".exr"), {width_, height_, rgb}, {}, {});
    const std::string png = png_of(rgb);
    write_text("pictures/" + name + ".png", png);
    return png;
  }
  std::string png_of(const std::vector<float>& rgb) const {
    std::vector<std::uint8_t> bytes(rgb.size());
    std::transform(rgb.begin(), rgb.end(), bytes.begin(),
                   [&](float value) { return image::srgb_byte(value, exposure_); });
    return image::encode_png(width_, height_, bytes);
  }
  std::vector<float> error_map(const std::vector<float>& rgb) const {
    return relative_error_map(rgb, reference_.rgb, epsilon_);
  }
  std::string error_png(const std::vector<float>& map) const {
    return image::encode_png(width_, height_, error_colours(map));
  }

  /// Which of `count` pictures the page shows: the last, and as many before it, evenly, as it can
  /// hold of `columns` methods.
  std::vector<std::size_t> shown_of(std::size_t count, std::size_t columns) const {
    const double each = 2.0 * static_cast<double>(columns) * width_ * height_;
    const auto room = static_cast<std::size_t>(std::clamp(kPagePixels / each, 1.0, 16.0));
    const std::size_t stride = (count + room - 1) / room;
    std::vector<std::size_t> shown;
    for (std::size_t from_end = 0; from_end < count; from_end += stride) {
      shown.insert(shown.begin(), count - 1 - from_end);
    }
    return shown;
  }

 private:
  const ReportFolder& folder_;
  const Plan& plan_;
  const Reference& reference_;
  double epsilon_, exposure_;
  std::uint32_t width_, height_;
};

std::string caption_of(const KeptPicture& picture, double rmse) {
  std::string text = fmt::format("{:.3g} s", picture.seconds);
  if (picture.samples > 0) {
    text += fmt::format(", {} samples a pixel", picture.samples);
  } else if (picture.mutations > 0) {
    text += fmt::format(", {} mutations a pixel", picture.mutations);
  } else {
    text += fmt::format(", {} passes", picture.passes);
  }
  return text + fmt::format(", RMSE {:.3g}", rmse);
}

/// Pictures and error pictures of a method's first seed; adds the map of the last one to `maps`.
PageColumn column_of(const ReportWriter& writer, const MethodResult& result, std::size_t columns,
                     std::vector<std::vector<float>>& maps) {
  PageColumn column{result.label, {}, {}};
  const SeedResult& seed = result.seeds.front();
  for (const std::size_t i : writer.shown_of(seed.errors.size(), columns)) {
    const KeptPicture& picture = seed.record.pictures[i];
    const std::vector<float> rgb = writer.read(seed.run, picture.file);
    std::vector<float> map = writer.error_map(rgb);
    const std::string errors = writer.error_png(map);
    const bool is_last = i + 1 == seed.errors.size();
    const std::string name = directory_name(result.label);
    const std::string png = is_last ? writer.write_picture(name, rgb) : writer.png_of(rgb);
    if (is_last) {
      writer.write_text("pictures/" + name + "-error.png", errors);
      maps.push_back(std::move(map));
    }
    column.pictures.push_back({png, caption_of(picture, seed.errors[i].rmse)});
    column.errors.push_back({errors, fmt::format("{:.3g} s, relative MSE {:.3g}", picture.seconds,
                                                 seed.errors[i].relative_mse)});
  }
  return column;
}

void add_reference(const ReportWriter& writer, const Reference& reference, PageContent& content) {
  PageColumn column{"reference", {}, {}};
  column.pictures.push_back({writer.write_picture("reference", reference.rgb),
                             reference.method.empty() ? "a file" : "by " + reference.method});
  if (!reference.standard_error.empty()) {
    writer.write_picture("reference-standard-error", reference.standard_error);
    // Its error bars, on the scale of the others' errors.
    std::vector<float> either = reference.rgb;
    for (std::size_t i = 0; i < either.size(); ++i) either[i] += reference.standard_error[i];
    column.errors.push_back(
        {writer.error_png(writer.error_map(either)),
         fmt::format("its standard error, relative MSE {:.3g}", reference.relative_mse)});
  }
  content.columns.push_back(std::move(column));
}

void add_figures(const ReportWriter& writer, const Figures& figures, PageContent& content) {
  content.figure4 = figure4_plots(figures);
  for (const KeptPicture& picture : figures.record.pictures) {
    const std::vector<float> rgb = writer.read(figures.run, picture.file);
    const std::string name = fmt::format("figure5-{:05}", picture.passes);
    content.figure5.push_back(
        {writer.write_picture(name, rgb),
         fmt::format("{} pass{}, {} photons", picture.passes, picture.passes == 1 ? "" : "es",
                     render::short_count(static_cast<double>(picture.photons_emitted)))});
  }
}

}  // namespace

void write_report(const ReportFolder& folder, const Plan& plan,
                  const std::vector<MethodResult>& results, const Reference& reference,
                  const std::optional<Figures>& figures, const Facts& machine,
                  const std::map<std::string, std::string>& failures) {
  const ReportWriter writer(folder, plan, reference);
  PageContent content;
  content.width = writer.width();
  content.height = writer.height();
  for (const auto& [name, value] : machine) {
    if (name == "scene") content.title = value + ": methods compared";
  }
  content.summary = summary_of(plan, results, reference);
  for (const auto& [what, why] : failures) content.failures.push_back(what + " failed: " + why);

  std::vector<std::vector<float>> maps;
  for (const MethodResult& result : results) {
    if (result.seeds.empty()) continue;
    content.columns.push_back(column_of(writer, result, results.size(), maps));
    content.parameters.emplace_back(result.label, parameters_of(result));
  }
  add_reference(writer, reference, content);
  content.crops = plan.crops;
  if (content.crops.empty() && !maps.empty()) {
    content.crops = crops_of_interest(maps, writer.width(), writer.height(), kCrops);
  }
  content.curves = error_curves(results, reference);
  add_table(content, results);
  if (figures) add_figures(writer, *figures, content);
  content.facts = machine;
  content.facts.emplace_back("exposure of what is shown",
                             fmt::format("2^{:.3g}", writer.exposure()));
  content.facts.emplace_back("epsilon of relative errors",
                             short_number(relative_epsilon(reference.rgb)));

  writer.write_text("table.csv", table_csv(results, rmse_of_ppm(results)));
  writer.write_text("errors.csv", errors_csv(results));
  content.files = {{"table.csv", "effort and result of each method"},
                   {"errors.csv", "errors of each picture that was kept: the curves"}};
  if (figures) {
    writer.write_text("figure4.csv", figure4_csv(*figures));
    writer.write_text("figure5.csv", figure5_csv(*figures));
    content.files.insert(content.files.end(),
                         {{"figure4.csv", "N, R and L of the probes after each pass"},
                          {"figure5.csv", "pictures after so many passes"}});
  }
  content.files.insert(content.files.end(),
                       {{"pictures/", "results and reference, EXR and PNG"},
                        {"runs/", "all renderings: run.json and the pictures kept, EXR"}});
  writer.write_text("index.html", page_html(content));
}

}  // namespace ppm::compare
