#pragma once
// Physical quantities: built with a unit (30.0 * deg), read with one (a.in(rad)).
// A quantity is one double in its base unit plus a tag; mixing tags does not compile.
#include <cmath>
#include <compare>
#include <numbers>

namespace skylapse {

template <class Tag>
class Quantity;

/// A unit is a factor to the base unit of its quantity.
template <class Tag>
struct Unit {
  double factor;
};

template <class Tag>
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr Quantity(double value, Unit<Tag> unit) : base_(value * unit.factor) {}
  [[nodiscard]] constexpr double in(Unit<Tag> unit) const { return base_ / unit.factor; }

  constexpr Quantity operator-() const { return from_base(-base_); }
  constexpr Quantity& operator+=(Quantity o) { return base_ += o.base_, *this; }
  constexpr Quantity& operator-=(Quantity o) { return base_ -= o.base_, *this; }
  constexpr Quantity& operator*=(double s) { return base_ *= s, *this; }
  friend constexpr Quantity operator+(Quantity a, Quantity b) { return a += b; }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return a -= b; }
  friend constexpr Quantity operator*(Quantity a, double s) { return a *= s; }
  friend constexpr Quantity operator*(double s, Quantity a) { return a *= s; }
  friend constexpr Quantity operator/(Quantity a, double s) { return from_base(a.base_ / s); }
  friend constexpr double operator/(Quantity a, Quantity b) { return a.base_ / b.base_; }
  friend constexpr auto operator<=>(Quantity, Quantity) = default;
  friend bool isfinite(Quantity a) { return std::isfinite(a.base_); }
  friend constexpr Quantity abs(Quantity a) { return a.base_ < 0 ? -a : a; }

 private:
  static constexpr Quantity from_base(double base) { return Quantity(base, Unit<Tag>{1.0}); }
  double base_ = 0;
};

template <class Tag>
constexpr Quantity<Tag> operator*(double value, Unit<Tag> unit) {
  return Quantity<Tag>(value, unit);
}

using Angle = Quantity<struct AngleTag>;                        // base: radian
using Length = Quantity<struct LengthTag>;                      // base: metre
using Duration = Quantity<struct DurationTag>;                  // base: second (SI)
using Wavelength = Quantity<struct WavelengthTag>;              // base: nanometre
using Pressure = Quantity<struct PressureTag>;                  // base: hectopascal
using TemperatureCelsius = Quantity<struct TemperatureTag>;     // base: degree Celsius
using Luminance = Quantity<struct LuminanceTag>;                // base: cd m^-2
using Illuminance = Quantity<struct IlluminanceTag>;            // base: lux
using SpectralRadiance = Quantity<struct SpectralRadianceTag>;  // base: W m^-2 sr^-1 nm^-1
using Radiance = Quantity<struct RadianceTag>;                  // base: W m^-2 sr^-1
using SolidAngle = Quantity<struct SolidAngleTag>;              // base: steradian

inline constexpr Unit<AngleTag> rad{1.0};
inline constexpr Unit<AngleTag> deg{std::numbers::pi / 180.0};
inline constexpr Unit<AngleTag> arcmin{std::numbers::pi / 10800.0};
inline constexpr Unit<AngleTag> arcsec{std::numbers::pi / 648000.0};
inline constexpr Unit<LengthTag> metre{1.0};
inline constexpr Unit<LengthTag> km{1000.0};
inline constexpr Unit<LengthTag> astronomical_unit{149597870700.0};  // IAU 2012 Resolution B2
inline constexpr Unit<DurationTag> second{1.0};
inline constexpr Unit<DurationTag> minute{60.0};
inline constexpr Unit<DurationTag> hour{3600.0};
inline constexpr Unit<WavelengthTag> nm{1.0};
inline constexpr Unit<PressureTag> hPa{1.0};
inline constexpr Unit<TemperatureTag> degC{1.0};
inline constexpr Unit<LuminanceTag> cd_per_m2{1.0};
inline constexpr Unit<IlluminanceTag> lux{1.0};
inline constexpr Unit<SpectralRadianceTag> W_per_m2_sr_nm{1.0};
inline constexpr Unit<RadianceTag> W_per_m2_sr{1.0};
inline constexpr Unit<SolidAngleTag> sr{1.0};

inline double sin(Angle a) { return std::sin(a.in(rad)); }
inline double cos(Angle a) { return std::cos(a.in(rad)); }
inline double tan(Angle a) { return std::tan(a.in(rad)); }
inline Angle atan2_angle(double y, double x) { return std::atan2(y, x) * rad; }

}  // namespace skylapse
