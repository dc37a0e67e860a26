#pragma once
// The sections that the top level is made of.
#include "config/key_spec.h"

namespace skylapse::config {

const SectionSpec& site_spec();
const SectionSpec& time_spec();
const SectionSpec& air_spec();
const SectionSpec& sky_spec();
const SectionSpec& camera_spec();
const SectionSpec& exposure_spec();
const SectionSpec& color_spec();
const SectionSpec& image_spec();
const SectionSpec& movie_spec();
const SectionSpec& specular_spec();
const SectionSpec& irradiance_spec();
const SectionSpec& harmonics_spec();
const SectionSpec& sun_light_spec();
const SectionSpec& dome_spec();
const SectionSpec& gallery_spec();
const SectionSpec& sheet_spec();

}  // namespace skylapse::config
