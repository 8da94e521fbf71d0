#include "tables.hpp"

#include <initializer_list>

#include "page_text.hpp"

namespace ppm::compare {
namespace {

std::string line(const std::vector<std::string>& fields) {
  std::string text;
  for (const std::string& field : fields) {
    if (!text.empty()) text += ',';
    text += csv_field(field);
  }
  return text + "\r\n";
}

std::string optional_number(const std::optional<double>& value) {
  return value ? whole_number(*value) : "";
}

void add_effort(std::vector<std::string>& fields, const KeptPicture& picture) {
  for (const std::uint64_t count :
       {picture.passes, picture.samples, picture.mutations, picture.photons_emitted,
        picture.photons_stored, picture.rays}) {
    fields.push_back(std::to_string(count));
  }
}

}  // namespace

double rmse_of_ppm(const std::vector<MethodResult>& results) {
  for (const MethodResult& result : results) {
    if (result.integrator == "ppm" && !result.seeds.empty()) return result.rmse;
  }
  return 0.0;
}

std::string table_csv(const std::vector<MethodResult>& results, double against) {
  std::string csv = line({"method", "seeds", "passes", "samples", "mutations", "photons_emitted",
                          "photons_stored", "rays", "seconds", "rmse", "relative_mse",
                          "trimmed_relative_mse", "rmse_to_ppm", "rmse_slope", "relative_mse_slope",
                          "trimmed_relative_mse_slope", "noise", "bias", "failure"});
  for (const MethodResult& result : results) {
    std::vector<std::string> fields = {result.label, std::to_string(result.seeds.size())};
    if (result.seeds.empty()) {
      fields.resize(18);
    } else {
      const KeptPicture& last = result.seeds.front().record.last();
      add_effort(fields, last);
      for (const double value :
           {last.seconds, result.rmse, result.relative_mse, result.trimmed_relative_mse}) {
        fields.push_back(whole_number(value));
      }
      fields.push_back(against > 0.0 ? whole_number(result.rmse / against) : "");
      for (const auto& value : {result.rmse_slope, result.relative_slope, result.trimmed_slope,
                                result.noise, result.bias}) {
        fields.push_back(optional_number(value));
      }
    }
    fields.push_back(result.failure);
    csv += line(fields);
  }
  return csv;
}

std::string errors_csv(const std::vector<MethodResult>& results) {
  std::string csv = line({"method",
                          "seed",
                          "seconds",
                          "resolve_seconds",
                          "passes",
                          "samples",
                          "mutations",
                          "photons_emitted",
                          "photons_stored",
                          "rays",
                          "rmse",
                          "relative_mse",
                          "trimmed_relative_mse",
                          "mean_r",
                          "mean_g",
                          "mean_b",
                          "difference_r",
                          "difference_g",
                          "difference_b",
                          "left_out",
                          "picture"});
  for (const MethodResult& result : results) {
    for (const SeedResult& seed : result.seeds) {
      for (std::size_t i = 0; i < seed.errors.size(); ++i) {
        const KeptPicture& picture = seed.record.pictures[i];
        const Errors& errors = seed.errors[i];
        std::vector<std::string> fields = {result.label, std::to_string(seed.record.seed),
                                           whole_number(picture.seconds),
                                           whole_number(picture.resolve_seconds)};
        add_effort(fields, picture);
        for (const double value :
             {errors.rmse, errors.relative_mse, errors.trimmed_relative_mse, errors.mean[0],
              errors.mean[1], errors.mean[2], errors.mean_difference[0], errors.mean_difference[1],
              errors.mean_difference[2]}) {
          fields.push_back(whole_number(value));
        }
        fields.push_back(std::to_string(errors.left_out));
        fields.push_back("runs/" + seed.run + "/" + picture.file);
        csv += line(fields);
      }
    }
  }
  return csv;
}

std::string figure4_csv(const Figures& figures) {
  std::string csv = line({"x", "y", "passes", "N", "R", "L_r", "L_g", "L_b"});
  for (const ProbeCurve& curve : figures.probes) {
    for (const auto& [passes, reading] : curve.samples) {
      csv += line({std::to_string(curve.at.x), std::to_string(curve.at.y), std::to_string(passes),
                   whole_number(reading.photons), whole_number(reading.radius),
                   whole_number(reading.radiance[0]), whole_number(reading.radiance[1]),
                   whole_number(reading.radiance[2])});
    }
  }
  return csv;
}

std::string figure5_csv(const Figures& figures) {
  std::string csv = line({"passes", "photons_emitted", "seconds", "picture"});
  for (const KeptPicture& picture : figures.record.pictures) {
    csv += line({std::to_string(picture.passes), std::to_string(picture.photons_emitted),
                 whole_number(picture.seconds), "runs/" + figures.run + "/" + picture.file});
  }
  return csv;
}

}  // namespace ppm::compare
