#include "sky/bruneton/scattering_orders.h"

#include <cmath>

#include "core/parallel.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr int kZenithSteps = 16384;  // of row_of_zenith_: error below 2e-5 rows

std::vector<double> cosine_matrix(const std::vector<double>& azimuths, int degree) {
  std::vector<double> matrix;
  for (const double phi : azimuths)
    for (int m = 0; m <= degree; ++m) matrix.push_back(std::cos(m * phi));
  return matrix;
}

}  // namespace

ScatteringOrders::ScatteringOrders(const Columns& columns, const Settings& settings,
                                   int first_group, int count)
    : settings_(settings),
      first_group_(first_group),
      data_(physics_data(columns.medium(), settings, 2)),
      suns_(sun_nodes(columns.medium(), settings)),
      index_{settings.harmonics},
      first_lists_(march_lists(columns, settings, settings.first_order_samples)),
      lists_(march_lists(columns, settings, settings.samples)) {
  data_.columns = columns.nodes().data();
  data_.groups = {data_.groups.begin() + first_group, data_.groups.begin() + first_group + count};
  for (int j = 0; j < settings.suns; ++j) sun_mu_.push_back(std::cos(suns_.zenith_rad(j)));
  // sun_row_of of coordinates.glsl before it is clamped: interpolation would round the corners.
  const text::AirParameters& air = data_.air;
  for (int i = 0; i <= kZenithSteps; ++i)
    row_of_zenith_.push_back(
        (air.sun_first -
         std::asinh((air.sun_centre - text::PI * i / kZenithSteps) / air.sun_width)) *
        air.sun_rows_per_unit);

  std::vector<double> directions, table;
  for (int a = 0; a < settings.azimuths; ++a) {
    directions.push_back(direction_azimuth(a, settings.azimuths));
    azimuth_cosine_.push_back(std::cos(directions.back()));
  }
  for (int a = 0; a < settings.table_azimuths; ++a)
    table.push_back(text::PI * a / (settings.table_azimuths - 1));
  direction_cosines_ = cosine_matrix(directions, settings.harmonics);
  table_cosines_ = cosine_matrix(table, settings.harmonics);

  for (const DirectionRows& rows : lists_.rows) {
    std::vector<double> matrix;
    for (size_t k = 0; k < rows.mu.size(); ++k)
      for (const double factor : legendre_factors(settings.harmonics, rows.mu[k]))
        matrix.push_back(factor * rows.weight[k] * 2 * text::PI / settings.azimuths);
    analysis_.push_back(std::move(matrix));
  }
  for (int z = 0; z < settings.table_zeniths; ++z)
    synthesis_.push_back(legendre_factors(settings.harmonics,
                                          std::cos(text::PI * z / (settings.table_zeniths - 1))));
  moments_ = mixture_moments(columns.medium(), settings);
}

double ScatteringOrders::sun_row(double mu_s) const {
  const double x = std::acos(std::clamp(mu_s, -1.0, 1.0)) * (kZenithSteps / text::PI);
  const int node = std::min(int(x), kZenithSteps - 1);
  const double row =
      row_of_zenith_[node] + (x - node) * (row_of_zenith_[node + 1] - row_of_zenith_[node]);
  return std::clamp(row, 0.0, data_.air.sun_row_last);
}

glm::dvec4 ScatteringOrders::weight(const std::vector<double>& weights, size_t item,
                                    int group) const {
  const int bands = lists_.bands;
  const double* at = weights.data() + item * bands;
  glm::dvec4 result;
  for (int c = 0; c < 4; ++c) result[c] = at[std::min(4 * (first_group_ + group) + c, bands - 1)];
  return result;
}

IncidentLight ScatteringOrders::empty_light() const {
  const size_t size = lists_.rays.size() * settings_.suns * settings_.azimuths;
  return {std::vector(groups(), std::vector(size, glm::dvec4(0))),
          std::vector(groups(), std::vector(settings_.sun_rows(), glm::dvec4(0)))};
}

