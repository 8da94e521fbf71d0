// What was rendered and how, as attributes of a picture and as the statistics file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "driver.hpp"
#include "image.hpp"

namespace ppm::render {

/// The initial radius that the settings ask for, as --radius takes it.
std::string radius_text(const Settings& settings);

/// All that decides the pixels, and how far the rendering came; no times, so that equal pictures
/// make equal files.
std::vector<image::Attribute> picture_attributes(const Settings& settings,
                                                 const Circumstances& circumstances,
                                                 const Statistics& statistics);

/// The statistics file's text. `seconds` holds load, write and total; those of `statistics` join
/// them.
std::string statistics_json(const Settings& settings, const Circumstances& circumstances,
                            const Statistics& statistics,
                            const std::map<std::string, double>& seconds,
                            const std::vector<std::string>& warnings);

}  // namespace ppm::render
