#pragma once
// Where the time-zone data lies, and the part of it that the date library does not read.
#include <filesystem>
#include <optional>
#include <string>

#include "astro/time/posix_zone.h"

namespace skylapse::astro {

/// The folder that the date library reads as well (it knows no $TZDIR).
std::filesystem::path zone_folder();

/// Whether zone `name` has a file that starts as a TZif file does (the date library aborts on
/// others).
bool is_zone_file(const std::string& name);

/// The rule in the footer of the TZif file of zone `name`; nothing if the file has none
/// (version 1 files) or it is empty.
/// Source  RFC 8536, section 3.3: the footer is the last line of the file.
std::optional<PosixZone> read_zone_footer(const std::string& name);

}  // namespace skylapse::astro
