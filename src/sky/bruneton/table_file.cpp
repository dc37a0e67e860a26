#include "sky/bruneton/table_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <system_error>
#include <utility>

#include "core/parallel.h"
#include "core/sha256.h"
#include "sky/bruneton/sun_rows.h"

namespace skylapse::sky::bruneton {
namespace fs = std::filesystem;
namespace {

constexpr char kMagic[8] = {'S', 'K', 'Y', 'T', 'A', 'B', 'L', 'E'};
constexpr uint32_t kFormat = 2;
constexpr const char* kTemporarySuffix = ".tmp";
constexpr size_t kDigits = 64;

/// In the byte order of the machine, as all that follows; `format` read the other way round is no
/// known format. The sections come behind it in the order of sections().
struct Header {
  char magic[8];
  uint32_t format;
  int32_t orders;
  uint32_t bands;
  uint32_t groups;
  uint32_t rows;  // of the sun, stored: all, or those at the nodes
  uint32_t unused;
  char key[kDigits];
  char checksum[kDigits];  // of all sections' checksums, in their order
  char header_checksum[kDigits];
};
static_assert(sizeof(Header) == 32 + 3 * kDigits);

std::string checksum_of(Header header) {
  std::memset(header.header_checksum, 0, kDigits);
  return sha256_hex(std::as_bytes(std::span(&header, 1)));
}

using Bytes = std::span<std::byte>;

/// The memory of all arrays.
std::vector<Bytes> sections(Tables& tables) {
  std::vector<Bytes> all;
  for (auto& group : tables.source) all.push_back(std::as_writable_bytes(std::span(group)));
  for (auto& group : tables.ground_irradiance)
    all.push_back(std::as_writable_bytes(std::span(group)));
  all.push_back(std::as_writable_bytes(std::span(tables.last_addition)));
  all.push_back(std::as_writable_bytes(std::span(tables.tail_ratio)));
  return all;
}

std::string checksum_of(const std::vector<Bytes>& parts) {
  std::vector<std::string> digests(parts.size());
  parallel_for_ranges(parts.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) digests[i] = sha256_hex(parts[i]);
  });
  std::string joined;
  for (const std::string& digest : digests) joined += digest;
  return sha256_hex(joined);
}

size_t size_of(int n) { return size_t(n > 0 ? n : 0); }

/// Tables of the right sizes, to be filled; `rows` of the sun.
Tables empty_tables(const atmosphere::Medium& medium, const Settings& settings, size_t rows) {
  Tables tables;
  tables.medium = medium;
  tables.settings = settings;
  const size_t source = 4 * size_of(settings.heights) * size_of(settings.table_zeniths) * rows *
                        size_of(settings.table_azimuths);
  tables.source.assign(size_of(tables.groups()), std::vector<float>(source));
  tables.ground_irradiance.assign(size_of(tables.groups()), std::vector<float>(4 * rows));
  tables.last_addition.assign(medium.bands.size(), 0);
  tables.tail_ratio.assign(medium.bands.size(), 0);
  return tables;
}

/// How one group's numbers lie in memory: `slabs` tables of sun rows, `width` numbers a row.
struct Slabs {
  size_t count = 1, width = 4;
};
Slabs source_slabs(const Settings& settings) {
  return {size_of(settings.heights) * size_of(settings.table_zeniths),
          4 * size_of(settings.table_azimuths)};
}

/// The rows at the sun nodes alone.
std::vector<float> node_rows(const std::vector<float>& from, Slabs slabs,
                             const Settings& settings) {
  const size_t suns = size_of(settings.suns), rows = size_of(settings.sun_rows());
  std::vector<float> nodes(slabs.count * suns * slabs.width);
  for (size_t slab = 0; slab < slabs.count; ++slab)
    for (size_t sun = 0; sun < suns; ++sun)
      std::copy_n(&from[(slab * rows + sun * size_t(settings.sun_rows_per_interval)) * slabs.width],
                  slabs.width, &nodes[(slab * suns + sun) * slabs.width]);
  return nodes;
}

/// All rows from those at the nodes.
std::vector<float> all_rows(const std::vector<float>& nodes, Slabs slabs, const Tables& tables) {
  const Settings& settings = tables.settings;
  const bool dark_end = sun_nodes(tables.medium, settings).dark_end;
  const size_t suns = size_of(settings.suns), count = size_of(settings.sun_rows());
  const size_t width = slabs.width;
  std::vector<float> rows(slabs.count * count * width);
  parallel_for_ranges(slabs.count, 8, [&](size_t begin, size_t end) {
    std::vector<double> in(suns * width), out(count * width);
    for (size_t slab = begin; slab < end; ++slab) {
      std::copy_n(&nodes[slab * suns * width], suns * width, in.begin());
      upsample_suns(in.data(), width, out.data(), width, int(width), settings, dark_end);
      for (size_t i = 0; i < out.size(); ++i) rows[slab * count * width + i] = float(out[i]);
    }
  });
  return rows;
}

/// The same tables with each group's numbers changed; one group at a time, for memory.
template <class Change>
void change_groups(Tables& tables, const Change& change) {
  for (auto& group : tables.source) group = change(group, source_slabs(tables.settings));
  for (auto& group : tables.ground_irradiance) group = change(group, Slabs{});
}

/// Whether the rows between the sun nodes are those that refill_sun_rows() makes, to the bit.
bool nodes_suffice(const Tables& tables) {
  const auto suffice = [&](const std::vector<float>& group, Slabs slabs) {
    return all_rows(node_rows(group, slabs, tables.settings), slabs, tables) == group;
  };
  for (const auto& group : tables.source)
    if (!suffice(group, source_slabs(tables.settings))) return false;
  for (const auto& group : tables.ground_irradiance)
    if (!suffice(group, Slabs{})) return false;
  return true;
}

