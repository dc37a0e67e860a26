#pragma once
// What the fuzzers feed with any bytes at all, and the laws each reader must keep for them. A
// broken law prints what was broken and aborts, so that libFuzzer keeps the input; the same
// functions replay the corpus as an ordinary test.
#include <span>
#include <string_view>

namespace skylapse::fuzz {

/// A whole job: parse_job on the text before the first NUL byte; "key=value" overrides follow,
/// each after a NUL. Laws: an accepted job has finite numbers within what the keys allow and is
/// accepted again; a refused one has errors that stand in their line, in valid UTF-8 without
/// control characters, and print.
void job(std::string_view bytes);

/// An atmosphere file. Laws: as for a job; accepted air makes a medium or is refused with words.
void atmosphere(std::string_view bytes);

/// YAML alone, with small limits. Laws: the tree keeps the limits and its places lie in the text.
void yaml(std::string_view bytes);

/// One quantity; the first byte picks the dimension. Laws: values are finite and written out in any
/// unit of the dimension they are read back; problems mark a part of the text.
void quantity(std::string_view bytes);

/// Dates, ranges and time expressions. Laws: what is accepted is a day or time of the documented
/// range and written out again means the same.
void time_expression(std::string_view bytes);

/// A batch table. Laws: rows are as wide as the header, every cell's place lies in its line, and
/// rows written by csv_line are read back.
void batch_csv(std::string_view bytes);

/// An image file of any format. Laws: a picture within the limits that were set and as large as it
/// says, or an error with words; never a crash, whatever the libraries behind do.
void image(std::string_view bytes);

/// A manifest of skylapse. Laws: a refusal is printable; every file it lists stays below its folder
/// and has an entry that is JSON.
void manifest(std::string_view bytes);

/// A golden.json. Laws: as for a manifest; every name has variants of different renderers.
void golden(std::string_view bytes);

struct Target {
  std::string_view name;  // also of its folder of the corpus
  void (*run)(std::string_view bytes);
};
std::span<const Target> targets();

}  // namespace skylapse::fuzz
