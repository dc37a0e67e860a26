#include "sky/monte_carlo/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skylapse::sky::monte_carlo {
namespace {

/// Shares of directions drawn around the sun (it makes the aerosol's peak harmless in the next
/// event) and, where the sun is down, around the bright part of the horizon. Any value below 1 is
/// right; these gave the smallest errors of a few that were tried on the reference medium.
constexpr double kChanceOfSun = 0.25, kChanceOfTwilight = 0.4;
const AerosolPhase kTwilightLobe(0.7);
constexpr double kTwilightElevation = 0.1;  // rad
/// Share of distances drawn by the guide, where it is used at all, from that many cells a piece.
constexpr double kChanceOfGuide = 0.7;
constexpr int kGuideCells = 5;
constexpr double kLeastExpectation = 0.1;
/// Events after which a path is left to the phase function and to density times transmittance.
/// Each draw by a guide makes weights uneven; over the hundreds of events of a path in a thick
/// cloud a few paths would carry everything, and most estimates would miss them.
constexpr int kGuidedOrders = 4;

/// 1 - exp(-depth), given the exponential.
double absorbed(double depth, double transmittance) {
  return depth < 1e-4 ? depth * (1 - depth / 2) : 1 - transmittance;
}

}  // namespace

Place Place::moved(double radius, const glm::dvec3& direction, double distance) const {
  const double mu = glm::dot(up, direction);
  const double h = RayParabola(radius, height, mu).height(distance);
  return {std::max(h, 0.0), glm::normalize((radius + height) * up + distance * direction)};
}

glm::dvec3 turned(const glm::dvec3& axis, double nu, PathRandom& random) {
  // Duff et al. 2017, "Building an orthonormal basis, revisited".
  const double sign = std::copysign(1.0, axis.z);
  const double a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
  const glm::dvec3 x(1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x);
  const glm::dvec3 y(b, sign + axis.y * axis.y * a, -axis.y);
  const double sine = std::sqrt(std::max(0.0, (1 - nu) * (1 + nu)));
  const double azimuth = 2 * std::numbers::pi * random.uniform();
  return glm::normalize(sine * std::cos(azimuth) * x + sine * std::sin(azimuth) * y + nu * axis);
}

void Path::begin(const Place& place, const glm::dvec3& direction, const glm::dvec3& to_sun,
                 int hero, PathRandom& random, PathRadiance& result) {
  place_ = place;
  direction_ = direction;
  to_sun_ = to_sun;
  hero_ = hero;
  order_ = 0;
  random_ = &random;
  result_ = &result;
  for (int b = 0; b < optics_.padded; ++b) {
    weight_[b] = density_[b] = 1;
    result.order1[b] = result.up_to_order4[b] = result.all[b] = 0;
  }
}

void Path::scale(const PerBand& factor) {
  for (int b = 0; b < optics_.bands; ++b) weight_[b] *= factor[b];
}

void Path::scale(double factor) {
  for (int b = 0; b < optics_.bands; ++b) weight_[b] *= factor;
}

void Path::gather(int band, double value) {
  const auto b = size_t(band);
  result_->all[b] += value;
  if (order_ <= 4) result_->up_to_order4[b] += value;
  if (order_ == 1) result_->order1[b] += value;
}

Path::Lobe Path::lobe_at(const Place& place) const {
  if (order_ > kGuidedOrders) return {};
  const double mu_sun = glm::dot(place.up, to_sun_);
  if (mu_sun > optics_.shells.horizon_cosine(place.height))
    return {optics_.has_aerosol ? kChanceOfSun : 0, to_sun_, &optics_.aerosol_phase};
  const glm::dvec3 level = to_sun_ - mu_sun * place.up;
  const double length = glm::length(level);
  if (length < 1e-6) return {};
  return {kChanceOfTwilight,
          std::cos(kTwilightElevation) / length * level + std::sin(kTwilightElevation) * place.up,
          &kTwilightLobe};
}

