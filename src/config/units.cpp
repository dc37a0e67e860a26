#include "config/units.h"

#include <algorithm>
#include <array>

#include "core/quantity.h"

namespace skylapse::config {
namespace {

constexpr double base(Unit<AngleTag> unit) { return unit.factor; }

constexpr UnitName kAngleUnits[] = {
    {"deg", base(deg)},
    {"rad", base(rad)},
    {"arcmin", base(arcmin)},
    {"arcsec", base(arcsec)},
    {"°", base(deg), 0, false},
    {"degree", base(deg), 0, false},
    {"degrees", base(deg), 0, false},
    {"'", base(arcmin), 0, false},
    {"′", base(arcmin), 0, false},
    {"’", base(arcmin), 0, false},
    {"\"", base(arcsec), 0, false},
    {"″", base(arcsec), 0, false},
    {"”", base(arcsec), 0, false},
    {"''", base(arcsec), 0, false},
};

// Foot and inch of mercury: NIST SP 811 (2008), appendix B.8.
constexpr UnitName kLengthUnits[] = {
    {"m", 1},
    {"km", 1000},
    {"ft", 0.3048},
    {"metre", 1, 0, false},
    {"metres", 1, 0, false},
    {"meter", 1, 0, false},
    {"meters", 1, 0, false},
};

constexpr UnitName kDurationUnits[] = {
    {"s", 1},
    {"min", 60},
    {"h", 3600},
    {"ms", 1e-3},
    {"day", 86400},
    {"sec", 1, 0, false},
    {"second", 1, 0, false},
    {"seconds", 1, 0, false},
    {"minute", 60, 0, false},
    {"minutes", 60, 0, false},
    {"hour", 3600, 0, false},
    {"hours", 3600, 0, false},
    {"days", 86400, 0, false},
    {"d", 86400, 0, false},
};

constexpr UnitName kDayUnits[] = {
    {"day", 1}, {"week", 7}, {"days", 1, 0, false}, {"weeks", 7, 0, false}, {"d", 1, 0, false},
};

constexpr UnitName kPressureUnits[] = {
    {"hPa", 1},          {"Pa", 0.01},       {"kPa", 10},
    {"mbar", 1},         {"inHg", 33.86389}, {"bar", 1000, 0, false},
    {"mb", 1, 0, false},
};

constexpr UnitName kTemperatureUnits[] = {
    {"degC", 1},
    {"K", 1, -273.15},
    {"degF", 5.0 / 9.0, -160.0 / 9.0},
    {"°C", 1, 0, false},
    {"°F", 5.0 / 9.0, -160.0 / 9.0, false},
    {"C", 1, 0, false},
    {"celsius", 1, 0, false},
    {"kelvin", 1, -273.15, false},
};

constexpr UnitName kExposureUnits[] = {{"EV", 1}, {"stops", 1}, {"stop", 1, 0, false}};

constexpr UnitName kExposureRateUnits[] = {
    {"stops/min", 1},          {"EV/min", 1},
    {"stops/h", 1.0 / 60},     {"EV/h", 1.0 / 60},
    {"stop/min", 1, 0, false}, {"stop/h", 1.0 / 60, 0, false},
};

constexpr UnitName kFrameRateUnits[] = {{"fps", 1}, {"Hz", 1, 0, false}};

constexpr UnitName kOzoneUnits[] = {{"DU", 1}};

constexpr UnitName kWavelengthUnits[] = {{"nm", 1}, {"um", 1000}, {"µm", 1000, 0, false}};

constexpr UnitName kShareUnits[] = {{"%", 0.01}};

constexpr std::array<DimensionInfo, 15> kDimensions{{
    {"a number", {}},
    {"an angle", kAngleUnits, {}, true},
    {"a latitude", kAngleUnits, "deg", true},
    {"a longitude", kAngleUnits, "deg", true},
    {"a length", kLengthUnits},
    {"a duration", kDurationUnits, {}, true},
    {"a number of days", kDayUnits},
    {"a pressure", kPressureUnits},
    {"a temperature", kTemperatureUnits},
    {"an exposure value", kExposureUnits, "EV"},
    {"a rate of exposure", kExposureRateUnits, "stops/min"},
    {"a frame rate", kFrameRateUnits, "fps"},
    {"a column of ozone", kOzoneUnits},
    {"a wavelength", kWavelengthUnits},
    {"a percentage", kShareUnits},
}};

}  // namespace

const DimensionInfo& info_of(Dimension dimension) {
  return kDimensions[static_cast<size_t>(dimension)];
}

std::string unit_list(Dimension dimension) {
  std::string list;
  for (const UnitName& unit : info_of(dimension).units)
    if (unit.listed) list += (list.empty() ? "" : ", ") + std::string(unit.symbol);
  return list;
}

Dimension dimension_of_unit(std::string_view symbol) {
  for (size_t i = 0; i < kDimensions.size(); ++i)
    for (const UnitName& unit : kDimensions[i].units)
      if (unit.symbol == symbol) return static_cast<Dimension>(i);
  return Dimension::none;
}

}  // namespace skylapse::config
