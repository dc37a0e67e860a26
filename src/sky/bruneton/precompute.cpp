#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "gpu/functions.h"
#include "gpu/program.h"
#include "sky/bruneton/gpu_model.h"
#include "sky/bruneton/march_buffers.h"
#include "sky/bruneton/order_tail.h"
#include "sky/bruneton/sun_rows.h"
#include "sky/bruneton/table_file.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr int kGroupSize = 32;  // local_size_x of all passes

/// BLOCK of shaders/shared/contraction.glsl for so many outputs: all are made in equal blocks.
int block_of(int outputs) {
  constexpr int kLargest = 16;
  const int blocks = gpu::groups_for(outputs, kLargest);
  return gpu::groups_for(outputs, blocks);
}

/// What does not depend on bands, made once on the host.
struct HostWork {
  Columns columns;
  PhysicsData data;
  SunNodes suns;
  MarchLists first, next;
  std::vector<float> sun_mu;

  HostWork(const atmosphere::Medium& medium, const Settings& settings)
      : columns(medium),
        data(physics_data(medium, settings, 2)),
        suns(sun_nodes(medium, settings)) {
    parallel_for_ranges(2, 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        (i == 0 ? first : next) = march_lists(
            columns, settings, i == 0 ? settings.first_order_samples : settings.samples);
    });
    for (int j = 0; j < settings.suns; ++j) sun_mu.push_back(float(std::cos(suns.zenith_rad(j))));
  }
};

/// Settings whose sun rows are the nodes: what order_tail.h watches here.
Settings at_nodes(Settings settings) {
  settings.sun_rows_per_interval = 1;
  return settings;
}

/// The passes over one range of groups. Members run inside Context::run.
class Passes {
 public:
  Passes(const gpu::Functions& gl, const atmosphere::Medium& medium, const Settings& settings,
         const HostWork& host, GroupRange range)
      : gl_(gl),
        medium_(medium),
        size_(settings),
        host_(host),
        range_(range),
        fold_(fold_of(settings, gl.context->info().max_texture_3d)) {}

  Status create() {
    if (Status status = compile(); !status) return status;
    auto physics = PhysicsBuffers::create(gl_, host_.data, host_.columns, range_);
    if (!physics) return physics.error();
    physics_ = std::move(physics).value();
    first_ = MarchBuffers::create(gl_, host_.first, size_, range_, true);
    next_ = MarchBuffers::create(gl_, host_.next, size_, range_, false);
    harmonics_ = HarmonicBuffers::create(gl_, medium_, host_.next.rows, size_, range_);
    suns_ = gpu::Buffer::of(gl_, host_.sun_mu);
    sun_nodes_ = gpu::Buffer::of(gl_, std::vector<int>{size_.suns, host_.suns.dark_end, 0, 0});
    for (int g = 0; g < range_.count; ++g) {
      auto texture = gpu::Texture::create(gl_, source_size(size_, fold_), nullptr);
      if (!texture) return texture.error();
      table_.push_back(std::move(texture).value());
      group_index_.push_back(gpu::Buffer::of(gl_, std::vector<int>{g, 0, 0, 0}));
    }
    const int orders = size_.harmonics + 1, suns = size_.suns;
    const int harmonics = orders * (orders + 1) / 2;
    light_ = vectors(rays() * suns * size_.azimuths);
    waves_ = vectors(size_.heights * orders * std::max(rows(), size_.table_zeniths) * suns);
    coefficients_ = vectors(size_.heights * harmonics * suns);
    source_ = vectors(nodes() * size_.table_azimuths);
    total_ = vectors(nodes() * size_.table_azimuths);
    sums_ = vectors(size_.heights * suns);
    irradiance_ = vectors(suns);
    return Done{};
  }

  void first_order() const {
    sun_nodes_.bind_uniform(gl_, 5);  // for all passes
    physics_.bind(gl_, table_);
    first_.bind(gl_);
    march(first_order_);
  }
  /// From source_ and the ground's light of the order before, both by `ground`.
  void next_order(const std::vector<float>& ground_rows) {
    physics_.set_ground(gl_, ground_rows);
    physics_.bind(gl_, table_);
    next_.bind(gl_);
    march(next_order_);
  }