bool Path::scatter_at(const Place& place) {
  place_ = place;
  ++order_;
  const Columns density = optics_.shells.densities(place.height);
  const int bands = optics_.bands;
  for (int b = 0; b < bands; ++b) {
    rayleigh_[b] = optics_.rayleigh[b] * density.rayleigh;
    aerosol_[b] = optics_.aerosol[b] * density.aerosol;
  }
  if (gathers()) optics_.view_sun(place.height, glm::dot(place.up, to_sun_), rules_.sun, sun_);
  if (gathers() && sun_.visible > 0) {
    const double nu = glm::dot(direction_, to_sun_);
    const double molecules = optics_.rayleigh_phase.at(nu) * sun_.visible;
    const double particles = optics_.aerosol_phase.at(nu) * sun_.visible;
    for (int b = 0; b < bands; ++b)
      gather(b, weight_[b] * (rayleigh_[b] * molecules + aerosol_[b] * particles) *
                    optics_.solar[b] * sun_.transmittance[b]);
  }
  if (order_ == rules_.max_order) return false;
  const double all = rayleigh_[hero_] + aerosol_[hero_];
  if (!(all > 0)) return false;
  const Lobe lobe = lobe_at(place);
  glm::dvec3 direction;
  if (lobe.chance > 0 && random_->uniform() < lobe.chance) {
    direction = turned(lobe.axis, lobe.shape->sample(*random_), *random_);
  } else {
    const bool particle = random_->uniform() * all < aerosol_[hero_];
    const double nu =
        particle ? optics_.aerosol_phase.sample(*random_) : optics_.rayleigh_phase.sample(*random_);
    direction = turned(direction_, nu, *random_);
  }
  const double nu = glm::dot(direction, direction_);
  const double molecules = optics_.rayleigh_phase.at(nu), particles = optics_.aerosol_phase.at(nu);
  const double by_lobe =
      lobe.chance > 0 ? lobe.chance * lobe.shape->at(glm::dot(direction, lobe.axis)) : 0;
  for (int b = 0; b < bands; ++b) {
    const double scattered = rayleigh_[b] * molecules + aerosol_[b] * particles;
    const double total = rayleigh_[b] + aerosol_[b];
    weight_[b] *= scattered;
    density_[b] *= (total > 0 ? (1 - lobe.chance) * scattered / total : 0) + by_lobe;
  }
  direction_ = direction;
  return go_on();
}

bool Path::reflect_at(const Place& place, Sunlight sunlight) {
  place_ = place;
  ++order_;
  constexpr double kPerSteradian = 1 / std::numbers::pi;
  const double mu_sun = glm::dot(place.up, to_sun_);
  const double cosine = gathers() && sunlight == Sunlight::unknown
                            ? optics_.sun_on_ground(place.height, mu_sun, rules_.sun, sun_)
                            : 0;
  const int bands = optics_.bands;
  if (cosine > 0)
    for (int b = 0; b < bands; ++b)
      gather(b, weight_[b] * optics_.albedo[b] * kPerSteradian * cosine * optics_.solar[b] *
                    sun_.transmittance[b]);
  if (order_ == rules_.max_order) return false;
  const Lobe lobe = lobe_at(place);
  if (lobe.chance > 0 && random_->uniform() < lobe.chance)
    direction_ = turned(lobe.axis, lobe.shape->sample(*random_), *random_);
  else
    direction_ = turned(place.up, std::sqrt(random_->uniform()), *random_);
  const double mu = glm::dot(direction_, place.up);
  if (!(mu > 0)) return false;
  double density = (1 - lobe.chance) * mu * kPerSteradian;
  if (lobe.chance > 0) density += lobe.chance * lobe.shape->at(glm::dot(direction_, lobe.axis));
  for (int b = 0; b < bands; ++b) weight_[b] *= optics_.albedo[b] * mu * kPerSteradian / density;
  return go_on();
}

/// Fills guide_ for the traced way; the chance that it is followed.
double Path::make_guide() {
  const Shells& shells = optics_.shells;
  if (!rules_.guide || order_ > kGuidedOrders) return 0;
  if (glm::dot(place_.up, to_sun_) > SunGuide::kLowSun) return 0;
  guide_.cut(shells, RayParabola(shells.radius(), place_.height, glm::dot(place_.up, direction_)),
             trace_, kGuideCells);
  for (RayCells::Cell& cell : guide_.cells()) {
    const Place middle = place_.moved(shells.radius(), direction_, cell.begin + cell.length / 2);
    const double scattering =
        optics_.mean_rayleigh * cell.columns.rayleigh + optics_.mean_aerosol * cell.columns.aerosol;
    const double depth = optics_.mean_depth(cell.before) + optics_.mean_depth(cell.columns) / 2;
    cell.weight = scattering * std::exp(-depth) * expected_light(middle);
  }
  return guide_.finish() ? kChanceOfGuide : 0;
}

double Path::expected_light(const Place& place) const {
  return optics_.guide.importance(place.height, glm::dot(place.up, to_sun_));
}

