// One node of a frame's slice an invocation: light of a range of band groups, projected to XYZ and
// added to what the ranges before have left. What does not depend on the sun comes in lists, one a
// row (src/sky/bruneton/slice_lists.h).
layout(local_size_x = 32) in;

#include "shared/physics_host.glsl"
#include "shared/list_sample.glsl"

struct SliceRow {
  Ray ray;
  float mu;                                    // at the camera
  float whole_rayleigh, whole_aerosol, whole_ozone;  // columns of the whole ray [km]
  int first, count;  // samples
  int first_piece;   // row of the profile texture
  int unused;
};
// A place where sunlight is scattered into the row's rays.
struct SunSample {
  float sun_scale, nu_scale;  // as in ListSample
  float height;
  float view_rayleigh, view_aerosol, view_ozone;  // columns from the camera [km]
  float rayleigh, aerosol;                        // density * length [km]
};
struct SliceBlock {
  float mu_s;  // at the camera
  int azimuths;
  int first_azimuth, end_azimuth, first_row;  // of the part that is wanted
  int multiple_scattering, ground, aerial_perspective;  // switches
};
layout(std140, binding = 3) uniform SliceUniforms { SliceBlock slice; };
layout(std140, binding = 4) uniform WeightBlock { vec4 xyz_weight[4 * GROUPS]; };  // per band
layout(std430, binding = 1) readonly buffer RowBlock { SliceRow rows[]; };
layout(std430, binding = 2) readonly buffer SampleBlock { SunSample samples[]; };
// The same samples, where multiple scattering is looked up.
layout(std430, binding = 6) readonly buffer PlaceBlock { ListSample places[]; };
// [group][place]: transmittance * scattering * length
layout(std430, binding = 3) readonly buffer ScatteringBlock { vec4 scattering_weight[]; };
layout(std430, binding = 4) buffer SmoothBlock { vec4 smooth_xyz[]; };  // [row][azimuth]
layout(std430, binding = 5) buffer AerosolBlock { vec4 aerosol_xyz[]; };
// Columns from the camera along each piece of each ray, over s: t = length s^2 from the lower end.
layout(binding = GROUPS + 1) uniform sampler2D profiles;

struct Sums {
  vec4 rayleigh[GROUPS];
  vec4 aerosol[GROUPS];
  vec4 multiple[GROUPS];
};

Sums add_sunlight(Sums sums, float h, float mu_s, vec3 view, float rayleigh, float aerosol) {
  float visible = sun_visibility(h, mu_s);
  if (visible <= 0.0) return sums;
  vec3 columns = view + columns_to_top(h, mu_s);
  for (int g = 0; g < GROUPS; ++g) {
    vec4 sunlight = exp(-optical_depth(band_group(g), columns)) * visible;
    sums.rayleigh[g] += sunlight * rayleigh;
    sums.aerosol[g] += sunlight * aerosol;
  }
  return sums;
}

// Sunlight along the ray by its list.
Sums listed_sunlight(SliceRow row, SunOfRay sun, Sums sums) {
  for (int i = row.first; i < row.first + row.count; ++i) {
    SunSample here = samples[i];
    float mu_s = clamp(here.sun_scale * sun.mu_s + here.nu_scale * sun.nu, -1.0, 1.0);
    sums = add_sunlight(sums, here.height, mu_s,
                        vec3(here.view_rayleigh, here.view_aerosol, here.view_ozone), here.rayleigh,
                        here.aerosol);
  }
  return sums;
}

Sums multiple_scattering(SliceRow row, SunOfRay sun, Sums sums) {
  for (int i = row.first; i < row.first + row.count; ++i) {
    ListSample here = places[i];
    SourceTexel texel = source_texel_of(here, sun_cosine(here, sun.mu_s, sun.nu), sun.nu);
    for (int g = 0; g < GROUPS; ++g)
      sums.multiple[g] += source_at(g, texel) * scattering_weight[g * places.length() + i];
  }
  return sums;
}

// Fetched and not filtered: a filter's rounding reaches for the profiles of other rays, which need
// not be there.
vec3 profile_at(int piece, float s) {
  int last = textureSize(profiles, 0).x - 1;
  float x = s * float(last);
  int node = min(int(x), last - 1);
  return mix(texelFetch(profiles, ivec2(node, piece), 0),
             texelFetch(profiles, ivec2(node + 1, piece), 0), x - float(node)).xyz;
}

bool is_cut(Ray ray, vec2 places) {
  return (places.x > 0.0 && places.x < ray.length) || (places.y > 0.0 && places.y < ray.length);
}

