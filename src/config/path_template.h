#pragma once
// Names of output files: text, tokens in braces, and #### for the frame number.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/source_text.h"

namespace skylapse::config {

/// Names of all tokens, without braces.
const std::vector<std::string>& path_token_names();

/// The tokens that occur in a template, without braces; "#" for a run of them.
std::vector<std::string> tokens_in(std::string_view path);

/// What is wrong with a template as such: unknown or open tokens, two frame numbers, control
/// characters, no file name. The part that is wrong is marked.
std::optional<Problem> path_template_problem(std::string_view path);

/// The path may lead out of the folder it is relative to: it is absolute, or ".." climbs above it.
bool leaves_folder(std::string_view path);

/// One spelling for each path: without "." and repeated "/", and ".." only in front. Judged by the
/// letters alone; what is a link on disk does not count.
std::string normalised_path(const std::string& path);

/// Whether a normalised path, relative to the output folder, is one of the program's own records
/// there or lies below one: manifest.json and .skylapse.
bool is_reserved_path(std::string_view path);

/// The ending in small letters, without the point; empty if there is none.
std::string extension_of(std::string_view path);

}  // namespace skylapse::config
