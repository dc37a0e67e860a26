#include "sky/monte_carlo/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skylapse::sky::monte_carlo {
namespace {

/// Shares of directions drawn around the sun (it makes the aerosol's peak harmless in the next
/// event) and, where the sun is down, around the bright part of the horizon. Any value below 1 is
/// right; these gave the smallest errors for the time on the reference medium.
constexpr double kChanceOfSun = 0.25, kChanceOfTwilight = 0.3;
const AerosolPhase kTwilightLobe(0.7);
constexpr double kTwilightElevation = 0.1;  // rad

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
  optics_.view_sun(place.height, glm::dot(place.up, to_sun_), rules_.sun, sun_);
  if (sun_.visible > 0) {
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

bool Path::reflect_at(const Place& place) {
  place_ = place;
  ++order_;
  constexpr double kPerSteradian = 1 / std::numbers::pi;
  const double mu_sun = glm::dot(place.up, to_sun_);
  const double cosine = optics_.sun_on_ground(place.height, mu_sun, rules_.sun, sun_);
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

bool Path::travel() {
  const double mu = glm::dot(place_.up, direction_);
  optics_.shells.follow(place_.height, mu, trace_);
  const double through = optics_.depth(trace_.total, hero_);
  if (!trace_.hits_ground || optics_.albedo[hero_] == 0) {
    // Nothing but air gives light on this way: a collision is certain, at its probability's weight.
    const double collides = -std::expm1(-through);
    if (!(collides > 0)) return false;
    return collide(-std::log1p(-random_->uniform() * collides), true);
  }
  const double depth = -std::log(random_->uniform());
  if (depth < through) return collide(depth, false);
  optics_.transmittances(trace_.total, scratch_);
  for (int b = 0; b < optics_.bands; ++b) {
    weight_[b] *= scratch_[b];
    density_[b] *= scratch_[b];
  }
  if (!normalise()) return false;
  Place ground = place_.moved(optics_.shells.radius(), direction_, trace_.length);
  ground.height = 0;
  return reflect_at(ground);
}

/// Goes on to optical depth `depth` of the hero.
bool Path::collide(double depth, bool forced) {
  const RayParabola ray(optics_.shells.radius(), place_.height, glm::dot(place_.up, direction_));
  Columns before;
  double t = 0;
  const size_t pieces = trace_.pieces.size();
  for (size_t i = 0; i < pieces; ++i) {
    const Trace::Piece& piece = trace_.pieces[i];
    const double here = optics_.depth(piece.columns, hero_);
    if (depth > here && i + 1 < pieces) {
      depth -= here;
      before += piece.columns;
      continue;
    }
    // Newton within a bracket; what is left of the depth only shifts the sample by as much.
    const Shell& shell = optics_.shells.shell(piece.shell);
    double low = piece.begin, high = piece.end;
    t = here > 0 ? low + (high - low) * std::min(1.0, depth / here) : low;
    Columns part;
    for (int step = 0; step < 30; ++step) {
      part = shell_columns(shell, ray, piece.begin, t);
      const double off = optics_.depth(part, hero_) - depth;
      if (std::abs(off) < 1e-6 * here) break;
      (off > 0 ? high : low) = t;
      const double slope = optics_.depth(optics_.shells.densities(ray.height(t)), hero_);
      const double next = slope > 0 ? t - off / slope : low;
      t = next > low && next < high ? next : (low + high) / 2;
    }
    before += part;
    break;
  }
  const Place place = place_.moved(optics_.shells.radius(), direction_, t);
  const Columns density = optics_.shells.densities(place.height);
  optics_.transmittances(before, scratch_);
  for (int b = 0; b < optics_.bands; ++b) {
    weight_[b] *= scratch_[b];
    density_[b] *= scratch_[b] * optics_.depth(density, b);
  }
  if (forced) {
    optics_.transmittances(trace_.total, scratch_);
    for (int b = 0; b < optics_.bands; ++b) {
      const double collides = absorbed(optics_.depth(trace_.total, b), scratch_[b]);
      density_[b] = collides > 0 ? density_[b] / collides : 0;
    }
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
    return true;
  }
  double ratio = 0;
  for (int b = 0; b < bands; ++b)
    if (weight_[b] > 0) ratio = std::max(ratio, weight_[b] / weight_at_first_[b]);
  if (!(ratio > 0)) return false;
  if (ratio >= rules_.roulette_below) return true;
  const double chance = ratio / rules_.roulette_below;
  if (random_->uniform() >= chance) return false;
  for (int b = 0; b < bands; ++b) weight_[b] /= chance;
  return true;
}

}  // namespace skylapse::sky::monte_carlo