bool right_sizes(const Tables& tables) {
  const Settings& settings = tables.settings;
  const size_t rows = size_of(settings.sun_rows()), groups = size_t(tables.groups());
  const auto all_of_size = [&](const std::vector<std::vector<float>>& all, size_t size) {
    return all.size() == groups && std::all_of(all.begin(), all.end(), [&](const auto& group) {
             return group.size() == size;
           });
  };
  const Slabs slabs = source_slabs(settings);
  return settings.suns >= 2 && settings.sun_rows_per_interval >= 1 &&
         all_of_size(tables.source, slabs.count * slabs.width * rows) &&
         all_of_size(tables.ground_irradiance, 4 * rows) &&
         tables.last_addition.size() == tables.medium.bands.size() &&
         tables.tail_ratio.size() == tables.medium.bands.size();
}

bool all_finite(const Tables& tables) {
  const auto finite = [](const auto& values) {
    for (const auto v : values)
      if (!std::isfinite(v)) return false;
    return true;
  };
  for (const auto& group : tables.source)
    if (!finite(group)) return false;
  for (const auto& group : tables.ground_irradiance)
    if (!finite(group)) return false;
  return finite(tables.last_addition) && finite(tables.tail_ratio);
}

Error system_error(const fs::path& path, int number) {
  return {ErrorCode::write_failed,
          "cannot write " + path.string() + ": " + std::generic_category().message(number),
          {},
          "the tables are computed again next time"};
}

int write_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes = bytes.subspan(size_t(n));
  }
  return 0;
}

/// A hidden name beside `path` that no other writer uses.
fs::path temporary_of(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  return path.parent_path() /
         ("." + path.filename().string() + "." + std::to_string(::getpid()) + "." +
          std::to_string(now) + "." + std::to_string(counter++) + kTemporarySuffix);
}

}  // namespace

void refill_sun_rows(Tables& tables) {
  change_groups(tables, [&](const std::vector<float>& group, Slabs slabs) {
    return all_rows(node_rows(group, slabs, tables.settings), slabs, tables);
  });
}

Status write_tables(const fs::path& path, const std::string& key, const Tables& tables) {
  if (!right_sizes(tables) || !all_finite(tables))
    return Error{ErrorCode::internal, "tables of wrong size, or not of finite numbers", {}, {}};
  const bool short_form = nodes_suffice(tables);
  Tables nodes;
  if (short_form) {
    nodes.last_addition = tables.last_addition;
    nodes.tail_ratio = tables.tail_ratio;
    for (const auto& group : tables.source)
      nodes.source.push_back(node_rows(group, source_slabs(tables.settings), tables.settings));
    for (const auto& group : tables.ground_irradiance)
      nodes.ground_irradiance.push_back(node_rows(group, Slabs{}, tables.settings));
  }
  // The sections are only read here.
  const std::vector<Bytes> parts = sections(short_form ? nodes : const_cast<Tables&>(tables));
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.format = kFormat;
  header.orders = tables.orders;
  header.bands = uint32_t(tables.medium.bands.size());
  header.groups = uint32_t(tables.source.size());
  header.rows = uint32_t(short_form ? tables.settings.suns : tables.settings.sun_rows());
  std::memcpy(header.key, key.data(), std::min(key.size(), kDigits));
  std::memcpy(header.checksum, checksum_of(parts).data(), kDigits);
  std::memcpy(header.header_checksum, checksum_of(header).data(), kDigits);

  const fs::path temporary = temporary_of(path);
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0) return system_error(path, errno);
  int failed = write_all(fd, std::as_bytes(std::span(&header, 1)));
  for (size_t i = 0; i < parts.size() && failed == 0; ++i) failed = write_all(fd, parts[i]);
  if (::close(fd) != 0 && failed == 0) failed = errno;
  if (failed == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) failed = errno;
  if (failed == 0) return Done{};
  ::unlink(temporary.c_str());
  return system_error(path, failed);
}

std::optional<Tables> read_tables(const fs::path& path, const std::string& key,
                                  const atmosphere::Medium& medium, const Settings& settings) {
  std::ifstream file(path, std::ios::binary);
  Header header{};
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header)) return std::nullopt;
  const auto is = [](const char* digits, const std::string& expected) {
    return expected.size() == kDigits && std::memcmp(digits, expected.data(), kDigits) == 0;
  };
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0 || header.format != kFormat ||
      !is(header.header_checksum, checksum_of(header)) || !is(header.key, key) ||
      header.bands != medium.bands.size() || header.groups != (medium.bands.size() + 3) / 4 ||
      (header.rows != uint32_t(settings.suns) && header.rows != uint32_t(settings.sun_rows())))
    return std::nullopt;
  Tables tables = empty_tables(medium, settings, header.rows);
  tables.orders = header.orders;
  const std::vector<Bytes> parts = sections(tables);
  for (const Bytes part : parts)
    if (!file.read(reinterpret_cast<char*>(part.data()), std::streamsize(part.size())))
      return std::nullopt;
  if (file.peek() != std::ifstream::traits_type::eof()) return std::nullopt;
  if (!is(header.checksum, checksum_of(parts))) return std::nullopt;
  if (header.rows != uint32_t(settings.sun_rows()))
    change_groups(tables, [&](const std::vector<float>& group, Slabs slabs) {
      return all_rows(group, slabs, tables);
    });
  return tables;
}

void remove_stale_table_temporaries(const fs::path& folder) {
  std::error_code ignored;
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with('.') || !name.ends_with(kTemporarySuffix)) continue;
    const auto written = entry.last_write_time(ignored);
    if (!ignored && written < old) fs::remove(entry.path(), ignored);
  }
}

}  // namespace skylapse::sky::bruneton
