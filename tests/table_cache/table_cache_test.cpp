#include "sky/bruneton/table_cache.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <thread>

#include "sky/bruneton/table_file.h"
#include "support/temporary_folder.h"

namespace skylapse::sky::bruneton {
namespace {
namespace fs = std::filesystem;

Settings small_settings() {
  Settings settings;
  settings.heights = 3, settings.suns = 4, settings.sun_rows_per_interval = 2;
  settings.table_azimuths = 5, settings.table_zeniths = 6;
  return settings;
}

/// Tables with a different number in each place; `salt` makes another medium of it.
Tables sample_tables(double salt = 0) {
  Tables tables;
  tables.medium = atmosphere::reference_medium();
  tables.medium.bands.resize(2);
  tables.medium.aerosol_g = 0.5 + salt / 1000;
  tables.medium.bands.insert(tables.medium.bands.end(), 3, tables.medium.bands[0]);  // two groups
  tables.settings = small_settings();
  const size_t source = 4 * 3 * 6 * 7 * 5;
  tables.source.assign(2, std::vector<float>(source));
  tables.ground_irradiance.assign(2, std::vector<float>(4 * 7));
  float next = 0;
  for (auto* part : {&tables.source, &tables.ground_irradiance})
    for (auto& group : *part)
      for (float& number : group) number = std::sin(next += 1) + float(salt);
  tables.orders = 7;
  tables.last_addition = {0.01, 0.02, 0.03, 0.04, 0.05};
  tables.tail_ratio = {0.1, 0.2, 0.3, 0.4, 0.5};
  return tables;
}

void expect_equal(const Tables& a, const Tables& b) {
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.ground_irradiance, b.ground_irradiance);
  EXPECT_EQ(a.orders, b.orders);
  EXPECT_EQ(a.last_addition, b.last_addition);
  EXPECT_EQ(a.tail_ratio, b.tail_ratio);
  EXPECT_EQ(canonical_text(a.medium), canonical_text(b.medium));
}

std::optional<Tables> find(const TableCache& cache, const Tables& tables) {
  return cache.find(tables.medium, tables.settings);
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void overwrite(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

void set_age(const fs::path& path, int hours) {
  fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(hours));
}

class TableCacheTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  TableCache cache_{folder_ / "cache"};
};

TEST_F(TableCacheTest, GivesBackEveryNumberThatWasStored) {
  const Tables tables = sample_tables();
  EXPECT_FALSE(find(cache_, tables));
  ASSERT_TRUE(cache_.store(tables).ok());
  const auto found = find(cache_, tables);
  ASSERT_TRUE(found);
  expect_equal(*found, tables);
  // One file, no temporaries.
  EXPECT_EQ(std::distance(fs::directory_iterator(cache_.folder()), {}), 1);
}

TEST_F(TableCacheTest, RowsBetweenTheSunNodesAreRefilledToTheBit) {
  Tables tables = sample_tables();
  tables.settings.sun_rows_per_interval = 8;
  const size_t rows = size_t(tables.settings.sun_rows()), source = 4 * 3 * 6 * rows * 5;
  for (auto& group : tables.source) group.resize(source);
  for (auto& group : tables.ground_irradiance) group.resize(4 * rows);
  float next = 0;
  for (auto& group : tables.source)
    for (float& number : group) number = std::exp(5 * std::sin(next += 0.7F));
  ASSERT_TRUE(cache_.store(tables, "all rows").ok());
  refill_sun_rows(tables);
  ASSERT_TRUE(cache_.store(tables, "nodes").ok());
  const auto size = [&](const char* maker) {
    return fs::file_size(cache_.path_of(tables.medium, tables.settings, maker));
  };
  EXPECT_LT(5 * size("nodes"), size("all rows"));
  const auto found = cache_.find(tables.medium, tables.settings, "nodes");
  ASSERT_TRUE(found);
  expect_equal(*found, tables);
}

TEST_F(TableCacheTest, RefillingKeepsTheNodesAndIsDoneOnce) {
  Tables tables = sample_tables();
  const Tables before = tables;
  refill_sun_rows(tables);
  const size_t row = 4 * 5, per = size_t(tables.settings.sun_rows_per_interval);
  for (size_t sun = 0; sun < size_t(tables.settings.suns); ++sun)
    for (size_t i = 0; i < row; ++i)
      EXPECT_EQ(tables.source[0][sun * per * row + i], before.source[0][sun * per * row + i]);
  const Tables once = tables;
  refill_sun_rows(tables);
  expect_equal(tables, once);
}

TEST_F(TableCacheTest, TablesOfWrongSizeAreNotKept) {
  Tables tables = sample_tables();
  tables.source[1].pop_back();
  EXPECT_FALSE(cache_.store(tables).ok());
}

TEST_F(TableCacheTest, TellsMediaSettingsAndMakersApart) {
  const Tables tables = sample_tables();
  ASSERT_TRUE(cache_.store(tables, "a driver").ok());
  EXPECT_TRUE(cache_.find(tables.medium, tables.settings, "a driver"));
  EXPECT_FALSE(cache_.find(tables.medium, tables.settings, "another driver"));
  atmosphere::Medium medium = tables.medium;
  medium.bands[4].ground_albedo = std::nextafter(medium.bands[4].ground_albedo, 1);
  EXPECT_FALSE(cache_.find(medium, tables.settings, "a driver"));
  Settings settings = tables.settings;
  settings.stop_below = 0.029;
  EXPECT_FALSE(cache_.find(tables.medium, settings, "a driver"));
}

TEST_F(TableCacheTest, WeightsOfTheEyeDoNotShapeTables) {
  const Tables tables = sample_tables();
  ASSERT_TRUE(cache_.store(tables).ok());
  atmosphere::Medium medium = tables.medium;
  medium.bands[0].xyz_weight = {1, 2, 3};
  const auto found = cache_.find(medium, tables.settings);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->source, tables.source);
  EXPECT_EQ(found->medium.bands[0].xyz_weight.y, 2);
}