void ScatteringOrders::light_ground(IncidentLight& incident) const {
  const DirectionRows& rows = lists_.rows[0];
  const int suns = settings_.suns, azimuths = settings_.azimuths;
  for (int g = 0; g < groups(); ++g) {
    std::vector<glm::dvec4>& ground = incident.ground[g];
    for (int k = 0; k < rows.up; ++k)
      for (int j = 0; j < suns; ++j)
        for (int a = 0; a < azimuths; ++a)
          ground[size_t(j) * settings_.sun_rows_per_interval] +=
              incident.light[g][(size_t(k) * suns + j) * azimuths + a] *
              (rows.mu[k] * rows.weight[k] * 2 * text::PI / azimuths);
    fill_ground_rows(ground);
  }
}

IncidentLight ScatteringOrders::first_order() {
  IncidentLight result = empty_light();
  parallel_for_ranges(first_lists_.rays.size(), 4, [&](size_t begin, size_t end) {
    for (size_t ray = begin; ray < end; ++ray) first_order_ray(ray, result);
  });
  light_ground(result);
  return result;
}

void ScatteringOrders::first_order_ray(size_t ray_index, IncidentLight& out) {
  const MarchRay& ray = first_lists_.rays[ray_index];
  const size_t row_count = lists_.rows[0].mu.size();
  const double mu = lists_.rows[ray_index / row_count].mu[ray_index % row_count];
  const int pairs = settings_.suns * settings_.azimuths;
  Geometry text(data_);
  std::vector<glm::dvec4> rayleigh(size_t(groups()) * pairs), aerosol(rayleigh.size());
  std::vector<double> nu(pairs), mu_sun(pairs);
  for (int p = 0; p < pairs; ++p) {
    mu_sun[p] = sun_mu_[p / settings_.azimuths];
    nu[p] = mu * mu_sun[p] + std::sqrt((1 - mu * mu) * (1 - mu_sun[p] * mu_sun[p])) *
                                 azimuth_cosine_[p % settings_.azimuths];
  }
  for (int s = ray.first; s < ray.first + ray.count; ++s) {
    const MarchSample& sample = first_lists_.samples[s];
    for (int p = 0; p < pairs; ++p) {
      const double mu_s =
          std::clamp(sample.sun_scale * mu_sun[p] + sample.nu_scale * nu[p], -1.0, 1.0);
      const double visible = text.sun_visibility(sample.height_km, mu_s);
      if (visible <= 0) continue;
      const glm::dvec3 columns = text.columns_to_top(sample.height_km, mu_s);
      for (int g = 0; g < groups(); ++g) {
        const glm::dvec4 sun = glm::exp(-text.optical_depth(data_.groups[g], columns)) * visible;
        rayleigh[size_t(g) * pairs + p] += sun * weight(first_lists_.rayleigh_weight, s, g);
        aerosol[size_t(g) * pairs + p] += sun * weight(first_lists_.aerosol_weight, s, g);
      }
    }
  }
  for (int g = 0; g < groups(); ++g) {
    Geometry group_text(data_, g);
    const glm::dvec4 seen = weight(first_lists_.ground_transmittance, ray_index, g);
    for (int p = 0; p < pairs; ++p) {
      const size_t i = size_t(g) * pairs + p;
      glm::dvec4 light =
          (rayleigh[i] * text.rayleigh_phase(nu[p]) + aerosol[i] * text.aerosol_phase(nu[p])) *
          data_.groups[g].solar_irradiance;
      if (ray.hits_ground) {
        const double mu_s = ray.ground_sun_scale * mu_sun[p] + ray.ground_nu_scale * nu[p];
        light += seen * group_text.ground_radiance(0, std::clamp(mu_s, -1.0, 1.0));
      }
      out.light[g][ray_index * pairs + p] = light;
    }
  }
}

Source ScatteringOrders::gather(const IncidentLight& incident) const {
  const size_t slab = size_t(settings_.sun_rows()) * settings_.table_azimuths;
  Source result(groups(),
                std::vector(slab * settings_.table_zeniths * settings_.heights, glm::dvec4(0)));
  parallel_for_ranges(settings_.heights, 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int lit = settings_.suns - (suns_.dark_end ? 1 : 0);
      for (int j = 0; j < lit; ++j) gather_point(i, j, incident, result);
      for (std::vector<glm::dvec4>& source : result) fill_sun_rows(i, source);
    }
  });
  return result;
}

