#include "sky/atmosphere/standard_air.h"

#include <array>
#include <cmath>
#include <limits>

namespace skylapse::sky::atmosphere {
namespace {

/// A piece begins at `bottom_km` with the standard's density and ends with that of the next piece;
/// the two numbers between were fitted for the least greatest relative error.
struct Piece {
  double bottom_km, density, inverse_scale_height_per_km, slope_per_km;
};

constexpr std::array kPieces{
    Piece{0.000, 1, 0.059047, 0.0259487},
    Piece{11.019, 0.2970785, 0.157544, -4.30135e-05},
    Piece{20.063, 0.07186659, 0.166385, -0.000117156},
    Piece{32.162, 0.01079576, 0.170118, -3.14115e-05},
    Piece{47.350, 0.001165348, 0.125017, -3.70335e-07},
    Piece{51.412, 0.0007033933, 0.104846, 2.41634e-06},
    Piece{71.802, 5.241694e-05, 0.137390, 1.75498e-07},
    Piece{86.000, 5.68225e-06, 0.178230, 0},
};
static_assert(kPieces.size() <= kMaxDensityTerms);

/// amplitude exp(-k h) + slope h + constant that passes through both ends of a piece.
DensityTerm joined(const Piece& piece, const Piece& next) {
  const double length = next.bottom_km - piece.bottom_km;
  const double k = piece.inverse_scale_height_per_km;
  const double fall = piece.density - next.density + piece.slope_per_km * length;
  const double at_bottom = fall / -std::expm1(-k * length);  // of the exponential alone
  return {.bottom_km = piece.bottom_km,
          .top_km = next.bottom_km,
          .amplitude = at_bottom * std::exp(k * piece.bottom_km),
          .inverse_scale_height_per_km = k,
          .slope_per_km = piece.slope_per_km,
          .constant = piece.density - at_bottom - piece.slope_per_km * piece.bottom_km};
}

DensityTerm highest() {
  const Piece& piece = kPieces.back();
  const double k = piece.inverse_scale_height_per_km;
  return {.bottom_km = piece.bottom_km,
          .top_km = std::numeric_limits<double>::max(),
          .amplitude = piece.density * std::exp(k * piece.bottom_km),
          .inverse_scale_height_per_km = k};
}

}  // namespace

DensityProfile standard_air_profile(Length top) {
  DensityProfile profile;
  for (size_t i = 0; i < kPieces.size() && kPieces[i].bottom_km < top.in(km); ++i) {
    profile.terms.push_back(i + 1 < kPieces.size() ? joined(kPieces[i], kPieces[i + 1])
                                                   : highest());
    DensityTerm& term = profile.terms.back();
    term.top_km = std::min(term.top_km, top.in(km));
  }
  return profile;
}

}  // namespace skylapse::sky::atmosphere