  /// Source of the light that is now in light_, added to the total.
  void gather() const {
    const int orders = size_.harmonics + 1, suns = size_.suns;
    light_.bind_storage(gl_, 0);
    harmonics_.direction_cosines.bind_storage(gl_, 1);
    waves_.bind_storage(gl_, 2);
    contract(gather_azimuths_, rays() * suns, orders);
    waves_.bind_storage(gl_, 0);
    harmonics_.analysis.bind_storage(gl_, 1);
    harmonics_.moments.bind_storage(gl_, 2);
    coefficients_.bind_storage(gl_, 3);
    contract(gather_zeniths_, size_.heights * orders * suns, orders);
    coefficients_.bind_storage(gl_, 0);
    harmonics_.synthesis.bind_storage(gl_, 1);
    waves_.bind_storage(gl_, 2);
    contract(spread_zeniths_, size_.heights * orders * suns, size_.table_zeniths);
    waves_.bind_storage(gl_, 0);
    harmonics_.table_cosines.bind_storage(gl_, 1);
    source_.bind_storage(gl_, 2);
    total_.bind_storage(gl_, 3);
    contract(spread_azimuths_, nodes(), size_.table_azimuths);
  }

  /// The source of the last order, with the rows between the sun nodes, for the next march.
  void fill_tables() const {
    source_.bind_storage(gl_, 0);
    const int items = nodes() / size_.suns * (size_.suns - 1) * size_.table_azimuths;
    for (int g = 0; g < range_.count; ++g) {
      group_index_[g].bind_uniform(gl_, 3);
      table_[g].bind_image(gl_, 0);
      fill_suns_.dispatch(gl_, {gpu::groups_for(items, kGroupSize)});
    }
  }
  /// The sum of all orders of one group: [height][zenith][sun node][azimuth][channel].
  [[nodiscard]] std::vector<float> total(int group) const {
    std::vector<float> values(4 * size_t(nodes()) * size_.table_azimuths);
    const size_t bytes = values.size() * sizeof(float);
    total_.read(gl_, group * bytes, bytes, values.data());
    return values;
  }

  /// Per group, [height][sun node].
  [[nodiscard]] std::vector<OrderSums> source_sums() const {
    source_.bind_storage(gl_, 0);
    sums_.bind_storage(gl_, 1);
    const int items = size_.heights * size_.suns;
    sum_source_.dispatch(gl_, {gpu::groups_for(items, kGroupSize), 1, range_.count});
    return read_groups(sums_, items);
  }
  /// Per group, [sun node].
  [[nodiscard]] std::vector<OrderSums> ground_light() const {
    light_.bind_storage(gl_, 0);
    harmonics_.ground_weights.bind_storage(gl_, 1);
    irradiance_.bind_storage(gl_, 2);
    ground_light_.dispatch(gl_, {gpu::groups_for(size_.suns, kGroupSize), 1, range_.count});
    return read_groups(irradiance_, size_.suns);
  }

  void add_tail(const std::vector<OrderTail>& tails) const {
    std::vector<float> all;
    for (const OrderTail& tail : tails) {
      const std::vector<float> group = floats_of(tail.tail_factors());
      all.insert(all.end(), group.begin(), group.end());
    }
    const gpu::Buffer factors = gpu::Buffer::of(gl_, all);
    source_.bind_storage(gl_, 0);
    factors.bind_storage(gl_, 1);
    total_.bind_storage(gl_, 2);
    add_tail_.dispatch(gl_, {gpu::groups_for(nodes(), kGroupSize), 1, range_.count});
  }

 private:
  [[nodiscard]] int rows() const { return size_.directions_up + size_.directions_down; }
  [[nodiscard]] int rays() const { return size_.heights * rows(); }
  [[nodiscard]] int nodes() const { return size_.heights * size_.table_zeniths * size_.suns; }
  [[nodiscard]] gpu::Buffer vectors(int count) const {
    return gpu::Buffer::create(gl_, size_t(16) * size_t(count) * size_t(range_.count));
  }