TEST_F(TableCacheTest, ADamagedByteAnywhereIsNoticedAndTheFileGoes) {
  const Tables tables = sample_tables();
  ASSERT_TRUE(cache_.store(tables).ok());
  const fs::path path = cache_.path_of(tables.medium, tables.settings);
  const std::string good = contents(path);
  ASSERT_GT(good.size(), 10000u);
  // The whole header, then every 97th byte, and the last.
  for (size_t i = 0; i < good.size(); i += i < 300 ? 1 : 97) {
    std::string bad = good;
    bad[i] = char(bad[i] ^ 1);
    overwrite(path, bad);
    EXPECT_FALSE(find(cache_, tables)) << "byte " << i;
    EXPECT_FALSE(fs::exists(path));
  }
  std::string bad = good;
  bad.back() = char(bad.back() ^ 1);
  overwrite(path, bad);
  EXPECT_FALSE(find(cache_, tables));
  // Rebuilt, it serves again.
  ASSERT_TRUE(cache_.store(tables).ok());
  EXPECT_TRUE(find(cache_, tables));
}

TEST_F(TableCacheTest, TruncatedAndLengthenedFilesAreNoticed) {
  const Tables tables = sample_tables();
  ASSERT_TRUE(cache_.store(tables).ok());
  const fs::path path = cache_.path_of(tables.medium, tables.settings);
  const std::string good = contents(path);
  for (const size_t size : {size_t{0}, size_t{10}, size_t{224}, good.size() / 2, good.size() - 1}) {
    overwrite(path, good.substr(0, size));
    EXPECT_FALSE(find(cache_, tables)) << size;
  }
  overwrite(path, good + '\0');
  EXPECT_FALSE(find(cache_, tables));
}

TEST_F(TableCacheTest, AFileUnderAnothersNameIsNotFound) {
  const Tables a = sample_tables(1), b = sample_tables(2);
  ASSERT_TRUE(cache_.store(a).ok());
  fs::rename(cache_.path_of(a.medium, a.settings), cache_.path_of(b.medium, b.settings));
  EXPECT_FALSE(find(cache_, b));
}

TEST_F(TableCacheTest, NumbersThatAreNotFiniteAreNotKept) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Tables tables = sample_tables();
    tables.source[1].back() = bad;
    EXPECT_FALSE(cache_.store(tables).ok());
    EXPECT_FALSE(find(cache_, tables));
  }
}

TEST_F(TableCacheTest, TheFileUnusedForLongestGoesFirst) {
  const Tables a = sample_tables(1), b = sample_tables(2), c = sample_tables(3);
  ASSERT_TRUE(cache_.store(a).ok());
  const uint64_t size = fs::file_size(cache_.path_of(a.medium, a.settings));
  const TableCache bounded(cache_.folder(), 2 * size + size / 2);
  ASSERT_TRUE(bounded.store(b).ok());
  set_age(bounded.path_of(a.medium, a.settings), 20);
  set_age(bounded.path_of(b.medium, b.settings), 10);
  EXPECT_TRUE(find(bounded, a));  // which makes it the younger
  ASSERT_TRUE(bounded.store(c).ok());
  EXPECT_TRUE(find(bounded, a));
  EXPECT_FALSE(find(bounded, b));
  EXPECT_TRUE(find(bounded, c));
}

TEST_F(TableCacheTest, TheBoundIsKeptOverManyTables) {
  const TableCache bounded(cache_.folder(), 100000);
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(bounded.store(sample_tables(i)).ok());
    uint64_t total = 0;
    for (const auto& entry : fs::directory_iterator(bounded.folder())) total += entry.file_size();
    EXPECT_LE(total, 100000u);
    EXPECT_TRUE(find(bounded, sample_tables(i)));
  }
}

TEST_F(TableCacheTest, TablesLargerThanTheBoundAreNotKept) {
  const TableCache tiny(cache_.folder(), 1000);
  EXPECT_TRUE(tiny.store(sample_tables()).ok());
  EXPECT_FALSE(find(tiny, sample_tables()));
}

