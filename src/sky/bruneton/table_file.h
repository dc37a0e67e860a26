#pragma once
// Tables in a file, with checksums: what comes back is what was written, or nothing.
#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"
#include "sky/bruneton/tables.h"

namespace skylapse::sky::bruneton {

/// Fills the rows between the sun nodes, source and ground's irradiance, from the rows at the nodes
/// (upsample_suns of the stored floats, rounded). What precomputation ends with: tables made so are
/// stored by their nodes alone, an eighth of the size or less.
void refill_sun_rows(Tables& tables);

/// Writes `tables` under `key` (64 hexadecimal digits that name everything which shaped them). The
/// file appears whole, by rename; concurrent writers of one path do not disturb each other. Rows
/// that refill_sun_rows() gives back to the bit are left out; otherwise all are kept. Errors:
/// write_failed with the system's reason; internal if a number is not finite.
Status write_tables(const std::filesystem::path& path, const std::string& key,
                    const Tables& tables);

/// The tables in `path` if they stand under `key`, have the sizes that `settings` and the bands of
/// `medium` ask for, and every checksum is right; they carry `medium` and `settings`.
std::optional<Tables> read_tables(const std::filesystem::path& path, const std::string& key,
                                  const atmosphere::Medium& medium, const Settings& settings);

/// Deletes temporaries of writers that died, an hour after their last sign of life.
void remove_stale_table_temporaries(const std::filesystem::path& folder);

}  // namespace skylapse::sky::bruneton
