#include "sky/sun_disc_splat.h"

#include <cmath>

namespace skylapse::sky {
namespace {

uint64_t key_of(int tile_x, int tile_y) {
  return (uint64_t{static_cast<uint32_t>(tile_x)} << 32) | static_cast<uint32_t>(tile_y);
}

// Below this total share a packet's neighbours are taken to have no room at all.
constexpr double kNoRoom = 1e-6;

}  // namespace

SplatPlane::SplatPlane(const image::Chart& chart, double tent, std::optional<Angle> horizon)
    : chart_(chart), tent_(tent), horizon_(horizon) {}

double SplatPlane::share(int x, int y) const {
  if (!image::fills_pixel(chart_, x, y)) return 0;
  if (!horizon_) return 1;
  const auto sample = image::chart_sample(chart_, {x + 0.5, y + 0.5});
  if (!sample) return 0;
  return image::horizon_coverage(elevation(image::to_enu(chart_.camera, sample->direction)),
                                 sample->sr_per_pixel * sr, *horizon_);
}

SplatPlane::Pixel& SplatPlane::pixel_at(int x, int y) {
  const uint64_t key = key_of(x >> kTileBits, y >> kTileBits);
  if (last_tile_ == nullptr || key != last_key_) {
    auto& tile = tiles_[key];
    if (!tile) tile = std::make_unique<Tile>();
    last_tile_ = tile.get();
    last_key_ = key;
  }
  Pixel& p = (*last_tile_)[(y & (kTileSide - 1)) * kTileSide + (x & (kTileSide - 1))];
  if (p.share < 0) p.share = static_cast<float>(share(x, y));
  return p;
}

SplatPlane::Pixel* SplatPlane::best_neighbour(int x, int y) {
  Pixel* best = nullptr;
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u) {
      Pixel& p = pixel_at(u, v);
      if (p.share > (best ? best->share : 0.0F)) best = &p;
    }
  return best;
}

void SplatPlane::add(const LightPacket& packet) {
  const auto lay = [&](Pixel& p, double part) {
    p.flux += part * packet.flux;
    p.weight += part * packet.weight;
  };
  const double u = packet.position.x - 0.5, v = packet.position.y - 0.5;
  const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
  const double fx = u - x, fy = v - y;
  const int right = fx >= 0.5, below = fy >= 0.5;  // of the pixel that holds the packet
  std::array<Pixel*, 4> pixels{};
  std::array<double, 4> parts{};
  double total = 0;
  for (int k = 0; k < 4; ++k) {
    const int dx = k % 2, dy = k / 2;
    const double tent = (dx != 0 ? fx : 1 - fx) * (dy != 0 ? fy : 1 - fy);
    const double own = dx == right && dy == below ? 1 : 0;
    parts[k] = tent_ * tent + (1 - tent_) * own;
    if (parts[k] == 0) continue;
    pixels[k] = &pixel_at(x + dx, y + dy);
    parts[k] *= pixels[k]->share;
    total += parts[k];
  }
  if (total < kNoRoom) {
    if (Pixel* p = best_neighbour(x + right, y + below)) lay(*p, 1);
    return;
  }
  for (int k = 0; k < 4; ++k)
    if (pixels[k]) lay(*pixels[k], parts[k] / total);
}

void SplatPlane::collect(std::vector<PixelLight>& out) const {
  for (const auto& [key, tile] : tiles_)
    for (int k = 0; k < kTileSide * kTileSide; ++k) {
      const Pixel& p = (*tile)[k];
      if (p.weight == 0) continue;
      const int x = (static_cast<int32_t>(key >> 32) << kTileBits) + k % kTileSide;
      const int y = (static_cast<int32_t>(key) << kTileBits) + k / kTileSide;
      const auto sample = image::chart_sample(chart_, {x + 0.5, y + 0.5});
      const auto place =
          image::position_of(chart_.camera, image::to_enu(chart_.camera, sample->direction));
      const int px = std::min(static_cast<int>(place->x), chart_.camera.width - 1);
      const int py = std::min(static_cast<int>(place->y), chart_.camera.height - 1);
      out.push_back({px, py, p.flux, p.weight});
    }
}

}  // namespace skylapse::sky
