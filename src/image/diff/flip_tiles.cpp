#include "image/diff/flip_tiles.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "core/parallel.h"

namespace skylapse::image::flip_internal {
namespace {

/// Large enough that the rows above and below a tile, which are filtered again for the next, are
/// few; small enough that filtered rows stay in the cache and a thread needs some MB.
constexpr int kTileWidth = 256, kTileHeight = 128;

struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

int round_up(int count) { return (count + kPixelBlock - 1) / kPixelBlock * kPixelBlock; }

/// Floats on boundaries of cache lines.
class AlignedFloats {
 public:
  explicit AlignedFloats(size_t count) : values_(count + kAlign) {}
  float* data() {
    void* p = values_.data();
    size_t space = values_.size() * sizeof(float);
    return static_cast<float*>(std::align(kAlign * sizeof(float), 1, p, space));
  }

 private:
  static constexpr size_t kAlign = 16;
  std::vector<float> values_;
};

/// Works on one tile after another.
class TileWorker {
 public:
  explicit TileWorker(const FlipJob& job);
  /// Writes the tile's part of the map.
  void run(const Tile& tile, std::vector<float>& map);

 private:
  /// Rows filtered along x, which those along y are made from.
  enum Level { kLuminance, kRedGreen, kBlueYellow1, kBlueYellow2, kSmooth, kEdge, kPoint, kLevels };

  float* colour_row(int picture, int channel, int row) {
    return colours_.data() +
           (size_t(picture * 3 + channel) * size_t(rows_) + size_t(row)) * stride_;
  }
  /// Row of the ring; `part` 0: mean, 1: difference.
  float* level_row(int level, int part, int row) {
    return levels_.data() +
           (size_t(level * 2 + part) * size_t(ring_) + size_t(row % ring_)) * size_t(kTileWidth);
  }
  bool load(const Tile& tile, int row);
  void load_row(const Picture& picture, int picture_number, const Tile& tile, int row);
  void run_exposure(float scale, int first, int last);
  void oppose(int row, float scale);
  void filter_along_x(int row);
  void filter_along_y(int row, float* worst);

