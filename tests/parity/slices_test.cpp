// Slices in float on GL against slices in double on the same tables.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "parity/twins.h"
#include "sky/bruneton/half_source.h"

namespace skylapse::sky::bruneton {
namespace {

/// The reference medium with weights that let each band through in its own channel.
std::shared_ptr<const Tables> visible_tables() {
  static const auto tables = [] {
    Tables copy = *reference_tables();
    for (int b = 0; b < 3; ++b) copy.medium.bands[b].xyz_weight[b] = 1;
    return std::make_shared<const Tables>(std::move(copy));
  }();
  return tables;
}

/// Greatest distance of a layer relative to its brightest texel.
double distance(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    float brightest = 0;
    for (const glm::vec4& texel : b) brightest = std::max(brightest, texel[c]);
    for (size_t i = 0; i < b.size() && brightest > 0; ++i)
      worst = std::max(worst, std::abs(double(a[i][c]) - b[i][c]) / brightest);
  }
  return worst;
}

/// The twin's slice of visible_tables, made once for all contexts.
const SkySlice& twin_slice(Length height, Angle sun, const SliceGrid& grid, SliceContent content) {
  using Key = std::tuple<double, double, bool, bool>;
  static std::map<Key, SkySlice> slices;
  static const Twin twin(visible_tables());
  const Key key{height.in(km), sun.in(deg), content.multiple_scattering, content.ground};
  const auto found = slices.find(key);
  if (found != slices.end()) return found->second;
  const MarchSettings march{.multiple_scattering = content.multiple_scattering,
                            .ground = content.ground};
  return slices.emplace(key, twin.slice(height, sun, grid, march)).first->second;
}

class AnySlice : public gpu::AnyContext {
 protected:
  void SetUp() override {
    AnyContext::SetUp();
    if (context_ == nullptr) return;
    auto model = GpuModel::create(context_, *visible_tables());
    ASSERT_TRUE(model.ok()) << model.error().message;
    model_.emplace(std::move(model).value());
  }
  void compare(Length height, Angle sun, SliceContent content) {
    const auto tables = visible_tables();
    const SliceGrid grid = slice_grid(tables->medium, height, 13, 18);
    const auto gl = model_->slice(height, sun, grid, content);
    ASSERT_TRUE(gl.ok()) << gl.error().message;
    const SkySlice& twin = twin_slice(height, sun, grid, content);
    EXPECT_EQ(gl->aerosol_g, twin.aerosol_g);
    EXPECT_EQ(gl->sun_zenith_rad, twin.sun_zenith_rad);
    // Float, and llvmpipe's exponential (1e-6): a hundred samples add up to a few 1e-5. The columns
    // from the camera are better here than by the twin's three nodes between samples (1e-3 at the
    // limb). Far below the horizon the twin also cuts multiple scattering at the shadow, GL
    // does not: both are within 1e-2 of 64 samples there (bench_atmosphere --twin).
    const double tolerance = sun > 100 * deg ? 1e-2 : 2e-3;
    EXPECT_LT(distance(gl->smooth, twin.smooth), tolerance)
        << height.in(km) << " km, sun " << sun.in(deg);
    EXPECT_LT(distance(gl->aerosol, twin.aerosol), tolerance)
        << height.in(km) << " km, sun " << sun.in(deg);
  }
  std::optional<GpuModel> model_;
};

TEST_P(AnySlice, IsTheTwinsFromTheGroundToSpaceAtEverySun) {
  for (const double height_km : {0.0, 0.001, 2.0, 11.0, 59.999, 60.001, 400.0, 36000.0})
    for (const double sun_deg : {0.0, 40.0, 89.5, 91.0, 97.0, 105.0, 180.0})
      compare(height_km * km, sun_deg * deg, {});
}

TEST_P(AnySlice, HoldsWhatWasAskedFor) {
  for (const bool multiple : {false, true})
    for (const bool ground : {false, true})
      compare(1.5 * km, 70 * deg, {.multiple_scattering = multiple, .ground = ground});
}

TEST_P(AnySlice, LeavesOutTheAirBeforeTheGroundAsTheTwinDoes) {
  const SliceGrid grid = slice_grid(visible_tables()->medium, 3 * km, 9, 16);
  const auto gl = model_->slice(3 * km, 60 * deg, grid, {.aerial_perspective = false});
  ASSERT_TRUE(gl.ok()) << gl.error().message;
  const SkySlice twin =
      Twin(visible_tables())
          .slice(3 * km, 60 * deg, grid, {.ground = true, .aerial_perspective = false});
  EXPECT_LT(distance(gl->smooth, twin.smooth), 1e-4);
  EXPECT_LT(distance(gl->aerosol, twin.aerosol), 1e-4);
}

TEST_P(AnySlice, APartHasTheBitsOfTheWholeAndNothingElse) {
  const SliceGrid grid = slice_grid(visible_tables()->medium, 1 * km, 41, 18);
  const SliceWindow windows[] = {
      {{2, 5}, {}, {3, 40}}, {{}, {0, 9}, {0, 2}}, {{0, 1}, {8, 9}, {40, 41}}, whole_window(grid)};
  const auto whole = model_->slice(1 * km, 93 * deg, grid, {});
  ASSERT_TRUE(whole.ok()) << whole.error().message;
  for (const SliceWindow& window : windows) {
    const auto part = model_->slice(1 * km, 93 * deg, grid, {.window = window});
    ASSERT_TRUE(part.ok()) << part.error().message;
    for (int row = 0; row < grid.zeniths; ++row)
      for (int i = 0; i < grid.azimuths; ++i) {
        const bool inside =
            window.has_row(grid, row) && i >= window.azimuths.begin && i < window.azimuths.end;
        const size_t node = size_t(row) * grid.azimuths + i;
        ASSERT_EQ(part->smooth[node], inside ? whole->smooth[node] : glm::vec4(0))
            << row << ' ' << i;
        EXPECT_EQ(part->aerosol[node], inside ? whole->aerosol[node] : glm::vec4(0));
      }
  }
}

TEST_P(AnySlice, OfHalfFloatsIsTheTwinsOnRoundedTables) {
  const auto model = GpuModel::create(context_, *visible_tables(), {.half_source = true});
  ASSERT_TRUE(model.ok()) << model.error().message;
  const Twin twin(std::make_shared<const Tables>(rounded_to_half(*visible_tables())));
  for (const double sun_deg : {20.0, 89.0, 96.0}) {
    const SliceGrid grid = slice_grid(visible_tables()->medium, 0.5 * km, 13, 18);
    const auto gl = model->slice(0.5 * km, sun_deg * deg, grid, {});
    ASSERT_TRUE(gl.ok()) << gl.error().message;
    const SkySlice judge = twin.slice(0.5 * km, sun_deg * deg, grid, {.ground = true});
    // As float tables do (compare()): the rounding itself is in both.
    EXPECT_LT(distance(gl->smooth, judge.smooth), 2e-3) << sun_deg;
    const auto single = model_->slice(0.5 * km, sun_deg * deg, grid, {});
    ASSERT_TRUE(single.ok());
    EXPECT_LT(distance(gl->smooth, single->smooth), 4.9e-4) << sun_deg;
    EXPECT_NE(gl->smooth, single->smooth);
  }
}

TEST_P(AnySlice, TakesTheStepsThatItsModelWasMadeWith) {
  const SliceGrid grid = slice_grid(visible_tables()->medium, 0.5 * km, 13, 18);
  for (const int steps : {1, 5, 64}) {
    const auto model = GpuModel::create(context_, *visible_tables(), {.samples = steps});
    ASSERT_TRUE(model.ok()) << model.error().message;
    const auto gl = model->slice(0.5 * km, 70 * deg, grid, {});
    ASSERT_TRUE(gl.ok()) << gl.error().message;
    // The view's columns are summed from step to step, which few steps show: 3-point Gauss each.
    EXPECT_LT(distance(gl->smooth,
                       Twin(visible_tables())
                           .slice(0.5 * km, 70 * deg, grid, {.samples = steps, .ground = true})
                           .smooth),
              2e-3)
        << steps;
  }
}

TEST_P(AnySlice, WithoutSourceTablesIsSingleScattering) {
  Tables empty = *visible_tables();
  empty.source.clear();
  empty.ground_irradiance.clear();
  const auto model = GpuModel::create(context_, empty);
  ASSERT_TRUE(model.ok()) << model.error().message;
  const SliceGrid grid = slice_grid(empty.medium, 0 * km, 8, 12);
  const auto slice = model->slice(0 * km, 50 * deg, grid, {});
  ASSERT_TRUE(slice.ok());
  const SkySlice twin =
      Twin(std::make_shared<const Tables>(empty)).slice(0 * km, 50 * deg, grid, {.ground = true});
  EXPECT_LT(distance(slice->smooth, twin.smooth), 1e-4);
}

TEST_P(AnySlice, OfAVeilInTheStratosphereIsTheTwins) {
  atmosphere::Medium medium = standard_medium(4);
  medium.top_height_km = 100;
  for (atmosphere::DensityTerm term :
       atmosphere::tent_profile(16.0 * km, 21.0 * km, 26.0 * km).terms) {
    term.slope_per_km *= 5;
    term.constant *= 5;
    medium.aerosol.terms.push_back(term);
  }
  Tables bare;  // single scattering: what the layers' own columns and cuts are for
  bare.medium = medium;
  const auto model = GpuModel::create(context_, bare);
  ASSERT_TRUE(model.ok()) << model.error().message;
  const Twin twin(std::make_shared<const Tables>(bare));
  for (const double sun_deg : {30.0, 86.2, 92.0}) {
    const SliceGrid grid = slice_grid(medium, 0.1 * km, 12, 20);
    const auto gl = model->slice(0.1 * km, sun_deg * deg, grid, {});
    ASSERT_TRUE(gl.ok()) << gl.error().message;
    const SkySlice judge = twin.slice(0.1 * km, sun_deg * deg, grid, {.ground = true});
    // Profiles of the view's columns between nodes, as in every ray that is cut at a shadow.
    EXPECT_LT(distance(gl->smooth, judge.smooth), 2e-3) << sun_deg;
    EXPECT_LT(distance(gl->aerosol, judge.aerosol), 2e-3) << sun_deg;
  }
}

TEST_P(AnySlice, ManyBandsAreSummedOverAllRanges) {
  const atmosphere::Medium medium = standard_medium(18);
  const auto tables = std::make_shared<const Tables>(precompute_twin(medium, odd_settings()));
  const auto model = GpuModel::create(context_, *tables);
  ASSERT_TRUE(model.ok()) << model.error().message;
  const SliceGrid grid = slice_grid(medium, 1 * km, 9, 10);
  const auto gl = model->slice(1 * km, 80 * deg, grid, {});
  ASSERT_TRUE(gl.ok()) << gl.error().message;
  const SkySlice twin = Twin(tables).slice(1 * km, 80 * deg, grid, {.ground = true});
  EXPECT_LT(distance(gl->smooth, twin.smooth), 1e-4);
  EXPECT_LT(distance(gl->aerosol, twin.aerosol), 1e-4);
}

SKYLAPSE_ON_EVERY_CONTEXT(AnySlice);

}  // namespace
}  // namespace skylapse::sky::bruneton