bool Path::travel() {
  const double mu = glm::dot(place_.up, direction_);
  optics_.shells.follow(place_.height, mu, trace_);
  const double through = optics_.depth(trace_.total, hero_);
  // Where nothing but air gives light on this way, a collision is certain, at the weight of its
  // probability.
  const bool forced = !trace_.hits_ground || optics_.albedo[hero_] == 0;
  if (forced && !(through > 0)) return false;
  const double guided = make_guide();
  if (guided > 0 && random_->uniform() < guided) {
    const RayCells::Cell& cell = guide_.draw(*random_);
    const double t = cell.begin + random_->uniform() * cell.length;
    const RayParabola ray(optics_.shells.radius(), place_.height, mu);
    const Shell& shell = optics_.shells.shell(cell.shell);
    return collide({t, cell.before + shell_columns(shell, ray, cell.begin, t)}, forced, guided);
  }
  const double u = random_->uniform();
  if (forced) return collide(at_depth(-std::log1p(u * std::expm1(-through))), true, guided);
  const double depth = -std::log(u);
  if (depth < through) return collide(at_depth(depth), false, guided);
  optics_.transmittances(trace_.total, scratch_);
  for (int b = 0; b < optics_.bands; ++b) {
    weight_[b] *= scratch_[b];
    density_[b] *= (1 - guided) * scratch_[b];
  }
  if (!normalise()) return false;
  Place ground = place_.moved(optics_.shells.radius(), direction_, trace_.length);
  ground.height = 0;
  return reflect_at(ground);
}

/// Where the hero's optical depth from the start is `depth`.
Path::Meeting Path::at_depth(double depth) const {
  const RayParabola ray(optics_.shells.radius(), place_.height, glm::dot(place_.up, direction_));
  Meeting at;
  const Trace::Piece* piece = trace_.pieces.data();
  const Trace::Piece* const last = piece + trace_.pieces.size() - 1;
  double here = optics_.depth(piece->columns, hero_);
  while (depth > here && piece != last) {
    depth -= here;
    at.before += piece->columns;
    here = optics_.depth((++piece)->columns, hero_);
  }
  // Newton within a bracket; what is left of the depth only shifts the sample by as much.
  const Shell& shell = optics_.shells.shell(piece->shell);
  double low = piece->begin, high = piece->end;
  at.distance = here > 0 ? low + (high - low) * std::min(1.0, depth / here) : low;
  Columns part;
  for (int step = 0; step < 30; ++step) {
    part = shell_columns(shell, ray, piece->begin, at.distance);
    const double off = optics_.depth(part, hero_) - depth;
    if (std::abs(off) < 1e-6 * here) break;
    (off > 0 ? high : low) = at.distance;
    const double slope = optics_.depth(optics_.shells.densities(ray.height(at.distance)), hero_);
    const double next = slope > 0 ? at.distance - off / slope : low;
    at.distance = next > low && next < high ? next : (low + high) / 2;
  }
  at.before += part;
  return at;
}

/// Weights and densities of a collision there, then the event itself.
bool Path::collide(const Meeting& at, bool forced, double chance_of_guide) {
  const Place place = place_.moved(optics_.shells.radius(), direction_, at.distance);
  const Columns density = optics_.shells.densities(place.height);
  const double by_guide = chance_of_guide > 0 ? chance_of_guide * guide_.density(at.distance) : 0;
  PerBand through;
  optics_.transmittances(at.before, scratch_);
  if (forced) optics_.transmittances(trace_.total, through);
  for (int b = 0; b < optics_.bands; ++b) {
    double natural = scratch_[b] * optics_.depth(density, b);
    if (forced) {
      const double collides = absorbed(optics_.depth(trace_.total, b), through[b]);
      natural = collides > 0 ? natural / collides : 0;
    }
    weight_[b] *= scratch_[b];
    density_[b] *= (1 - chance_of_guide) * natural + by_guide;
  }
  return normalise() && scatter_at(place);
}

/// Brings the densities to mean 1; false if no band would have come here.
bool Path::normalise() {
  double mean = 0;
  for (int b = 0; b < optics_.bands; ++b) mean += density_[b];
  mean /= optics_.bands;
  if (!(mean > 0)) return false;
  for (int b = 0; b < optics_.bands; ++b) weight_[b] /= mean, density_[b] /= mean;
  return true;
}

/// Russian roulette.
bool Path::go_on() {
  const int bands = optics_.bands;
  if (!normalise()) return false;
  if (order_ == 1) {
    weight_at_first_ = weight_;
    light_at_first_ = expected_light(place_);
    return true;
  }
  double ratio = 0;
  for (int b = 0; b < bands; ++b)
    if (weight_[b] > 0) ratio = std::max(ratio, weight_[b] / weight_at_first_[b]);
  // A path of little weight where much light is to be expected is worth as much as one of more
  // weight. The other way round less trust is due: survivors of small chances are heavy.
  if (glm::dot(place_.up, to_sun_) < SunGuide::kLowSun)
    ratio *= std::max(kLeastExpectation, expected_light(place_) / light_at_first_);
  if (!(ratio > 0)) return false;
  if (ratio >= rules_.roulette_below) return true;
  const double chance = ratio / rules_.roulette_below;
  if (random_->uniform() >= chance) return false;
  for (int b = 0; b < bands; ++b) weight_[b] /= chance;
  return true;
}

}  // namespace skylapse::sky::monte_carlo
