#pragma once
// A whole atmosphere in a file, for people who bring one of their own: every spectrum and profile
// that the models know. Its keys are in docs/config.md, beside those of a job.
#include <string>

#include "config/key_spec.h"
#include "core/result.h"
#include "sky/atmosphere/atmosphere.h"

namespace skylapse::config {

/// Reads and checks a file; all errors in one go, in the order of their places. Parts that are not
/// written are those of the default atmosphere (sky::atmosphere::atmosphere_of of an
/// AirDescription as it is made).
Result<sky::atmosphere::Atmosphere, Diagnostics> load_atmosphere(const std::string& path);
/// The same for text; `name` is used in messages.
Result<sky::atmosphere::Atmosphere, Diagnostics> parse_atmosphere(const std::string& text,
                                                                  const std::string& name);

/// The whole file.
const SectionSpec& atmosphere_spec();

}  // namespace skylapse::config
