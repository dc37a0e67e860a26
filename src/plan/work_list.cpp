#include "plan/work_list.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <set>

namespace skylapse::plan {
namespace {

std::optional<long> whole_number(std::string_view text) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return {};
  return value;
}

Error bad_shard(const std::string& text) {
  return {ErrorCode::invalid_input,
          fmt::format("'{}' is no shard", text),
          {},
          "write PART/PARTS, for example 2/8; PART runs from 1 to PARTS"};
}

Result<Shard> checked(const std::string& text, std::optional<long> part,
                      std::optional<long> parts) {
  if (!part || !parts || *parts < 1 || *parts > 1'000'000 || *part < 1 || *part > *parts)
    return bad_shard(text);
  return Shard{int(*part), int(*parts)};
}

/// One piece of a frame list: first, last and step.
struct Piece {
  long first, last, step;
};

std::optional<Piece> parse_piece(std::string_view text, long count) {
  long step = 1;
  if (const size_t x = text.find('x'); x != std::string_view::npos) {
    const auto value = whole_number(text.substr(x + 1));
    if (!value || *value < 1) return {};
    step = *value;
    text = text.substr(0, x);
  }
  const size_t dash = text.find('-');
  const auto first = whole_number(text.substr(0, dash));
  if (!first) return {};
  if (dash == std::string_view::npos) return Piece{*first, *first, step};
  const std::string_view rest = text.substr(dash + 1);
  const auto last = rest.empty() ? std::optional(count) : whole_number(rest);
  if (!last) return {};
  return Piece{*first, *last, step};
}

}  // namespace

Result<Shard> parse_shard(const std::string& text) {
  const size_t slash = text.find('/');
  if (slash == std::string::npos) return bad_shard(text);
  return checked(text, whole_number(text.substr(0, slash)), whole_number(text.substr(slash + 1)));
}

Result<std::optional<Shard>> shard_from_environment() {
  const auto variable = [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value ? std::optional<std::string>(value) : std::nullopt;
  };
  const auto read = [](const std::string& id, const std::string& count,
                       long first) -> Result<std::optional<Shard>> {
    const auto index = whole_number(id);
    auto shard = checked(id + " of " + count, index ? std::optional(*index - first + 1) : index,
                         whole_number(count));
    if (!shard) return shard.error();
    return std::optional(*shard);
  };
  if (const auto id = variable("SLURM_ARRAY_TASK_ID"))
    if (const auto count = variable("SLURM_ARRAY_TASK_COUNT"))
      return read(*id, *count,
                  whole_number(variable("SLURM_ARRAY_TASK_MIN").value_or("0")).value_or(0));
  if (const auto id = variable("JOB_COMPLETION_INDEX"))
    if (const auto count = variable("JOB_COMPLETION_COUNT")) return read(*id, *count, 0);
  return std::optional<Shard>{};
}

Result<std::vector<long>> parse_frame_list(const std::string& text, long count) {
  std::set<long> frames;
  size_t begin = 0;
  while (begin <= text.size()) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    const auto piece = parse_piece(std::string_view(text).substr(begin, comma - begin), count);
    if (!piece || piece->first < 1 || piece->last < piece->first || piece->last > count)
      return Error{
          ErrorCode::invalid_input,
          fmt::format("'{}' is no list of frames of this job", text),
          {},
          fmt::format("allowed: numbers 1 to {} as 7, 10-50, 10-50x5, 10-, joined by ','", count)};
    for (long i = piece->first; i <= piece->last; i += piece->step) frames.insert(i);
    begin = comma + 1;
  }
  return std::vector<long>(frames.begin(), frames.end());
}

std::vector<long> frames_of_shard(const std::vector<long>& frames, Shard shard) {
  std::vector<long> mine;
  for (size_t i = shard.part - 1; i < frames.size(); i += shard.parts) mine.push_back(frames[i]);
  return mine;
}

}  // namespace skylapse::plan