/// One point under one sun: into the rows that are nodes.
void ScatteringOrders::gather_point(size_t height, size_t sun, const IncidentLight& incident,
                                    Source& out) const {
  const int degree = index_.degree, orders = degree + 1, azimuths = settings_.azimuths;
  const size_t row_count = lists_.rows[height].mu.size(), harmonics = index_.count();
  std::vector<glm::dvec4> coefficients(harmonics), cosines(orders);
  for (int g = 0; g < groups(); ++g) {
    std::fill(coefficients.begin(), coefficients.end(), glm::dvec4(0));
    for (size_t k = 0; k < row_count; ++k) {
      const glm::dvec4* light =
          &incident.light[g][((height * row_count + k) * settings_.suns + sun) * azimuths];
      const double* factors = &analysis_[height][k * harmonics];
      for (int m = 0; m <= degree; ++m) {
        glm::dvec4 sum(0);
        for (int a = 0; a < azimuths; ++a) sum += light[a] * direction_cosines_[a * orders + m];
        for (int l = m; l <= degree; ++l)
          coefficients[index_.at(l, m)] += sum * factors[index_.at(l, m)];
      }
    }
    const std::vector<glm::dvec4>& moments = moments_[height][first_group_ + g];
    for (int m = 0; m <= degree; ++m)
      for (int l = m; l <= degree; ++l) coefficients[index_.at(l, m)] *= moments[l];
    for (int z = 0; z < settings_.table_zeniths; ++z) {
      for (int m = 0; m <= degree; ++m) {
        cosines[m] = glm::dvec4(0);
        for (int l = m; l <= degree; ++l)
          cosines[m] += coefficients[index_.at(l, m)] * synthesis_[z][index_.at(l, m)];
      }
      const size_t row = (height * settings_.table_zeniths + z) * settings_.sun_rows() +
                         sun * settings_.sun_rows_per_interval;
      glm::dvec4* source = &out[g][row * settings_.table_azimuths];
      for (int a = 0; a < settings_.table_azimuths; ++a) {
        glm::dvec4 sum(0);
        for (int m = 0; m <= degree; ++m) sum += cosines[m] * table_cosines_[a * orders + m];
        source[a] = glm::max(sum, 0.0);  // ringing of the cut series
      }
    }
  }
}

void ScatteringOrders::fill_sun_rows(size_t height, std::vector<glm::dvec4>& source) const {
  const size_t azimuths = settings_.table_azimuths, rows = settings_.sun_rows();
  std::vector<glm::dvec4> nodes(settings_.suns * azimuths);
  for (int z = 0; z < settings_.table_zeniths; ++z) {
    glm::dvec4* slab = &source[(height * settings_.table_zeniths + z) * rows * azimuths];
    for (int j = 0; j < settings_.suns; ++j)
      std::copy_n(slab + size_t(j) * settings_.sun_rows_per_interval * azimuths, azimuths,
                  &nodes[j * azimuths]);
    upsample_suns(&nodes[0][0], 4 * azimuths, &slab[0][0], 4 * azimuths, int(4 * azimuths),
                  settings_, suns_.dark_end);
  }
}

void ScatteringOrders::fill_ground_rows(std::vector<glm::dvec4>& ground) const {
  std::vector<glm::dvec4> nodes;
  for (int j = 0; j < settings_.suns; ++j)
    nodes.push_back(ground[size_t(j) * settings_.sun_rows_per_interval]);
  if (suns_.dark_end) nodes.back() = glm::dvec4(0);
  upsample_suns(&nodes[0][0], 4, &ground[0][0], 4, 4, settings_, suns_.dark_end);
}

void ScatteringOrders::fill_rows(std::vector<glm::dvec4>& source,
                                 std::vector<glm::dvec4>& ground) const {
  parallel_for_ranges(settings_.heights, 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) fill_sun_rows(i, source);
  });
  fill_ground_rows(ground);
}

IncidentLight ScatteringOrders::march(const Source& source, const IncidentLight& incident) const {
  IncidentLight result = empty_light();
  parallel_for_ranges(lists_.rays.size(), 4, [&](size_t begin, size_t end) {
    for (size_t ray = begin; ray < end; ++ray) march_ray(ray, source, incident, result);
  });
  light_ground(result);
  return result;
}

