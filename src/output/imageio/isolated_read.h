#pragma once
// Reading where a crash of a library ends nothing but the reading.
#include <functional>
#include <shared_mutex>
#include <string>

#include "output/image_writer.h"

namespace skylapse::output::imageio {

/// Held shared by whoever reads in this process, and alone while a child is made: no lock of a
/// library is then taken over into it.
std::shared_mutex& library_in_use();

/// Calls `read` in a child process with bounded memory and 10 s of processor time, and hands its
/// result over. Readers of seldom formats crash on damaged files (OpenImageIO 2.4 on DPX, for one).
/// Errors: those of `read`; missing_input where the child crashed or went beyond its bounds.
Result<ReadImage> read_in_child(const std::string& path, const ReadLimits& limits,
                                const std::function<Result<ReadImage>()>& read);

}  // namespace skylapse::output::imageio