// A ray that enters or leaves the shadow of the planet or a layer is cut there too, so no list fits.
Sums shadowed_scattering(SliceRow row, SunOfRay sun, vec2 shadow, Sums sums) {
  Ray ray = row.ray;
  int nodes = int(air.march_samples);
  int piece = 0;
  float piece_begin = 0.0;
  float begin = 0.0;
  for (int part = 0; part < MAX_CUTS + 3 + 2 * MAX_LAYERS; ++part) {
    if (begin >= ray.length) break;
    float end = next_cut(ray, sun, shadow, begin);
    float piece_end = piece < int(ray.cut_count) ? ray.cuts[piece] : ray.length;
    bool rising = piece_begin >= ray.lowest - 1e-6 * ray.length;
    float middle = 0.5 * (begin + end);
    float h_middle = height_along(ray.height, ray.mu, middle);
    float mu_s_middle = (radius_of(ray.height) * sun.mu_s + middle * sun.nu) / radius_of(h_middle);
    bool lit = sun_visibility(h_middle, mu_s_middle) > 0.0;
    for (int i = 0; i < (lit ? nodes : 0); ++i) {
      vec2 node = fetch_gauss(i);
      float away = (end - begin) * node.x * node.x;
      float t = rising ? begin + away : end - away;
      float s = sqrt(clamp((rising ? t - piece_begin : piece_end - t) / (piece_end - piece_begin), 0.0, 1.0));
      float h = height_along(ray.height, ray.mu, t);
      float mu_s = (radius_of(ray.height) * sun.mu_s + t * sun.nu) / radius_of(h);
      vec3 amount = densities(h) * (2.0 * node.x * node.y * (end - begin));
      sums = add_sunlight(sums, h, clamp(mu_s, -1.0, 1.0), profile_at(row.first_piece + piece, s),
                          amount.x, amount.y);
    }
    if (end >= piece_end) {
      ++piece;
      piece_begin = piece_end;
    }
    begin = end;
  }
  return sums;
}

vec4 project(int g, vec4 light) {
  return xyz_weight[4 * g] * light.x + xyz_weight[4 * g + 1] * light.y +
         xyz_weight[4 * g + 2] * light.z + xyz_weight[4 * g + 3] * light.w;
}

Sums scattered_light(SliceRow row, SunOfRay sun) {
  Sums sums;
  for (int g = 0; g < GROUPS; ++g) sums.rayleigh[g] = sums.aerosol[g] = sums.multiple[g] = vec4(0.0);
  if (slice.aerial_perspective == 0 && row.ray.hits_ground > 0.5) return sums;
  vec2 shadow = shadow_cuts(row.ray.height, row.ray.mu, sun.mu_s, sun.nu);
  bool shadowed = is_cut(row.ray, shadow);
#if LAYERED
  for (int i = 0; i < int(air.layer_count); ++i)
    shadowed = shadowed || is_cut(row.ray, grazing_cuts(row.ray.height, row.ray.mu, sun.mu_s, sun.nu,
                                                        air.layers[i].top));
#endif
  sums = shadowed ? shadowed_scattering(row, sun, shadow, sums) : listed_sunlight(row, sun, sums);
  if (slice.multiple_scattering == 1) sums = multiple_scattering(row, sun, sums);
  return sums;
}

void main() {
  int azimuth = slice.first_azimuth + int(gl_GlobalInvocationID.x);
  int row_index = slice.first_row + int(gl_WorkGroupID.y);
  if (azimuth >= slice.end_azimuth) return;
  SliceRow row = rows[row_index];
  float nu = cosine_to_sun(row.mu, slice.mu_s, slice_azimuth(azimuth, slice.azimuths));
  SunOfRay sun = sun_of_ray(row.ray, slice.mu_s, nu);
  Sums sums = scattered_light(row, sun);

  int item = row_index * slice.azimuths + azimuth;
  vec4 smooth_sum = smooth_xyz[item];
  vec4 aerosol_sum = aerosol_xyz[item];
  vec3 before_ground = slice.aerial_perspective == 1
                           ? vec3(row.whole_rayleigh, row.whole_aerosol, row.whole_ozone)
                           : vec3(0.0);
  RayLight light = dark_ray();  // for the transmittance to the ground
  for (int g = 0; g < GROUPS; ++g) {
    BandGroup band = band_group(g);
    vec4 sum = sums.multiple[g] + sums.rayleigh[g] * rayleigh_phase(nu) *
                                     (band.rayleigh_scattering * band.solar_irradiance);
    if (slice.ground == 1) {
      light.transmittance[g] = exp(-optical_depth(band, before_ground));
      sum += ground_through_air(g, row.ray, sun, light);
    }
    smooth_sum += project(g, sum);
    aerosol_sum += project(g, sums.aerosol[g] * (band.aerosol_scattering * band.solar_irradiance));
  }
  smooth_xyz[item] = smooth_sum;
  aerosol_xyz[item] = aerosol_sum;
}
