#pragma once
// What a picture of the sky may contain or leave out. Each is taken where the scene calls for it
// and left, with a bound on the error, where it does not (plan/effect_planner).
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace skylapse::sky {

enum class Effect {
  sun_disc,               // the disc itself
  limb_darkening,         // darker and redder towards its edge
  refraction,             // lifts sun and moon
  flattening,             // refraction lifts the lower limb more than the upper
  ozone,                  // absorption by it
  aerosol,                // scattering and absorption by haze
  multiple_scattering,    // light scattered more than once, and its precomputation
  further_orders,         // orders of scattering beyond those that reach the bound
  ground,                 // what lies below the horizon, in the picture
  aerial_perspective,     // the air before it
  unseen_sky,             // directions that no pixel looks along
  full_tables,            // heights and suns that no frame reads
  full_spectrum,          // more wavelengths than the picture tells apart
  twilight_continuation,  // Hosek-Wilkie below the horizon
};

inline constexpr std::array<std::pair<std::string_view, Effect>, 14> kEffectNames{
    {{"sun-disc", Effect::sun_disc},
     {"limb-darkening", Effect::limb_darkening},
     {"refraction", Effect::refraction},
     {"flattening", Effect::flattening},
     {"ozone", Effect::ozone},
     {"aerosol", Effect::aerosol},
     {"multiple-scattering", Effect::multiple_scattering},
     {"further-orders", Effect::further_orders},
     {"ground", Effect::ground},
     {"aerial-perspective", Effect::aerial_perspective},
     {"unseen-sky", Effect::unseen_sky},
     {"full-tables", Effect::full_tables},
     {"full-spectrum", Effect::full_spectrum},
     {"twilight-continuation", Effect::twilight_continuation}}};

inline std::string name_of(Effect effect) {
  for (const auto& [name, value] : kEffectNames)
    if (value == effect) return std::string(name);
  return "";
}

/// Which effects a picture has.
class EffectSet {
 public:
  [[nodiscard]] bool has(Effect effect) const { return (bits_ >> int(effect) & 1U) != 0; }
  void set(Effect effect, bool on = true) {
    const uint32_t bit = 1U << int(effect);
    bits_ = on ? bits_ | bit : bits_ & ~bit;
  }
  friend bool operator==(EffectSet, EffectSet) = default;

 private:
  uint32_t bits_ = 0;
};

}  // namespace skylapse::sky
