#pragma once
// Files that appear whole or not at all.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::output {

/// Writes `bytes` to `path`, making missing parent folders. A reader sees the old file, or none, or
/// the whole new one: the bytes go to a nameless file (O_TMPFILE) that is linked in when complete,
/// or, where the file system has no such thing, to a hidden one that is renamed. SIGKILL leaves at
/// most a hidden temporary, see remove_stale_temporaries. Not synced: a power cut may lose the
/// file. Errors: ErrorCode::write_failed with the path, the system's reason and what to do.
Status write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The whole file. Missing or unreadable: ErrorCode::missing_input.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);

/// Name of a hidden temporary beside `path` that no other process or call uses:
/// ".<name>.skylapse-<machine>-<pid>-<start>-<n>.tmp".
std::filesystem::path temporary_beside(const std::filesystem::path& path);

/// Makes the folder that `path` lies in.
Status make_parent_folders(const std::filesystem::path& path);

/// Renames a finished temporary to `path`; removes it if that fails.
Status publish(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Deletes temporaries that processes which no longer run left in `folder` (not below it).
/// Those of other machines that share the folder are left alone for a day. Returns their number.
size_t remove_stale_temporaries(const std::filesystem::path& folder);

/// write_failed for `path` with the text of `error_number` and a hint that fits it.
Error write_error(const std::filesystem::path& path, int error_number);

}  // namespace skylapse::output