  Status compile() {
    std::vector<gpu::Define> defines = physics_defines(
        range_.count, fold_, filter_of(gl_.context->info()), host_.data.air.layer_count > 0);
    const std::vector<gpu::Define> sizes{{"HEIGHTS", size_.heights},
                                         {"ROWS", rows()},
                                         {"UP_ROWS", size_.directions_up},
                                         {"AZIMUTHS", size_.azimuths},
                                         {"DEGREE", size_.harmonics},
                                         {"TABLE_AZIMUTHS", size_.table_azimuths},
                                         {"TABLE_ZENITHS", size_.table_zeniths},
                                         {"ROWS_PER_INTERVAL", size_.sun_rows_per_interval}};
    defines.insert(defines.end(), sizes.begin(), sizes.end());
    const int orders = size_.harmonics + 1;
    const struct {
      gpu::Program* program;
      const char* name;
      int outputs = 1;  // of a contraction
    } programs[] = {{&first_order_, "first_order"},
                    {&next_order_, "next_order"},
                    {&gather_azimuths_, "gather_azimuths", orders},
                    {&gather_zeniths_, "gather_zeniths", orders},
                    {&spread_zeniths_, "spread_zeniths", size_.table_zeniths},
                    {&spread_azimuths_, "spread_azimuths", size_.table_azimuths},
                    {&fill_suns_, "fill_suns"},
                    {&sum_source_, "sum_source"},
                    {&ground_light_, "ground_light"},
                    {&add_tail_, "add_tail"}};
    for (const auto& [program, name, outputs] : programs) {
      std::vector<gpu::Define> with_block = defines;
      with_block.push_back({"BLOCK", block_of(outputs)});
      auto made = gpu::Program::create(gl_, std::string("entry/") + name + ".comp", with_block);
      if (!made) return made.error();
      *program = std::move(made).value();
    }
    return Done{};
  }

  void march(const gpu::Program& program) const {
    suns_.bind_storage(gl_, 3);
    light_.bind_storage(gl_, 5);
    program.dispatch(gl_, {gpu::groups_for(rays() * size_.suns * size_.azimuths, kGroupSize)});
  }
  void contract(const gpu::Program& program, int items, int outputs) const {
    program.dispatch(gl_, {gpu::groups_for(items, kGroupSize),
                           gpu::groups_for(outputs, block_of(outputs)), range_.count});
  }
  [[nodiscard]] std::vector<OrderSums> read_groups(const gpu::Buffer& buffer, int items) const {
    std::vector<glm::vec4> values(size_t(items) * range_.count);
    buffer.read(gl_, 0, values.size() * sizeof(glm::vec4), values.data());
    std::vector<OrderSums> groups;
    for (int g = 0; g < range_.count; ++g)
      groups.emplace_back(values.begin() + size_t(g) * items,
                          values.begin() + size_t(g + 1) * items);
    return groups;
  }

  const gpu::Functions& gl_;
  const atmosphere::Medium& medium_;
  const Settings& size_;
  const HostWork& host_;
  GroupRange range_;
  int fold_;
  gpu::Program first_order_, next_order_, gather_azimuths_, gather_zeniths_, spread_zeniths_,
      spread_azimuths_, fill_suns_, sum_source_, ground_light_, add_tail_;
  PhysicsBuffers physics_;
  MarchBuffers first_, next_;
  HarmonicBuffers harmonics_;
  gpu::Buffer suns_, sun_nodes_, light_, waves_, coefficients_, source_, total_, sums_, irradiance_;
  std::vector<gpu::Buffer> group_index_;
  std::vector<gpu::Texture> table_;
};

Error stopped() {
  return {ErrorCode::interrupted, "the tables of the atmosphere were not finished", {}, {}};
}

/// One range of groups from the first order to finished tables.
class Range {
 public:
  Range(const Settings& settings, const HostWork& host, GroupRange range)
      : size_(settings), host_(host), tails_(range.count, OrderTail(at_nodes(settings))) {}

  Status compute(Passes& passes, Tables& tables, const Progress& progress) {
    passes.first_order();
    std::vector<OrderSums> light = passes.ground_light();
    ground_ = light;
    passes.gather();
    while (!watch(passes)) {
      if (!progress(share_done())) return stopped();
      passes.fill_tables();
      passes.next_order(rows_of(light));
      light = passes.ground_light();
      for (size_t g = 0; g < light.size(); ++g) add(ground_[g], light[g], {});
      passes.gather();
    }
    passes.add_tail(tails_);
    for (size_t g = 0; g < light.size(); ++g)
      add(ground_[g], light[g], tails_[g].ground_tail_factors());
    finish(passes, tables);
    return Done{};
  }

