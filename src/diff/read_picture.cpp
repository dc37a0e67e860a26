#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include "core/sha256.h"
#include "diff/facts.h"
#include "diff/facts_of_file.h"
#include "diff/stored_type.h"

namespace skylapse::diff {
namespace {

using image::Picture;
using image::SampleStorage;
using output::ReadImage;

constexpr int kMostParts = 64;

/// Colours, then alpha, then all others by name.
int rank_of(const std::string& channel) {
  constexpr std::array<std::string_view, 5> kFirst{"R", "G", "B", "Y", "A"};
  return int(std::ranges::find(kFirst, channel) - kFirst.begin());
}

/// For each place the channel of the file that belongs there. Channels of one name keep their
/// order.
std::vector<size_t> canonical_order(const std::vector<std::string>& channels) {
  std::vector<size_t> order(channels.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, [&](size_t a, size_t b) {
    const int rank_a = rank_of(channels[a]), rank_b = rank_of(channels[b]);
    return rank_a != rank_b ? rank_a < rank_b : channels[a] < channels[b];
  });
  return order;
}

template <class T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<size_t>& order) {
  std::vector<T> sorted;
  for (const size_t i : order) sorted.push_back(values[i]);
  return sorted;
}

/// In place, pixel by pixel.
void reorder_samples(std::vector<float>& samples, const std::vector<size_t>& order) {
  if (std::ranges::is_sorted(order)) return;
  std::vector<float> pixel(order.size());
  for (size_t i = 0; i < samples.size(); i += order.size()) {
    for (size_t c = 0; c < order.size(); ++c) pixel[c] = samples[i + order[c]];
    std::ranges::copy(pixel, samples.begin() + ptrdiff_t(i));
  }
}

std::string digest_of(const ReadImage& part) {
  Sha256 sum;
  for (const std::string& channel : part.channels) sum.update(std::as_bytes(std::span(channel)));
  sum.update(std::as_bytes(std::span(part.samples)));
  return std::to_string(part.width) + "x" + std::to_string(part.height) + " " +
         sum.hex().substr(0, 16);
}

/// The channels of a part beside those of the pictures before it.
void join(ReadImage& whole, const ReadImage& part, const std::string& name) {
  const size_t before = whole.channels.size(), more = part.channels.size();
  std::vector<float> joined;
  joined.reserve(whole.samples.size() + part.samples.size());
  for (size_t i = 0; i * before < whole.samples.size(); ++i) {
    const auto old = whole.samples.begin() + ptrdiff_t(i * before);
    const auto added = part.samples.begin() + ptrdiff_t(i * more);
    joined.insert(joined.end(), old, old + ptrdiff_t(before));
    joined.insert(joined.end(), added, added + ptrdiff_t(more));
  }
  whole.samples = std::move(joined);
  for (size_t c = 0; c < more; ++c) {
    whole.channels.push_back(name + "." + part.channels[c]);
    whole.storage.push_back(part.storage[c]);
  }
}

/// What is left of the limits for one more part.
ReadLimits remaining(const ReadLimits& limits, const ReadImage& whole) {
  ReadLimits left = limits;
  const uint64_t used = sizeof(float) * whole.samples.size();
  left.bytes = used < limits.bytes ? limits.bytes - used : 0;
  return left;
}

Status add_parts(const output::ImageIo& io, const std::string& path, const ReadLimits& limits,
                 ReadImage& whole, std::vector<std::string>& apart) {
  if (whole.parts > kMostParts)
    return Error{.code = ErrorCode::missing_input,
                 .message = "cannot read image '" + path + "': it has " +
                            std::to_string(whole.parts) +
                            " parts (allowed: " + std::to_string(kMostParts) + ")"};
  for (int i = 1; i < whole.parts; ++i) {
    auto part = io.read(path, i, remaining(limits, whole));
    if (!part) return part.error();
    const bool fits = part->width == whole.width && part->height == whole.height &&
                      int(whole.channels.size() + part->channels.size()) <= limits.channels;
    if (fits)
      join(whole, *part, part->part_name.empty() ? "part" + std::to_string(i) : part->part_name);
    else
      apart.push_back(digest_of(*part));
  }
  return Done{};
}

/// The coarsest of the colours.
SampleStorage storage_of_colours(const ReadImage& image) {
  const bool rgb = image.channels.size() >= 3 && image.channels[0] == "R";
  const auto end = image.storage.begin() + (rgb ? 3 : 1);
  return *std::min_element(image.storage.begin(), end, [](const auto& a, const auto& b) {
    return precision_bits(a) < precision_bits(b);
  });
}

}  // namespace

Result<ReadPicture> read_picture(const std::string& path, const ReadLimits& limits,
                                 const nlohmann::json* manifest_entry) {
  const auto io = output::open_image_io();
  if (!io) return io.error();
  auto read = (*io)->read(path, 0, limits);
  if (!read) return read.error();
  ReadImage whole = *std::move(read);
  ReadPicture out;
  out.facts = facts_of_file(whole, manifest_entry);
  if (const Status added = add_parts(**io, path, limits, whole, out.facts.parts_apart); !added)
    return added.error();
  const auto order = canonical_order(whole.channels);
  whole.channels = in_order(whole.channels, order);
  whole.storage = in_order(whole.storage, order);
  reorder_samples(whole.samples, order);
  out.picture.width = whole.width;
  out.picture.height = whole.height;
  out.picture.storage = storage_of_colours(whole);
  out.picture.display_referred =
      out.picture.storage.kind == SampleStorage::Kind::integer && whole.format != "openexr";
  out.picture.channels = whole.channels;
  out.picture.samples = std::move(whole.samples);
  out.facts.file.path = path;
  out.facts.file.sample_type = type_name(out.picture.storage);
  out.facts.file.channels = std::move(whole.channels);
  out.facts.storage = std::move(whole.storage);
  return out;
}

}  // namespace skylapse::diff
