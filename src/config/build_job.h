#pragma once
// From checked values to the job: what values mean together.
#include "config/section_reader.h"

namespace skylapse::config {

std::vector<Site> build_sites(const Section& root, const ReadContext& context);

/// `sites` decide whether a time without an offset has a zone.
TimePlan build_time(const Section& root, const std::vector<Site>& sites,
                    const ReadContext& context);

/// The model that the config asks for.
SkyModel sky_model(const Section& root);
/// The CIE sky that it asks for, if it does.
int cie_type(const Section& root);
/// `sites` decide whether keyframes without an offset have a zone.
Air build_air(const Section& root, const std::vector<Site>& sites, const ReadContext& context);
Sky build_sky(const Section& root, const ReadContext& context);
std::vector<CameraConfig> build_cameras(const Section& root, const ReadContext& context);
/// The view that an image output has for itself; nothing if no key of a view is written, or if its
/// projection is wrong.
std::optional<CameraConfig> build_own_view(const Section& output,
                                           const std::vector<CameraConfig>& cameras,
                                           const ReadContext& context);
/// The cube or lat-long map of a product, centred on north; `size` where none is written.
CameraConfig build_product_view(const Section& output, image::Projection projection, int size,
                                const ReadContext& context);
color::ExposureSettings build_exposure(const Section& root, const ReadContext& context);
ColorConfig build_color(const Section& root, const ReadContext& context);

/// `job` is complete but for its outputs.
std::vector<Output> build_outputs(const Section& root, const JobConfig& job,
                                  const ReadContext& context);

/// Refuses jobs beyond kMaxJobFrames by arithmetic alone.
void check_frame_count(const Section& root, const JobConfig& job, const ReadContext& context);

/// The section under a key that holds one section; null if there is none.
std::shared_ptr<const Section> only_section(const Section& parent, std::string_view key);

/// A name of a site or camera for use in file names: it must hold a letter or digit.
bool names_a_file(std::string_view name);

}  // namespace skylapse::config
