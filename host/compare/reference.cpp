#include "reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "failure.hpp"
#include "metrics.hpp"
#include "picture_reader.hpp"
#include "progress.hpp"
#include "rendering.hpp"
#include "report.hpp"

namespace ppm::compare {
namespace {

constexpr std::uint32_t kBlock = 8;
constexpr double kTrialShare = 1.0 / 20.0;  // of the reference's time
constexpr unsigned kTrialSeeds = 2;

double luminance(const float* rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// Mean luminances, block by block.
std::vector<double> block_means(std::span<const float> rgb, std::uint32_t width) {
  const std::uint32_t across = (width + kBlock - 1) / kBlock;
  const std::size_t pixels = rgb.size() / 3;
  const std::size_t rows = pixels / width, down = (rows + kBlock - 1) / kBlock;
  std::vector<double> sums(across * down, 0.0), counts(across * down, 0.0);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t block = i / width / kBlock * across + i % width / kBlock;
    sums[block] += luminance(&rgb[3 * i]);
    counts[block] += 1.0;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
  return sums;
}

/// The mean over the seeds' last pictures; nothing when interrupted.
std::optional<PictureMean> render_seeds(Stage& stage, const ReportFolder& folder,
                                        const Method& method, const std::string& kind,
                                        const std::vector<std::uint32_t>& seeds, double seconds) {
  PictureMean mean;
  Schedule schedule;
  schedule.seconds = seconds;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const std::string name = fmt::format("{}-{}-{}", kind, directory_name(method.label), i);
    const auto record = rendering(stage, folder, name, method, seeds[i], schedule);
    if (!record) return std::nullopt;
    mean.add(image::read_rgb(folder.run_folder(name) / record->last().file, method.settings.width,
                             method.settings.height));
  }
  return mean;
}

std::vector<std::uint32_t> seeds_from(const Plan& plan, unsigned count,
                                      std::uint32_t (*seed)(const Plan&, unsigned)) {
  std::vector<std::uint32_t> seeds;
  for (unsigned i = 0; i < count; ++i) seeds.push_back(seed(plan, i));
  return seeds;
}

struct Choice {
  Method method;
  std::string why;
};

/// Who makes the reference, found out by trials; nothing when interrupted.
std::optional<Choice> choose(Stage& stage, const ReportFolder& folder, const Plan& plan) {
  const ReferencePlan& wanted = plan.reference;
  if (wanted.method) return Choice{*wanted.method, "as --reference-method asks."};
  if (wanted.candidates.empty()) {
    return Choice{wanted.photons, "no unbiased method is outside of the comparison."};
  }
  const auto seeds = seeds_from(plan, kTrialSeeds, trial_seed);
  const double seconds = kTrialShare * wanted.seconds;
  const auto judge = render_seeds(stage, folder, wanted.photons, "trial", seeds, seconds);
  if (!judge) return std::nullopt;
  std::string findings;
  for (const Method& candidate : wanted.candidates) {
    try {
      const auto trial = render_seeds(stage, folder, candidate, "trial", seeds, seconds);
      if (!trial) return std::nullopt;
      const double share =
          share_of_differing_blocks(judge->mean(), trial->mean(), candidate.settings.width);
      findings += fmt::format(
          "In a trial of {:.3g} s {} and ppm differed in {:.0f} % of blocks of 8 x 8 pixels. ",
          seconds * kTrialSeeds, candidate.label, 100.0 * share);
      if (share <= kTolerableShare) {
        return Choice{candidate,
                      findings + "It finds the light, and is outside of the comparison."};
      }
    } catch (const Failure& failure) {
      findings += fmt::format("{} cannot: {}. ", candidate.label, failure.what());
    }
  }
  return Choice{wanted.photons, findings + "It is photons that find this light."};
}

void add_error_bars(Reference& reference) {
  const double epsilon = relative_epsilon(reference.rgb);
  double squares = 0.0, relative = 0.0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    const double error = reference.standard_error[i], value = reference.rgb[i];
    if (!std::isfinite(error) || !std::isfinite(value)) continue;
    squares += error * error;
    if (epsilon > 0.0) relative += error * error / (value * value + epsilon);
  }
  const auto count = static_cast<double>(reference.rgb.size());
  reference.rmse = std::sqrt(squares / count);
  reference.relative_mse = relative / count;
}

std::string account_of(const Choice& choice, unsigned seeds, double seconds) {
  const render::Settings& settings = choice.method.settings;
  std::string account = fmt::format("Made by {}, {} seeds of {} each: {}", choice.method.label,
                                    seeds, render::clock_time(seconds), choice.why);
  if (settings.integrator == "ppm") {
    account += fmt::format(
        " It has alpha {}, first radius {} and {} eye paths a pixel for each seed. Its error bars "
        "are the spread of its seeds; what blur of the last radii they have in common is in none "
        "of them.",
        settings.alpha, render::radius_text(settings), settings.samples_per_pixel);
  }
  if (seeds < 2) account += " One seed alone has no error bars.";
  return account;
}

}  // namespace

double share_of_differing_blocks(std::span<const float> a, std::span<const float> b,
                                 std::uint32_t width) {
  const std::vector<double> means_a = block_means(a, width), means_b = block_means(b, width);
  PPM_ASSERT(means_a.size() == means_b.size() && !means_a.empty(), "pictures of one size");
  double whole = 0.0;
  for (std::size_t i = 0; i < means_a.size(); ++i) whole += std::max(means_a[i], means_b[i]);
  whole /= static_cast<double>(means_a.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < means_a.size(); ++i) {
    const double allowed = 0.1 * std::max(means_a[i], means_b[i]) + 0.01 * whole;
    if (!(std::abs(means_a[i] - means_b[i]) <= allowed)) ++differing;
  }
  return static_cast<double>(differing) / static_cast<double>(means_a.size());
}

std::optional<Reference> make_reference(Stage& stage, const ReportFolder& folder,
                                        const Plan& plan) {
  const render::Settings& size = plan.methods.front().settings;
  Reference reference;
  if (!plan.reference.file.empty()) {
    reference.rgb = image::read_rgb(plan.reference.file, size.width, size.height);
    reference.account = fmt::format("The file {}; its error bars are not known.",
                                    plan.reference.file.filename().string());
    return reference;
  }
  const auto choice = choose(stage, folder, plan);
  if (!choice) return std::nullopt;
  const unsigned seeds = plan.reference.seeds;
  const double seconds = plan.reference.seconds / seeds;
  const auto mean = render_seeds(stage, folder, choice->method, "reference",
                                 seeds_from(plan, seeds, reference_seed), seconds);
  if (!mean) return std::nullopt;
  reference.rgb = mean->mean();
  reference.method = choice->method.label;
  reference.account = account_of(*choice, seeds, seconds);
  if (seeds > 1) {
    reference.standard_error = mean->standard_error();
    add_error_bars(reference);
  }
  return reference;
}

}  // namespace ppm::compare
