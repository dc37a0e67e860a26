#pragma once
// Where small packets of light are laid onto pixels.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "image/camera/chart.h"

namespace skylapse::sky {

/// A small piece of the disc: its flux in the picture's channels, and a weight of its own that is
/// never negative (its solid angle), by which small corrections are shared out.
struct LightPacket {
  image::PixelPosition position;
  glm::dvec3 flux{0};
  double weight = 0;
};

/// Flux collected by one pixel of the image.
struct PixelLight {
  int x = 0;
  int y = 0;
  glm::dvec3 flux{0};
  double weight = 0;
};

/// Collects packets on the pixels of one chart. A packet is shared among the four pixels whose
/// centres are nearest, by a tent (bilinear) or, for discs of many pixels, less and less so:
/// `tent` = 1 keeps a packet's place exactly, 0 gives everything to the pixel it lies in.
/// Pixels outside the picture get nothing; with a `horizon`, pixels below the horizon get nothing
/// and those it crosses their share of the sky: the others take over.
class SplatPlane {
 public:
  SplatPlane(const image::Chart& chart, double tent, std::optional<Angle> horizon);

  void add(const LightPacket& packet);

  /// Appends the pixels that got light, at the places where the image holds them: beyond a cube
  /// face's edge, a map's seam or a pole that is another face, the other side.
  void collect(std::vector<PixelLight>& out) const;

 private:
  struct Pixel {
    glm::dvec3 flux{0};
    double weight = 0;
    float share = -1;  // of packets it may take, 0..1; negative: not yet known
  };
  static constexpr int kTileBits = 4;
  static constexpr int kTileSide = 1 << kTileBits;
  using Tile = std::array<Pixel, kTileSide * kTileSide>;

  Pixel& pixel_at(int x, int y);
  double share(int x, int y) const;
  Pixel* best_neighbour(int x, int y);

  image::Chart chart_;
  double tent_;
  std::optional<Angle> horizon_;
  std::unordered_map<uint64_t, std::unique_ptr<Tile>> tiles_;
  uint64_t last_key_ = 0;
  Tile* last_tile_ = nullptr;
};

}  // namespace skylapse::sky