 private:
  bool watch(const Passes& passes) {
    const std::vector<OrderSums> sums = passes.source_sums();
    bool done = true;
    for (size_t g = 0; g < sums.size(); ++g) {
      tails_[g].add(sums[g]);
      done = tails_[g].done() && done;
    }
    return done;
  }
  /// Adds `order` times `factors`, or once.
  static void add(OrderSums& sum, const OrderSums& order, const OrderSums& factors) {
    for (size_t i = 0; i < sum.size(); ++i)
      sum[i] += factors.empty() ? order[i] : order[i] * factors[i];
  }
  /// All sun rows of one group's light on the ground.
  [[nodiscard]] std::vector<float> rows_of(OrderSums nodes) const {
    if (host_.suns.dark_end) nodes.back() = glm::dvec4(0);
    std::vector<glm::dvec4> rows(size_.sun_rows());
    upsample_suns(&nodes[0][0], 4, &rows[0][0], 4, 4, size_, host_.suns.dark_end);
    return floats_of(rows);
  }
  [[nodiscard]] std::vector<float> rows_of(const std::vector<OrderSums>& groups) const {
    std::vector<float> all;
    for (const OrderSums& group : groups) {
      const std::vector<float> rows = rows_of(group);
      all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
  }
  /// Orders fall geometrically: the logarithm of the last addition runs evenly to its end.
  [[nodiscard]] double share_done() const {
    double worst = 0;
    for (const OrderTail& tail : tails_)
      for (int c = 0; c < 4; ++c) worst = std::max(worst, tail.last_addition()[c]);
    if (worst <= 0 || worst >= 1) return 0.2;
    return std::clamp(std::log(worst) / std::log(size_.stop_below), 0.2, 0.95);
  }
  /// All rows of one group's source with those at the sun nodes in their places, the others dark.
  [[nodiscard]] std::vector<float> spread_nodes(const std::vector<float>& nodes) const {
    const size_t row = size_t(4) * size_.table_azimuths, slabs = nodes.size() / (row * size_.suns);
    std::vector<float> rows(slabs * size_.sun_rows() * row, 0.0f);
    for (size_t slab = 0; slab < slabs; ++slab)
      for (size_t j = 0; j < size_t(size_.suns); ++j)
        std::copy_n(&nodes[(slab * size_.suns + j) * row], row,
                    &rows[(slab * size_.sun_rows() + j * size_.sun_rows_per_interval) * row]);
    return rows;
  }
  void finish(const Passes& passes, Tables& tables) const {
    for (size_t g = 0; g < tails_.size(); ++g) {
      tables.source.push_back(spread_nodes(passes.total(int(g))));
      tables.ground_irradiance.push_back(rows_of(ground_[g]));
      tables.orders = std::max(tables.orders, tails_[g].orders());
      for (int c = 0; c < 4 && tables.tail_ratio.size() < tables.medium.bands.size(); ++c) {
        tables.last_addition.push_back(tails_[g].last_addition()[c]);
        tables.tail_ratio.push_back(tails_[g].ratio()[c]);
      }
    }
  }

  const Settings& size_;
  const HostWork& host_;
  std::vector<OrderTail> tails_;
  std::vector<OrderSums> ground_;  // summed over the orders
};

}  // namespace

Result<Tables> precompute(gpu::Context& context, const atmosphere::Medium& medium,
                          const Settings& settings, const Progress& progress) {
  const HostWork host(medium, settings);
  Tables tables{medium, settings, {}, {}, 0, {}, {}};
  const std::vector<GroupRange> ranges = group_ranges(tables.groups());
  for (size_t i = 0; i < ranges.size(); ++i) {
    const auto report = [&](double share) {
      return !progress || progress((double(i) + share) / double(ranges.size()));
    };
    const Status status = context.run([&](const gpu::Functions& gl) -> Status {
      Passes passes(gl, medium, settings, host, ranges[i]);
      if (Status created = passes.create(); !created) return created;
      return Range(settings, host, ranges[i]).compute(passes, tables, report);
    });
    if (!status) return status.error();
    if (!report(1)) return stopped();
  }
  refill_sun_rows(tables);
  return tables;
}

}  // namespace skylapse::sky::bruneton
