#include "sky/bruneton/slice_lists.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace skylapse::sky::bruneton {
namespace {

static_assert(sizeof(text::Ray) == 24 * sizeof(double));
static_assert(sizeof(SliceRowBlock) == 128 && sizeof(SunSample) == 32 && sizeof(ListSample) == 32,
              "the layout of std430");

/// The lists of one row; joined afterwards.
struct RowLists {
  SliceRowBlock block{};
  std::vector<SunSample> samples;
  std::vector<ListSample> places;
  std::vector<glm::dvec4> weights;
  std::vector<glm::vec4> profiles;
};

class RowBuilder {
 public:
  RowBuilder(const PhysicsData& data, const Settings& settings, const SliceRow& row)
      : data_(data), settings_(settings), text_(data), ray_(row.ray) {
    drop_short_pieces();
    const std::vector<float> ray = floats_of_block(ray_);
    std::copy(ray.begin(), ray.end(), lists_.block.ray);
    lists_.block.mu = float(row.mu);
  }

  RowLists build() {
    double begin = 0;
    glm::dvec3 view(0);
    for (int i = 0; i <= int(ray_.cut_count); ++i) {
      const double end = i < int(ray_.cut_count) ? ray_.cuts[i] : ray_.length;
      if (end > begin) view = add_piece(begin, end, view);
      begin = end;
    }
    for (int c = 0; c < 3; ++c) lists_.block.whole[c] = float(view[c]);
    return std::move(lists_);
  }

 private:
  /// As next_cut of march.glsl passes over cuts that are no further than rounding.
  void drop_short_pieces() {
    double last = 0;
    int kept = 0;
    for (int i = 0; i < int(ray_.cut_count); ++i)
      if (ray_.cuts[i] > last + 1e-6 * ray_.length && ray_.cuts[i] < ray_.length)
        last = ray_.cuts[kept++] = ray_.cuts[i];
    ray_.cut_count = kept;
  }

  /// Returns the columns at the piece's end.
  glm::dvec3 add_piece(double begin, double end, const glm::dvec3& start) {
    const bool rising = begin >= ray_.lowest - 1e-6 * ray_.length;
    const auto place = [&](double s) {
      return rising ? begin + (end - begin) * s * s : end - (end - begin) * s * s;
    };
    const std::vector<glm::dvec2>& nodes = data_.gauss;
    glm::dvec3 view = start;
    double last = begin;
    for (size_t i = 0; i < nodes.size(); ++i) {
      const glm::dvec2 node = nodes[rising ? i : nodes.size() - 1 - i];
      const double t = place(node.x);
      view += text_.columns_between(ray_, last, t);
      add_sample(t, 2 * node.x * node.y * (end - begin), view);
      last = t;
    }
    return add_profile(begin, end, rising, start, place);
  }

  void add_sample(double t, double dt, const glm::dvec3& view) {
    const double h = text_.height_along(ray_.height, ray_.mu, t);
    const double start = text_.radius_of(ray_.height), r = text_.radius_of(h);
    const double mu = std::clamp((start * ray_.mu + t) / r, -1.0, 1.0);
    const glm::dvec3 amount = text_.densities(h) * dt;
    lists_.samples.push_back({float(start / r),
                              float(t / r),
                              float(h),
                              {float(view.x), float(view.y), float(view.z)},
                              float(amount.x),
                              float(amount.y)});
    lists_.places.push_back(list_sample(start / r, t / r, mu, h, text_.height_coordinate(h),
                                        text_.zenith_coordinate(mu), settings_));
    for (const text::BandGroup& band : data_.groups)
      lists_.weights.push_back(
          glm::exp(-text_.optical_depth(band, view)) *
          (band.rayleigh_scattering * amount.x + band.aerosol_scattering * amount.y));
  }

  template <class Place>
  glm::dvec3 add_profile(double begin, double end, bool rising, const glm::dvec3& start,
                         const Place& place) {
    const int nodes = SliceLists::kProfileNodes;
    const size_t first = lists_.profiles.size();
    lists_.profiles.resize(first + nodes);
    glm::dvec3 view = start;
    double last = begin;
    for (int i = 0; i < nodes; ++i) {
      const int node = rising ? i : nodes - 1 - i;
      const double t = std::clamp(place(double(node) / (nodes - 1)), begin, end);
      view += text_.columns_between(ray_, last, t);
      lists_.profiles[first + node] = glm::vec4(view, 0);
      last = t;
    }
    return view;
  }

  const PhysicsData& data_;
  const Settings& settings_;
  Geometry text_;
  text::Ray ray_;
  RowLists lists_;
};

template <class T>
int append(std::vector<T>& all, const std::vector<T>& part) {
  const int first = int(all.size());
  all.insert(all.end(), part.begin(), part.end());
  return first;
}

}  // namespace

ListSample list_sample(double sun_scale, double nu_scale, double mu, double height_km,
                       double height_coordinate, double zenith_coordinate,
                       const Settings& settings) {
  const text::Between height = text::between(height_coordinate, settings.heights - 1);
  return {float(sun_scale),
          float(nu_scale),
          float(mu),
          float(height_km),
          float(zenith_coordinate + height.node * settings.table_zeniths),
          float(height.weight),
          {}};
}

SliceLists slice_lists(const Columns& columns, const PhysicsData& data, const Settings& settings,
                       double height_km, const SliceGrid& grid, const SliceWindow& window) {
  const std::vector<SliceRow> rows = slice_rows(columns, height_km, grid);
  std::vector<RowLists> parts(rows.size());
  parallel_for_ranges(rows.size(), 1, [&](size_t begin, size_t end) {
    for (size_t j = begin; j < end; ++j)
      if (window.has_row(grid, int(j))) parts[j] = RowBuilder(data, settings, rows[j]).build();
  });
  SliceLists lists;
  for (RowLists& part : parts) {
    SliceRowBlock block = part.block;
    block.count = int(part.samples.size());
    block.first = append(lists.samples, part.samples);
    append(lists.places, part.places);
    append(lists.weights, part.weights);
    block.first_piece = append(lists.profiles, part.profiles) / SliceLists::kProfileNodes;
    lists.rows.push_back(block);
  }
  if (lists.profiles.empty()) lists.profiles.resize(SliceLists::kProfileNodes, glm::vec4(0));
  return lists;
}

}  // namespace skylapse::sky::bruneton