  const FlipJob& job_;
  int radius_, rows_, ring_;
  size_t stride_;
  int columns_ = 0;  // of this tile, padded
  RationalCurve curve_;
  std::vector<const float*> around_;  // places or rows about the one that is filtered
  AlignedFloats colours_, levels_, opponent_, filtered_, worst_;
};

TileWorker::TileWorker(const FlipJob& job)
    : job_(job),
      radius_(job.filters.radius),
      rows_(kTileHeight + 2 * radius_),
      ring_(2 * radius_ + 1),
      stride_(size_t(round_up(kTileWidth + 2 * radius_))),
      curve_(curve_of(job.tone_mapper)),
      around_(size_t(ring_)),
      colours_(6 * size_t(rows_) * stride_),
      levels_(2 * kLevels * size_t(ring_) * kTileWidth),
      opponent_(6 * stride_),
      filtered_(2 * FilteredRows::kFields * size_t(kTileWidth)),
      worst_(size_t(kTileHeight) * kTileWidth) {}

void TileWorker::load_row(const Picture& picture, int picture_number, const Tile& tile, int row) {
  const int y = std::clamp(tile.y - radius_ + row, 0, picture.height - 1);
  const float* source = picture.pixel(0, y);
  const int channels = picture.channel_count(), count = round_up(columns_ + 2 * radius_);
  const int first = tile.x - radius_;
  for (int channel = 0; channel < 3; ++channel) {
    const float* from = source + (picture.colour_count() == 3 ? channel : 0);
    float* to = colour_row(picture_number, channel, row);
    for (int i = 0; i < count; ++i) {
      const int x = std::clamp(first + i, 0, picture.width - 1);
      to[i] = light_of(from[size_t(x) * size_t(channels)]);
    }
    if (!job_.scales.empty()) continue;
    for (int i = 0; i < count; ++i) to[i] = std::min(to[i], 1.0f);
    job_.kernels.decode_srgb(to, count);
  }
}

/// Whether the pictures are equal in that row of the tile.
bool TileWorker::load(const Tile& tile, int row) {
  load_row(job_.first, 0, tile, row);
  load_row(job_.second, 1, tile, row);
  const size_t bytes = size_t(columns_ + 2 * radius_) * sizeof(float);
  for (int channel = 0; channel < 3; ++channel)
    if (std::memcmp(colour_row(0, channel, row), colour_row(1, channel, row), bytes) != 0)
      return false;
  return true;
}

/// The opponent colours of a row.
void TileWorker::oppose(int row, float scale) {
  const int count = round_up(columns_ + 2 * radius_);
  ColourRows in;
  OpponentRows out;
  for (int channel = 0; channel < 3; ++channel) {
    in.first[size_t(channel)] = colour_row(0, channel, row);
    in.second[size_t(channel)] = colour_row(1, channel, row);
    out.mean[size_t(channel)] = opponent_.data() + size_t(2 * channel) * stride_;
    out.difference[size_t(channel)] = opponent_.data() + size_t(2 * channel + 1) * stride_;
  }
  if (job_.scales.empty())
    job_.kernels.oppose(in, count, out);
  else if (job_.tone_mapper == ToneMapper::reinhard)
    job_.kernels.expose_reinhard(in, scale, count, out);
  else
    job_.kernels.expose(in, curve_, scale, count, out);
}

void TileWorker::filter_along_x(int row) {
  const Filters& f = job_.filters;
  for (int part = 0; part < 2; ++part) {
    const auto along = [&](int channel, const Taps& taps, Level level) {
      const float* middle = opponent_.data() + size_t(2 * channel + part) * stride_ + radius_;
      for (int k = -taps.radius(); k <= taps.radius(); ++k)
        around_[size_t(radius_ + k)] = middle + k;
      const float* const* rows = around_.data() + radius_;
      float* out = level_row(level, part, row);
      if (level == kEdge)
        job_.kernels.filter_odd(rows, taps.weight.data(), taps.radius(), columns_, out);
      else
        job_.kernels.filter_even(rows, taps.weight.data(), taps.radius(), columns_, false, out);
    };
    along(0, f.luminance, kLuminance);
    along(1, f.red_green, kRedGreen);
    along(2, f.blue_yellow[0], kBlueYellow1);
    along(2, f.blue_yellow[1], kBlueYellow2);
    along(0, f.smooth, kSmooth);
    along(0, f.edge, kEdge);
    along(0, f.point, kPoint);
  }
}

/// Errors of row `row`, with its neighbours in the ring.
void TileWorker::filter_along_y(int row, float* worst) {
  const Filters& f = job_.filters;
  const Kernels& kernels = job_.kernels;
  FilteredRows filtered;
  for (int part = 0; part < 2; ++part) {
    const auto rows_of = [&](Level level) {
      for (int k = -radius_; k <= radius_; ++k)
        around_[size_t(radius_ + k)] = level_row(level, part, row + k);
      return around_.data() + radius_;
    };
    const auto place = [&](FilteredRows::Field field) {
      float* out = filtered_.data() + size_t(field * 2 + part) * kTileWidth;
      (part == 0 ? filtered.mean : filtered.difference)[size_t(field)] = out;
      return out;
    };
    const auto even = [&](Level level, const Taps& taps, FilteredRows::Field field,
                          bool add = false) {
      kernels.filter_even(rows_of(level), taps.weight.data(), taps.radius(), columns_, add,
                          place(field));
    };
    even(kLuminance, f.luminance, FilteredRows::luminance);
    even(kRedGreen, f.red_green, FilteredRows::red_green);
    even(kBlueYellow1, f.blue_yellow_weighted[0], FilteredRows::blue_yellow);
    even(kBlueYellow2, f.blue_yellow_weighted[1], FilteredRows::blue_yellow, true);
    even(kEdge, f.smooth, FilteredRows::edge_x);
    kernels.filter_odd(rows_of(kSmooth), f.edge.weight.data(), f.edge.radius(), columns_,
                       place(FilteredRows::edge_y));
    even(kPoint, f.smooth, FilteredRows::point_x);
    even(kSmooth, f.point, FilteredRows::point_y);
  }
  kernels.errors(filtered, columns_, worst);
}

/// Rows first..last of the tile.
void TileWorker::run_exposure(float scale, int first, int last) {
  for (int row = first; row <= last + 2 * radius_; ++row) {
    oppose(row, scale);
    filter_along_x(row);
    const int finished = row - 2 * radius_;
    if (finished >= first)
      filter_along_y(finished + radius_, worst_.data() + size_t(finished) * kTileWidth);
  }
}

void TileWorker::run(const Tile& tile, std::vector<float>& map) {
  columns_ = round_up(tile.width);
  const int rows = tile.height + 2 * radius_;
  int first_changed = rows, last_changed = -1;
  for (int row = 0; row < rows; ++row) {
    if (load(tile, row)) continue;
    first_changed = std::min(first_changed, row);
    last_changed = row;
  }
  // Errors are 0, to the last bit, where all that the filters see is equal.
  std::fill_n(worst_.data(), size_t(kTileHeight) * kTileWidth, 0.0f);
  const int first = std::max(0, first_changed - 2 * radius_);
  const int last = std::min(tile.height - 1, last_changed);
  if (first <= last) {
    if (job_.scales.empty()) run_exposure(1, first, last);
    for (const float scale : job_.scales) run_exposure(scale, first, last);
  }
  for (int row = 0; row < tile.height; ++row)
    std::copy_n(worst_.data() + size_t(row) * kTileWidth, tile.width,
                map.data() + size_t(tile.y + row) * size_t(job_.first.width) + size_t(tile.x));
}

}  // namespace

void fill_map(const FlipJob& job, std::vector<float>& map) {
  const int width = job.first.width, height = job.first.height;
  const int across = (width + kTileWidth - 1) / kTileWidth;
  const int down = (height + kTileHeight - 1) / kTileHeight;
  map.resize(job.first.pixel_count());
  parallel_for_ranges(size_t(across) * size_t(down), 1, [&](size_t begin, size_t end) {
    TileWorker worker(job);
    for (size_t i = begin; i < end; ++i) {
      Tile tile{int(i % size_t(across)) * kTileWidth, int(i / size_t(across)) * kTileHeight};
      tile.width = std::min(kTileWidth, width - tile.x);
      tile.height = std::min(kTileHeight, height - tile.y);
      worker.run(tile, map);
    }
  });
}

}  // namespace skylapse::image::flip_internal