void ScatteringOrders::march_ray(size_t ray_index, const Source& source,
                                 const IncidentLight& before, IncidentLight& out) const {
  const MarchRay& ray = lists_.rays[ray_index];
  const size_t row_count = lists_.rows[0].mu.size();
  const double mu = lists_.rows[ray_index / row_count].mu[ray_index % row_count];
  const int suns = settings_.suns, azimuths = settings_.azimuths;
  const size_t table = settings_.table_azimuths;
  const size_t slab_size = size_t(settings_.sun_rows()) * table;
  Geometry text(data_);
  // At one sample height and direction are fixed: the table shrinks to a slab of sun rows and
  // azimuths, weights folded in, and each pair of sun and azimuth is one bilinear lookup.
  std::vector<std::vector<glm::dvec4>> slab(groups(), std::vector<glm::dvec4>(slab_size));
  const auto nu_of = [&](int j, int a) {
    return mu * sun_mu_[j] +
           std::sqrt((1 - mu * mu) * (1 - sun_mu_[j] * sun_mu_[j])) * azimuth_cosine_[a];
  };
  for (int s = ray.first; s < ray.first + ray.count; ++s) {
    const MarchSample& sample = lists_.samples[s];
    const text::Between h = text::between(sample.height_coordinate, settings_.heights - 1);
    const text::Between z = text::between(sample.zenith_coordinate, settings_.table_zeniths - 1);
    const size_t corner = (size_t(h.node) * settings_.table_zeniths + z.node) * slab_size;
    const size_t up = size_t(settings_.table_zeniths) * slab_size;
    for (int g = 0; g < groups(); ++g) {
      const glm::dvec4 w =
          weight(lists_.rayleigh_weight, s, g) + weight(lists_.aerosol_weight, s, g);
      const glm::dvec4 w00 = w * ((1 - h.weight) * (1 - z.weight));
      const glm::dvec4 w01 = w * ((1 - h.weight) * z.weight);
      const glm::dvec4 w10 = w * (h.weight * (1 - z.weight)), w11 = w * (h.weight * z.weight);
      const glm::dvec4* at = &source[g][corner];
      for (size_t n = 0; n < slab_size; ++n)
        slab[g][n] =
            at[n] * w00 + at[n + slab_size] * w01 + at[n + up] * w10 + at[n + up + slab_size] * w11;
    }
    for (int j = 0; j < suns; ++j)
      for (int a = 0; a < azimuths; ++a) {
        const double nu = nu_of(j, a);
        const double mu_s =
            std::clamp(sample.sun_scale * sun_mu_[j] + sample.nu_scale * nu, -1.0, 1.0);
        const text::Between y = text::between(sun_row(mu_s), settings_.sun_rows() - 1);
        const text::Between x =
            text::between(text.azimuth_coordinate(sample.mu, mu_s, nu), int(table) - 1);
        const size_t i = y.node * table + x.node;
        for (int g = 0; g < groups(); ++g) {
          const glm::dvec4* at = &slab[g][i];
          out.light[g][(ray_index * suns + j) * azimuths + a] +=
              (at[0] * (1 - x.weight) + at[1] * x.weight) * (1 - y.weight) +
              (at[table] * (1 - x.weight) + at[table + 1] * x.weight) * y.weight;
        }
      }
  }
  if (!ray.hits_ground) return;
  for (int g = 0; g < groups(); ++g) {
    const glm::dvec4 share = weight(lists_.ground_transmittance, ray_index, g) *
                             data_.groups[g].ground_albedo * (1 / text::PI);
    for (int j = 0; j < suns; ++j)
      for (int a = 0; a < azimuths; ++a) {
        const double mu_s = std::clamp(
            ray.ground_sun_scale * sun_mu_[j] + ray.ground_nu_scale * nu_of(j, a), -1.0, 1.0);
        const text::Between y = text::between(sun_row(mu_s), settings_.sun_rows() - 1);
        out.light[g][(ray_index * suns + j) * azimuths + a] +=
            share *
            (before.ground[g][y.node] * (1 - y.weight) + before.ground[g][y.node + 1] * y.weight);
      }
  }
}

}  // namespace skylapse::sky::bruneton
