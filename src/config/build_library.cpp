// Outputs that are made of all frames.
#include <fmt/format.h>

#include "config/output_section.h"

namespace skylapse::config {
namespace {

const OutputItem::Endings kMovieEndings{
    {"mp4", "mp4"}, {"mkv", "mkv"}, {"mov", "mov"}, {"webm", "webm"}};

OutputItem::Endings endings_of(LibraryKind kind) {
  if (kind == LibraryKind::gallery) return {{"html", "html"}};
  return {{"png", "png"}, {"jpg", "jpg"}, {"jpeg", "jpg"}};
}

void check_movie_names(const OutputItem& item) {
  if (item.has_token("#"))
    item.refuse_path("a movie has no frame number in its name",
                     "allowed: {site} {date} {camera} {turbidity} {albedo}");
  item.refuse_tokens({"time", "sun_elevation", "half", "face", "level"}, "differs within a movie",
                     "allowed: {site} {date} {camera} {turbidity} {albedo}");
  const auto need = [&](size_t count, std::string_view token, std::string_view what) {
    if (count > 1 && !item.has_token(token))
      item.refuse_path(fmt::format("{} {} would be written to one movie", count, what),
                       fmt::format("add the token {{{}}} to the name", token));
  };
  need(item.job.sites.size(), "site", "locations");
  need(item.job.cameras.size(), "camera", "cameras");
  need(item.job.air.turbidity.size(), "turbidity", "turbidities");
  need(item.job.air.ground_albedo.size(), "albedo", "ground albedos");
}

}  // namespace

std::optional<MovieOutput> build_movie(const OutputItem& item) {
  if (item.path.empty() || !item.allowed_place()) return std::nullopt;
  if (!item.format_of(kMovieEndings, "movie")) return std::nullopt;
  MovieOutput out;
  out.path = item.spanned_path();
  out.frames_per_second = item.section.get<double>("fps").value_or(out.frames_per_second);
  if (const auto crf = item.section.get<long>("crf")) out.crf = int(*crf);
  out.display = item.section.get<std::string>("display");
  out.view = item.section.get<std::string>("view").value_or("");
  out.view_span = item.span_of_first({"view", "display"});
  check_movie_names(item);
  return out;
}

std::optional<LibraryOutput> build_library(const OutputItem& item, LibraryKind kind) {
  if (item.path.empty() || !item.allowed_place()) return std::nullopt;
  const auto format = item.format_of(endings_of(kind), item.path_key);
  if (!format) return std::nullopt;
  LibraryOutput out;
  out.kind = kind;
  out.path = item.spanned_path();
  out.format = *format;
  if (kind == LibraryKind::sheet) out.columns = int(item.section.get<long>("columns").value_or(0));
  if (!item.tokens.empty())
    item.refuse_path("one file for the whole job has no tokens in its name",
                     fmt::format("such as {}", item.section.spec->keys[0].example));
  return out;
}

}  // namespace skylapse::config
