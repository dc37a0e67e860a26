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

}  // namespace skylapse::config
