#pragma once
// One item of `outputs` on its way to an output: what all kinds share.
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "config/build_job.h"

namespace skylapse::config {

/// An item and the job around it, complete but for its outputs.
struct OutputItem {
  OutputItem(const Section& section, const JobConfig& job, const ReadContext& context);

  const Section& section;
  std::string_view path_key;  // the first key of its section
  const JobConfig& job;
  const ReadContext& context;
  std::string path;  // normalised; empty if it was wrong
  std::vector<std::string> tokens;

  [[nodiscard]] bool has_token(std::string_view name) const;
  [[nodiscard]] Spanned<std::string> spanned_path() const;
  /// The value of the first of these keys that is written, else the path.
  [[nodiscard]] SourceSpan span_of_first(std::initializer_list<std::string_view> keys) const;
  void refuse_path(std::string message, std::string hint) const;
  void no_meaning(std::string_view key, std::string hint) const;

  /// The path lies where outputs may; else that is reported.
  [[nodiscard]] bool allowed_place() const;
  /// The format by the ending of the name, as (ending, format); else that is reported, with `hint`
  /// or the endings that are allowed.
  using Endings = std::vector<std::pair<std::string_view, std::string_view>>;
  [[nodiscard]] std::optional<std::string> format_of(const Endings& endings, std::string_view what,
                                                     std::string hint = {}) const;
  /// Reports names by which the frames of a day, or of all days, would be one file.
  void check_names_of_frames() const;
  /// Reports these tokens; `hint` says what is allowed instead.
  void refuse_tokens(std::initializer_list<std::string_view> names, std::string_view why,
                     std::string_view hint) const;
};

std::optional<ImageOutput> build_image(const OutputItem& item);
std::optional<ProductOutput> build_product(const OutputItem& item, ProductKind kind);
std::optional<MovieOutput> build_movie(const OutputItem& item);
std::optional<LibraryOutput> build_library(const OutputItem& item, LibraryKind kind);

/// Whether an image shows display values; else it holds scene-linear numbers.
inline bool is_display_referred(const ImageOutput& image) { return image.view || image.display; }

}  // namespace skylapse::config