TEST_F(TableCacheTest, WorksWithoutAFolderThatCanBeWritten) {
  // A file where the folder should be: even root cannot write below it.
  overwrite(folder_ / "file", "x");
  const TableCache blocked(folder_ / "file" / "cache");
  const Status status = blocked.store(sample_tables());
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::write_failed);
  EXPECT_NE(status.error().message.find("cache"), std::string::npos);
  EXPECT_FALSE(find(blocked, sample_tables()));
  const TableCache none({});
  EXPECT_TRUE(none.store(sample_tables()).ok());
  EXPECT_FALSE(find(none, sample_tables()));
}

TEST_F(TableCacheTest, TemporariesOfDeadWritersGo) {
  ASSERT_TRUE(cache_.store(sample_tables()).ok());
  const fs::path old = cache_.folder() / ".a.skytables.1.2.3.tmp";
  const fs::path fresh = cache_.folder() / ".b.skytables.1.2.3.tmp";
  overwrite(old, "x");
  overwrite(fresh, "x");
  set_age(old, 2);
  ASSERT_TRUE(cache_.store(sample_tables()).ok());
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(fresh));
}

/// An environment variable for the length of a test.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Environment() { set(old_ ? old_->c_str() : nullptr); }

 private:
  void set(const char* value) { value ? ::setenv(name_, value, 1) : ::unsetenv(name_); }
  const char* name_;
  std::optional<std::string> old_;
};

constexpr const char* kSharedFolder = "SKYLAPSE_TEST_SHARED_CACHE";

/// Stores and finds two tables in turn, in a cache with room for one file only, so that writers
/// also evict what others read. True if all that was found was right.
bool write_and_read(const fs::path& folder) {
  const Tables one = sample_tables(1), two = sample_tables(2);
  const TableCache bounded(folder, one.bytes() * 3 / 2);
  for (int i = 0; i < 60; ++i) {
    if (!bounded.store(i % 2 == 0 ? one : two).ok()) return false;
    for (const Tables* tables : {&one, &two})
      if (const auto found = find(bounded, *tables))
        if (found->source != tables->source) return false;
  }
  return true;
}

// Not a test: what the children of the next one run, as programs of their own (a fork without exec
// would leave them without the threads that the checksums run on).
TEST(TableCacheChild, DISABLED_WritesAndReads) {
  const char* folder = std::getenv(kSharedFolder);
  ASSERT_NE(folder, nullptr);
  EXPECT_TRUE(write_and_read(folder));
}

TEST_F(TableCacheTest, ThreadsAndProcessesMayWriteAndReadAtOnce) {
  const Environment shared(kSharedFolder, cache_.folder().c_str());
  std::vector<pid_t> children;
  for (int i = 0; i < 3; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::execl("/proc/self/exe", "test_table_cache", "--gtest_also_run_disabled_tests",
              "--gtest_brief=1", "--gtest_filter=TableCacheChild.*", nullptr);
      ::_exit(127);
    }
    children.push_back(child);
  }
  bool here[2] = {false, false};
  std::thread first([&] { here[0] = write_and_read(cache_.folder()); });
  std::thread second([&] { here[1] = write_and_read(cache_.folder()); });
  first.join();
  second.join();
  EXPECT_TRUE(here[0] && here[1]);
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
}

TEST(TableCacheStandard, LiesWhereTheXdgSpecificationSays) {
  const Environment home("HOME", "/home/someone"), limit("SKYLAPSE_CACHE_LIMIT", nullptr);
  {
    const Environment xdg("XDG_CACHE_HOME", "/somewhere");
    EXPECT_EQ(TableCache::standard().folder(), "/somewhere/skylapse");
    EXPECT_EQ(TableCache::standard().limit_bytes(), TableCache::kDefaultLimit);
  }
  for (const char* unusable : {static_cast<const char*>(nullptr), "", "relative"}) {
    const Environment xdg("XDG_CACHE_HOME", unusable);
    EXPECT_EQ(TableCache::standard().folder(), "/home/someone/.cache/skylapse");
  }
  const Environment no_xdg("XDG_CACHE_HOME", nullptr), no_home("HOME", nullptr);
  EXPECT_FALSE(TableCache::standard().enabled());
  EXPECT_FALSE(TableCache::standard().note().empty());
}

TEST(TableCacheStandard, TakesItsBoundFromTheEnvironment) {
  const Environment xdg("XDG_CACHE_HOME", "/somewhere");
  const auto limit_of = [](const char* text) {
    const Environment limit("SKYLAPSE_CACHE_LIMIT", text);
    return TableCache::standard();
  };
  EXPECT_EQ(limit_of("1234").limit_bytes(), 1234u);
  EXPECT_EQ(limit_of("3M").limit_bytes(), 3u << 20);
  EXPECT_EQ(limit_of("1G").limit_bytes(), 1u << 30);
  EXPECT_FALSE(limit_of("0").enabled());
  for (const char* nonsense : {"", "-1", "2 GB", "many", "99999999999999999999", "99999999999G"}) {
    EXPECT_EQ(limit_of(nonsense).limit_bytes(), TableCache::kDefaultLimit) << nonsense;
    EXPECT_FALSE(limit_of(nonsense).note().empty()) << nonsense;
  }
}

}  // namespace
}  // namespace skylapse::sky::bruneton
