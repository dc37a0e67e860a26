#include "plan/work_list.h"

#include <fmt/format.h>

#include <array>
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

/// The environment variables of one kind of array job; "" where it has none.
struct ArrayVariables {
  const char *id, *count, *first, *step;
};
constexpr std::array<ArrayVariables, 2> kArrayVariables{
    {{"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
      "SLURM_ARRAY_TASK_STEP"},
     {"JOB_COMPLETION_INDEX", "JOB_COMPLETION_COUNT", "", ""}}};

/// Part (id - first) / step + 1 of `count`; nothing unless that is a part.
std::optional<Shard> array_part(const std::string& id, const std::string& count,
                                const std::string& first, const std::string& step) {
  constexpr long kLargest = 1'000'000'000;
  const auto i = whole_number(id), n = whole_number(count), from = whole_number(first),
             by = whole_number(step);
  if (!i || !n || !from || !by || *i > kLargest || *from < 0 || *i < *from || *by < 1) return {};
  if ((*i - *from) % *by != 0) return {};
  const auto shard = checked(id, (*i - *from) / *by + 1, n);
  return shard ? std::optional(*shard) : std::nullopt;
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
  for (const ArrayVariables& names : kArrayVariables) {
    const auto id = variable(names.id), count = variable(names.count);
    if (!id || !count) continue;
    const auto value_or = [&](const char* name, const char* absent) {
      return *name == '\0' ? absent : variable(name).value_or(absent);
    };
    const std::string first = value_or(names.first, "0"), step = value_or(names.step, "1");
    const auto shard = array_part(*id, *count, first, step);
    if (shard) return std::optional(*shard);
    std::string message = fmt::format("{}={}, {}={}", names.id, *id, names.count, *count);
    if (*names.first != '\0')
      message += fmt::format(", {}={}, {}={}", names.first, first, names.step, step);
    return Error{ErrorCode::invalid_input,
                 message + " name no part of an array job",
                 {},
                 "number the array evenly, as 0-7 or 0-14:2, or give --shard PART/PARTS"};
  }
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
